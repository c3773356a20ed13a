"""What edits of the arm make of all parts is read back as it was, from files and from links."""

import json
import re

import numpy as np
import pytest

from armlab.benches.control.follow.state import Control
from armlab.benches.robot.normal.state import KeepLines, TakeAxes
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session import share
from armlab.session.edits import AddJoint, Convert, RemoveJoint, ReorderJoint, SetCell, SetEnd, SetKind, SetLimits
from armlab.session.fields import FieldPart, Set, fields_of
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.parts.target import PlaceTarget
from armlab.session.run_targets import first_target
from armlab.session.share import from_short, short, state_of_parts
from armlab.session.state import State, apply, part_types
from support.arms import random_pose
from support.sources import TOP

PUMA = catalogue()["puma560"]
GOLDEN = json.loads((TOP / "tests/data/golden.json").read_text(encoding="utf-8"))["parts"]

PLACES = ("lesson", "shelf", "former", "preview")
"""Keys of the parts that hold where the student is, or whole other states."""

FRESH = ("planar_3r", "scara", "panda")
"""Arms that are edited just after they were chosen."""

SAVED = [kind for kind in part_types() if kind.saved]


@pytest.fixture
def endless(monkeypatch):
    """Links of any length."""
    monkeypatch.setattr(share, "LONGEST", 100_000)
    monkeypatch.setattr(share, "TEXT", re.compile(r"[A-Za-z0-9_-]+\Z"))


def worked_on(rng):
    """Return a state with a PUMA 560 in which a student has been on most pages."""
    return State(
        kind.from_json(GOLDEN[kind.key]["puma560"][rng.integers(len(GOLDEN[kind.key]["puma560"]))], PUMA)
        if kind.saved and kind.key not in (RobotPart.key, *PLACES)
        else kind.initial(PUMA)
        for kind in part_types()
    )


def scaled(arm, factor):
    """Return the commands that make all lengths of the table so many times as large."""
    return [SetCell(i, name, factor * getattr(row, name)) for i, row in enumerate(arm.rows) for name in ("a", "d")]


def far(rng):
    """Return a pose near by or at almost the largest distance that can be typed."""
    pose = random_pose(rng)
    pose[:3, 3] *= rng.choice([0.02, 1.0, 199.0])
    return pose


def some_edit(rng, state):
    """Return commands: an edit of the arm, or something that keeps a place in the world."""
    arm = state[RobotPart].robot.arm
    i, low = int(rng.integers(arm.n)), float(rng.uniform(-50.0, 50.0))
    return [
        lambda: scaled(arm, 10.0 ** rng.uniform(-2.0, 2.0)),
        lambda: [SetEnd("base", far(rng))],
        lambda: [SetEnd("tool", far(rng))],
        lambda: [AddJoint(i)],
        lambda: [RemoveJoint(i)],
        lambda: [ReorderJoint(i, int(rng.integers(arm.n)))],
        lambda: [SetKind(i, "RP"[rng.integers(2)])],
        lambda: [SetLimits(i, low, low + 10.0 ** rng.uniform(-2.0, 1.0))],
        lambda: [Convert(("standard", "modified")[rng.integers(2)])],
        lambda: [PlaceTarget(state[Joints].tool_pose)],
        lambda: [TakeAxes(i)],
        lambda: [KeepLines(), RandomPose()],
    ][rng.integers(12)]()


def edited(state, rng):
    """Yield states, each after another edit; what is refused changes nothing."""
    for _ in range(6):
        for command in some_edit(rng, state):
            try:
                state = apply(state, command)
            except InputError:
                continue
        yield state


def written(state):
    """Return a state as a file holds it."""
    return json.loads(json.dumps(state.to_json(), allow_nan=False))


def entries(data, path=""):
    """Yield the entries of JSON, with where they stand."""
    pairs = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    if isinstance(data, dict | list) and data:
        for key, value in pairs:
            yield from entries(value, f"{path}.{key}")
    else:
        yield path, data


def assert_same(again, data):
    """Compare parts, but for the table, whose angles files have in degrees; links round to nine decimals."""
    found, meant = (dict(entries({key: each[key] for key in each if key != RobotPart.key})) for each in (again, data))
    assert found.keys() == meant.keys()
    for path, value in meant.items():
        assert found[path] == (pytest.approx(value, rel=1e-9, abs=2e-9) if isinstance(value, float) else value), path


@pytest.mark.parametrize("seed", range(9))
def test_what_the_lab_accepts_it_reads_back(seed, endless):
    """Sizes from a hundredth to a hundred times, base and tool far away, joints added, removed and exchanged."""
    rng = np.random.default_rng(seed)
    begun = worked_on(rng) if seed % 3 else State.initial(catalogue()[FRESH[seed // 3]])
    for state in edited(begun, rng):
        data = written(state)
        robot = robot_from_json(data[RobotPart.key])
        for kind in SAVED:
            assert kind.from_json(data[kind.key], robot).key == kind.key
        assert_same(written(state_of_parts(data)), data)
        linked = {key: part for key, part in data.items() if key not in (*share.STAYS, Display.key)}
        again = written(from_short(short(state)))
        assert_same({key: again[key] for key in linked}, linked)


@pytest.mark.parametrize("kind", [kind for kind in SAVED if issubclass(kind, FieldPart)], ids=lambda kind: kind.key)
def test_a_number_at_its_bound_travels_in_a_link(kind):
    """With nine decimals π is larger than it is."""
    start = State.initial(PUMA)
    for name, field in fields_of(kind).items():
        for bound in {field.low, field.high} if field.kind in ("number", "vector") else ():
            value = [bound] * len(getattr(start[kind], name)) if field.kind == "vector" else bound
            try:
                state = apply(start, Set(kind, name, value))
            except InputError:
                continue
            again = getattr(from_short(short(state))[kind], name)
            np.testing.assert_allclose(again, getattr(state[kind], name), rtol=1e-9, atol=1e-9)


def test_a_target_that_an_edit_leaves_much_too_far_away_is_the_first_one_again():
    base = np.eye(4)
    base[0, 3] = 90.0
    state = State.initial(catalogue()["planar_2r"])
    for command in (SetEnd("base", base), SetCell(0, "a", 0.01), SetCell(1, "a", 0.01)):
        state = apply(state, command)
    np.testing.assert_array_equal(state_of_parts(written(state))[Control].target, first_target(state[RobotPart].robot))
