"""Accuracy and repeatability from n attempts: what is estimated, and how often its interval holds the truth."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.throws import estimate, throws


def test_four_attempts_by_hand():
    """Corners of a square about (1, 2): the squared distances are 2 each, 8 in all, over 2 (4 - 1) = 6."""
    found = estimate([[0, 1], [2, 1], [0, 3], [2, 3]])
    np.testing.assert_allclose(found.mean, [1, 2], rtol=0, atol=1e-12)
    assert found.distance == pytest.approx(math.sqrt(5), abs=1e-12)
    assert found.spread == pytest.approx(math.sqrt(8 / 6), abs=1e-12)
    # F(0.95; 2, 6) = 5.1433 and chi-squared quantiles of 6 degrees, 1.2373 and 14.4494, from printed tables.
    assert found.radius == pytest.approx(math.sqrt(8 / 6) * math.sqrt(2 / 4 * 5.1433), abs=1e-4)
    assert found.low == pytest.approx(math.sqrt(8 / 14.4494), abs=1e-4)
    assert found.high == pytest.approx(math.sqrt(8 / 1.2373), abs=1e-3)


@pytest.mark.parametrize("count", [2, 5, 40])
def test_the_intervals_hold_the_truth_as_often_as_they_say(count):
    bias, spread, held = np.array([3.0, -1.0]), 2.0, []
    for seed in range(1500):
        found = estimate(throws(count, bias, spread, seed))
        held.append([np.linalg.norm(found.mean - bias) <= found.radius, found.low <= spread <= found.high])
    # Four standard errors of 95 % in 1500 trials.
    np.testing.assert_allclose(np.mean(held, axis=0), 0.95, rtol=0, atol=4 * math.sqrt(0.95 * 0.05 / 1500))


def test_the_mean_becomes_surer_with_the_root_of_the_number():
    few, many = (estimate(throws(n, (0.0, 0.0), 1.0, 3)) for n in (100, 10_000))
    assert few.radius / many.radius == pytest.approx(10.0, rel=0.15)
    assert not few.settled
    assert estimate(throws(100, (1.0, 0.0), 1.0, 3)).settled


def test_more_throws_keep_the_first_and_another_seed_makes_others():
    np.testing.assert_array_equal(throws(50, (1, 2), 3.0, 7)[:10], throws(10, (1, 2), 3.0, 7))
    assert not np.allclose(throws(10, (1, 2), 3.0, 7), throws(10, (1, 2), 3.0, 8))
    np.testing.assert_array_equal(throws(3, (1, 2), 0.0, 7), [[1, 2]] * 3)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: throws(0, (0, 0), 1.0, 0), r"throws: expected a whole number, at least 1, got 0"),
        (lambda: throws(10**9, (0, 0), 1.0, 0), r"throws: expected at most 10000, got 1000000000"),
        (lambda: throws(5, (0,), 1.0, 0), r"bias: expected two finite numbers"),
        (lambda: throws(5, (0, 0), -1.0, 0), r"spread: expected no negative number, got -1"),
        (lambda: estimate([[1, 2]]), r"throws: expected at least 2, since one alone has no spread, got 1"),
        (lambda: estimate([[1, 2]] * 3, 1.0), r"confidence: expected a number between 0 and 1, got 1"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make()
