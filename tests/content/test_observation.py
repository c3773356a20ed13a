"""Evidence: what an observation is written as, and what a forged one is told."""

import copy
import json
import math

import numpy as np
import pytest

from armlab.content.observation import Observation
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.transforms import transform

ROBOT = catalogue()["planar_2r"]


def full():
    return Observation.of(
        ROBOT.arm,
        [0.1, -0.2],
        target=transform(position=[1.0, 2.0, 3.0]),
        seconds=12.5,
        switches=frozenset({"frames", "names"}),
        panel="joints",
        films=frozenset({"moves"}),
    )


def test_what_is_left_out_is_nothing():
    seen = Observation.of(ROBOT.arm, [0.1, -0.2])
    np.testing.assert_array_equal(seen.tool_pose, ROBOT.arm.fk([0.1, -0.2]))
    assert (seen.target, seen.seconds, seen.switches, seen.panel, seen.films) == (
        None,
        0.0,
        frozenset(),
        "",
        frozenset(),
    )


def test_evidence_comes_back_the_same(robot, rng):
    arm = robot.arm
    for q in rng.uniform(*arm.limits.T, (3, arm.n)):
        seen = Observation.of(arm, q, target=arm.fk(q), seconds=float(rng.uniform(0, 100)), panel="table")
        back = Observation.from_json(json.loads(json.dumps(seen.to_json())), robot)
        assert back.arm is arm
        np.testing.assert_array_equal(back.q, q)
        np.testing.assert_array_equal(back.tool_pose, seen.tool_pose)
        np.testing.assert_allclose(back.target, seen.target, rtol=0, atol=0)
        assert (back.seconds, back.panel) == (seen.seconds, seen.panel)
    back = Observation.from_json(json.loads(json.dumps(full().to_json())), ROBOT)
    assert (back.switches, back.films) == (frozenset({"frames", "names"}), frozenset({"moves"}))


def test_an_edited_table_is_evidence_too():
    own = Arm.from_dh([("R", 0.5, math.pi / 2, 0.1, 0.2), ("P", 0.0, 0.0, 0.3, 0.0)], "modified")
    seen = Observation.of(own, [0.5, 0.6])
    back = Observation.from_json(json.loads(json.dumps(seen.to_json())), ROBOT)
    assert back.arm is not ROBOT.arm
    assert (back.arm.rows, back.arm.convention, back.arm.task) == (own.rows, "modified", own.task)
    np.testing.assert_allclose(back.tool_pose, seen.tool_pose, rtol=0, atol=1e-15)


def test_the_pose_of_the_tool_cannot_be_forged():
    data = full().to_json()
    assert "tool_pose" not in data
    with pytest.raises(InputError, match="observation: expected exactly the fields"):
        Observation.from_json({**data, "tool_pose": np.eye(4).tolist()}, ROBOT)


JUNK = [None, True, -1, 7, 1e300, math.nan, math.inf, 10**400, "x", "y" * 100, [], [[]], {}, [None], ["R"], {"a": 1}]


def test_forged_fields_raise_a_sentence_and_nothing_else(rng):
    """Every value of the evidence, however deep, is replaced by junk: a sentence, or evidence that makes sense."""
    good = json.loads(json.dumps(full().to_json()))

    def places(data, path=()):
        yield path
        items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
        for key, value in items:
            yield from places(value, (*path, key))

    told = []
    for path in places(good):
        for junk in JUNK:
            data = copy.deepcopy(good)
            if not path:
                data = junk
            else:
                inside = data
                for key in path[:-1]:
                    inside = inside[key]
                inside[path[-1]] = junk
            try:
                seen = Observation.from_json(data, ROBOT)
            except InputError as error:
                told.append(str(error))
            else:
                assert np.isfinite(seen.tool_pose).all()
                assert seen.seconds >= 0
                assert seen.q.shape == (seen.arm.n,)
                assert seen.arm.within_limits(seen.q, 1e-6)
    assert len(told) > 700
    assert max(map(len, told)) < 300


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"q": [0.1]}, r"observation\.q: expected 2 numbers"),
        ({"q": [0.1, 4.0]}, r"observation\.q: joint 2 is at 229.2°, outside its limits of -180° to 180°"),
        ({"q": [0.1, True]}, r"observation\.q: expected a number"),
        ({"seconds": -1}, r"observation\.seconds: expected a number not below zero"),
        ({"target": np.diag([1, 1, -1, 1]).tolist()}, r"observation\.target: .*not a rotation matrix"),
        ({"target": [[1]]}, r"observation\.target: expected 4 rows"),
        ({"switches": "frames"}, r"observation\.switches: expected a list"),
        ({"switches": ["x"] * 201}, r"observation\.switches: expected a list of at most 200 names"),
        ({"films": [1]}, r"observation\.films: expected a name"),
        ({"panel": "p" * 65}, r"observation\.panel: expected a name of at most 64 characters"),
        ({"arm": {}}, r"observation\.arm: expected exactly the fields"),
    ],
)
def test_what_forged_evidence_is_told(change, says):
    with pytest.raises(InputError, match=says):
        Observation.from_json({**full().to_json(), **change}, ROBOT)


def test_a_table_in_evidence_is_checked():
    data = full().to_json()
    for change, says in (
        ({"rows": []}, r"observation\.arm\.rows: expected a list of 1 to 12 rows"),
        ({"rows": [["X", 1, 0, 0, 0]] * 2}, "joint type"),
        ({"rows": [["R", 1, 0, 0]] * 2}, r"rows\[1\]: expected a list of kind"),
        ({"rows": [["R", "1", 0, 0, 0]] * 2}, r"rows\[1\]: expected a number"),
        ({"convention": "craig"}, "convention"),
        ({"task": "fly"}, "task"),
        ({"limits": [[1, -1], [0, 1]]}, "limits of joint 1"),
    ):
        with pytest.raises(InputError, match=says):
            Observation.from_json({**data, "arm": {**data["arm"], **change}}, ROBOT)
