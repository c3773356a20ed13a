"""Accuracy and repeatability as ISO 9283 defines them, by hand and by their properties."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.repeatability import scatter_of


def test_four_positions_by_hand():
    """Mean (1, 0, 0); the distances are 1, 1, 2, 2, their mean 1.5 and their standard deviation 1/sqrt(3)."""
    found = scatter_of([[2, 0, 0], [0, 0, 0], [1, 2, 0], [1, -2, 0]], [1.0, 0.0, 3.0])
    np.testing.assert_allclose(found.middle, [1, 0, 0], rtol=0, atol=1e-15)
    assert found.accuracy == 3.0
    assert found.repeatability == pytest.approx(1.5 + 3.0 / math.sqrt(3.0), rel=1e-12)
    np.testing.assert_allclose(found.distances, [1, 1, 2, 2], rtol=0, atol=1e-15)


def test_repeatability_does_not_know_the_goal_and_accuracy_is_that_of_the_mean(rng):
    points = rng.normal(size=(40, 3))
    one, other = scatter_of(points, [0, 0, 0]), scatter_of(points + np.array([5.0, 0.0, 0.0]), [0, 0, 0])
    assert other.repeatability == pytest.approx(one.repeatability, rel=1e-12)
    np.testing.assert_allclose(other.middle - one.middle, [5, 0, 0], rtol=0, atol=1e-12)
    assert scatter_of(points, points.mean(axis=0)).accuracy == pytest.approx(0.0, abs=1e-12)


def test_both_grow_with_the_errors(rng):
    points, goal = rng.normal(size=(30, 3)), np.array([1.0, 2.0, 3.0])
    one, twice = scatter_of(points, goal), scatter_of(goal + 2.0 * (points - goal), goal)
    assert twice.accuracy == pytest.approx(2.0 * one.accuracy, rel=1e-12)
    assert twice.repeatability == pytest.approx(2.0 * one.repeatability, rel=1e-12)


@pytest.mark.parametrize("points", [[[0, 0, 0]], [[0, 0], [1, 1]], [[0, 0, 0], [math.nan, 0, 0]], [1, 2, 3]])
def test_fewer_than_two_positions_are_refused(points):
    with pytest.raises(InputError, match="attained: expected at least two positions of three finite numbers"):
        scatter_of(points, [0, 0, 0])
