"""Targets that are called turned over: beyond a quarter turn of the tool's tilt, and never ones that are reached."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik.turned_over import is_turned_over
from armlab.kin.ik.verdict import judge
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.transforms import inverse, transform


def tilted(arm, T, angle, rng):
    """Return a pose with the tool turned about a random axis across z of frame 0."""
    up = (inverse(arm.base) @ T)[2, :3]
    axis = np.cross(up, rng.normal(size=3))
    R = T[:3, :3] @ rotation_from_axis_angle(axis / np.linalg.norm(axis), angle)
    return transform(R, T[:3, 3])


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "scara"])
@pytest.mark.parametrize("beside", [1e-8, 1e-4, 0.3, 1.5])
def test_the_tool_is_turned_over_beyond_a_quarter_turn_and_not_before(key, beside, rng):
    arm = catalogue()[key].arm
    q = 0.4 * np.ones(arm.n)
    called = [is_turned_over(arm, tilted(arm, arm.fk(q), math.pi / 2 + side * beside, rng)) for side in (-1.0, 1.0)]
    assert called == [False, arm.task.rotation == "phi"]


@pytest.mark.parametrize("key", ["planar_3r", "scara"])
def test_no_turn_of_the_arm_reaches_what_is_called_turned_over(key, rng):
    arm = catalogue()[key].arm
    for tilt in (math.pi / 2 + 1e-8, 2.0, math.pi - 1e-9, math.pi):
        q = rng.uniform(-1.0, 1.0, arm.n) * arm.revolute
        T = tilted(arm, arm.fk(q), tilt, rng)
        assert is_turned_over(arm, T)
        turns = (np.r_[first, q[1:]] for first in np.linspace(-math.pi, math.pi, 73))
        assert min(judge(arm, T, each).rotation_error for each in turns) > 1e-3
