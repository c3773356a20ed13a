"""Numbers and markup on screen."""

from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.arithmetic import evaluate
from armlab.kin.field import Field
from armlab.ui import format as fmt
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale, option_value
from armlab.ui.units import plain_number


def test_numbers_have_fixed_decimals_and_a_true_minus():
    assert fmt.number(1.25, 1) == "1.2"
    assert fmt.number(-1.26, 1) == "−1.3"
    assert fmt.number(-0.001, 2) == "0.00"


def test_a_number_in_a_field_reads_back_as_nearly_the_same(rng):
    assert [fmt.readable(value, 4) for value in (1.0, -0.25, 1234.56789, 0.0, 2e-13)] == [
        "1",
        "−0.25",
        "1234.5679",
        "0",
        "0",
    ]
    assert fmt.readable(0.5e-3 / 3.0, 4) == "0.0001667"
    assert fmt.readable(-1e-9, 3) == "−1e−9"
    for value in (-1.0) ** rng.integers(0, 2, 400) * 10.0 ** rng.uniform(-11.9, 6.0, 400):
        for decimals in (2, 4):
            assert evaluate(fmt.readable(value, decimals)) == pytest.approx(value, rel=5e-4)
            assert plain_number(fmt.readable(value, decimals)) == pytest.approx(value, rel=5e-4)


def test_an_option_typed_again_as_it_is_shown_stays():
    field, scales = Field("v", "v", "speed", "vector", unit="q/s"), (Scale("°", np.pi / 180.0), Scale("mm", 1e-3))
    form = SimpleNamespace(field=lambda cell, text, title, action, off: f"[{text}]")
    given = [1.0 / 6000.0 * np.pi / 180.0, -1e-3 / 6000.0]
    shown = option_form(form, "", (field,), {"v": given}, lambda key, value: (), scales)
    text = shown[shown.index("[") + 1 : shown.index("]")]
    assert text == "0.0001667  −0.0001667"
    np.testing.assert_allclose(option_value(field, text, given, scales), given, rtol=5e-4)


def test_zeros_of_a_matrix_are_grey():
    html = fmt.matrix(np.array([[1.0, 0.0004], [-0.5, 2.0]]), 3, rule=1)
    assert html.count('class="zero') == 1
    assert "−0.500" in html
    assert html.count("ruled") == 2


def test_formulas_are_kept_but_not_for_ever():
    assert fmt.mathml("q_1") is fmt.mathml("q_1")
    assert fmt.mathml.cache_info().maxsize == 4096


def test_formulas_become_mathml():
    assert fmt.mathml("q_1").startswith("<math")
    assert 'display="block"' in fmt.mathml("q_1", block=True)
