"""Arms as large as can be typed: no part of a state opens, or takes an example, with what it would not read again."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.bench import benches
from armlab.session.parts.robot import RobotPart
from armlab.session.salvage import salvaged
from armlab.session.share import from_short, short
from armlab.session.sizes import LONGEST, check_sizes
from armlab.session.state import State, part_types


def arm_of(kinds, length, offset=0.0):
    """An arm of equal links, its prismatic joints with the longest strokes that can be typed."""
    arm = Arm.from_dh([(kind, length, 0.3, offset, 0.2) for kind in kinds])
    limits = [(-LONGEST, LONGEST) if kind == "P" else limit for kind, limit in zip(kinds, arm.limits, strict=True)]
    arm = replace(arm, limits=np.array(limits, dtype=float))
    check_sizes(arm)
    return own_robot(arm, "")


PUMA = ((0.0, 0.0), (43.18, 0.0), (2.03, 15.0), (0.0, 43.18), (0.0, 0.0), (0.0, 5.6))
"""Lengths a and offsets d of a PUMA in centimetres, typed as metres."""

ARMS = {
    "two links of 40 m": arm_of("RR", 40.0),
    "three links of 100 m": arm_of("RRR", LONGEST),
    "PUMA in centimetres": own_robot(Arm.from_dh([("R", a, 0.5 * math.pi, d, 0.0) for a, d in PUMA]), ""),
    "twelve of the longest links": arm_of("R" * 12, LONGEST, LONGEST),
    "twelve of the longest strokes": arm_of("P" * 12, LONGEST, LONGEST),
}


def read_again(part, robot):
    """Raise `InputError` if what a part has saved is refused."""
    type(part).from_json(json.loads(json.dumps(part.to_json(), allow_nan=False)), robot)


@pytest.mark.parametrize("name", ARMS)
def test_every_part_opens_with_what_it_reads_again(name):
    refused = {}
    for kind in part_types():
        try:
            part = kind.initial(ARMS[name])
            if kind.saved:
                read_again(part, ARMS[name])
        except InputError as error:
            refused[kind.key] = str(error)
    assert refused == {}


@pytest.mark.parametrize("name", ARMS)
def test_work_with_a_huge_arm_is_read_again_and_fits_into_a_link(name):
    state = State.initial(ARMS[name])
    assert salvaged(json.loads(json.dumps(state.to_json(), allow_nan=False)))[1] == {}
    assert from_short(short(state))[RobotPart].robot.arm.length_scale == state[RobotPart].robot.arm.length_scale


@pytest.mark.parametrize("name", ARMS)
def test_every_example_that_brings_no_arm_is_read_again(name):
    opened, refused = State.initial(ARMS[name]), {}
    for bench in benches().values():
        for key in (key for key, example in bench.examples.items() if not getattr(example, "robot", "")):
            try:
                state = bench.choose(key).apply(opened)
                for part in (state[kind] for kind in part_types() if kind.saved and state[kind] is not opened[kind]):
                    read_again(part, ARMS[name])
            except InputError as error:
                refused[f"{bench.key}/{key}"] = str(error)
    assert refused == {}
