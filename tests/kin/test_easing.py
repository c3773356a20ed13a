"""The course of what moves on screen."""

import numpy as np
import pytest

from armlab.kin.easing import eased


def test_it_begins_and_ends_at_rest_and_never_turns_back():
    s = np.linspace(0.0, 1.0, 101)
    values = np.array([eased(float(part)) for part in s])
    assert np.all(np.diff(values) > 0.0)
    np.testing.assert_allclose(values, 1.0 - values[::-1], atol=1e-12)
    assert eased(1e-3) < 1e-8
    assert 1.0 - eased(1.0 - 1e-3) < 1e-8


@pytest.mark.parametrize(("s", "value"), [(-1.0, 0.0), (0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (7.0, 1.0)])
def test_before_and_after_it_rests(s, value):
    assert eased(s) == value
