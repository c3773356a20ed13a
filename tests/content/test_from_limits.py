"""The check that asks for room to the limits of the joints."""

import numpy as np
import pytest

from armlab.content.check import read_check
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError

PUMA = catalogue()["puma560"]


def read(robot=PUMA, **fields):
    return read_check(Table("x.md", {"kind": "from_limits", **fields}, "check"), robot)


def seen(q, robot=PUMA):
    return Observation.of(robot.arm, q)


@pytest.mark.parametrize("joint", range(6))
@pytest.mark.parametrize("side", [0, 1])
def test_ten_degrees_to_every_limit_are_asked_of_every_joint(joint, side):
    check, q = read(at_least_deg=10), PUMA.arm.limits.mean(axis=1)
    assert check.is_met(seen(q))
    inward = np.radians(10.0) * (1 - 2 * side)
    q[joint] = PUMA.arm.limits[joint, side] + inward
    assert check.is_met(seen(q))
    q[joint] = PUMA.arm.limits[joint, side] + 0.9 * inward
    assert not check.is_met(seen(q))
    assert check.says(seen(q)) == f"Joint {joint + 1} is 9.0° from its limit; at least 10.0° are required."


def test_sliding_joints_have_a_distance_of_their_own():
    robot = next(robot for robot in catalogue().robots.values() if set(robot.arm.revolute) == {True, False})
    slides = int(np.flatnonzero(~robot.arm.revolute)[0])
    check, q = read(robot, at_least_m=0.01), robot.arm.limits.mean(axis=1)
    q[robot.arm.revolute] = robot.arm.limits[robot.arm.revolute, 0]
    assert check.is_met(seen(q, robot))
    q[slides] = robot.arm.limits[slides, 0] + 0.005
    assert check.says(seen(q, robot)).startswith(f"Joint {slides + 1} is 0.005 m from its limit")


@pytest.mark.parametrize(
    ("fields", "says"),
    [({}, "at_least_deg: missing"), ({"at_least_deg": 0}, "positive"), ({"at_least_deg": 179}, "cannot be so far")],
)
def test_what_cannot_be_asked_is_told(fields, says):
    with pytest.raises(ContentError, match=says):
        read(**fields)
