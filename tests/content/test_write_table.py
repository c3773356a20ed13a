"""Tables as they are copied: what stands beside the rows that are read back."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.content.tables import parse_table
from armlab.content.write_table import ANGLE_UNITS, FORMATS, write_table
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_sequence
from support.arms import limited_arm, random_pose


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("angle", ANGLE_UNITS)
def test_limits_are_in_the_table_and_base_and_tool_in_a_comment_below_it(format, angle, rng):
    def read(number, turns):
        return math.radians(float(number)) if turns and angle == "deg" else float(number)

    arms = [robot.arm for robot in catalogue().robots.values()]
    arms += [replace(limited_arm(rng, n), base=random_pose(rng), tool=random_pose(rng)) for n in (1, 3, 6)]
    for arm in arms:
        text = write_table(arm, format, angle)
        lines = [line for line in text.splitlines() if re.search(r"^\W*\d+ [RP]\W", line)]
        limits = [re.findall(r"-?[\d.]+(?:e-?\d+)?", line)[-2:] for line in lines]
        found = [[read(limit, turns) for limit in pair] for pair, turns in zip(limits, arm.revolute, strict=True)]
        np.testing.assert_allclose(found, arm.limits, rtol=0, atol=1e-12)
        told = re.findall(r"(base|tool), not in the table: at \((.*?)\) m, turned by \((.*?)\)", text)
        poses = {name: pose for name, pose in (("base", arm.base), ("tool", arm.tool)) if (pose != np.eye(4)).any()}
        assert [name for name, *_ in told] == list(poses)
        for name, place, turn in told:
            R = rotation_from_sequence("xyz", [read(each, True) for each in turn.split(", ")], fixed=True)
            np.testing.assert_allclose([float(each) for each in place.split(", ")], poses[name][:3, 3], atol=1e-12)
            np.testing.assert_allclose(R, poses[name][:3, :3], atol=1e-12)
        notes = parse_table(text).notes
        assert not poses or f"Not read: {' and '.join(poses)}." in notes
        assert any(note.startswith("Not read: the columns q_") for note in notes)


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("angle", ANGLE_UNITS)
@pytest.mark.parametrize("near", [1.57, 1.571, -1.5708, 3.14, -3.1416, 4.71, 6.283, math.pi / 2])
def test_an_angle_beside_a_quarter_turn_is_read_back_as_it_is(format, angle, near):
    arm = Arm.from_dh([("R", 0.5, near, 0.1, -near), ("P", 0.4, 0.001, 0.2, near)])
    for own, read in zip(arm.rows, parse_table(write_table(arm, format, angle)).rows, strict=True):
        assert own.kind == read.kind
        np.testing.assert_allclose([read.alpha, read.theta], [own.alpha, own.theta], rtol=0, atol=1e-12)
