"""Plans in files that are damaged or too long: the refusal names what is wrong and where."""

import json

import pytest

from armlab.benches.motion.files.commands import reading
from armlab.benches.motion.files.read import plan_json
from armlab.benches.motion.files.table import MOST_BYTES
from armlab.benches.motion.plan.state import Plan
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.state import State, apply


@pytest.fixture
def state():
    return State.initial(catalogue()["planar_2r"])


def refused(state, data):
    """Return why a file is refused."""
    with pytest.raises(InputError) as refusal:
        apply(state, reading(data if isinstance(data, str) else json.dumps(data)))
    return str(refusal.value)


def of(count, state, indent=None):
    """Return a file of so many waypoints."""
    data = json.loads(plan_json(state))
    data["plan"]["waypoints"] = [{"q": [-1.0 + 1e-4 * k, 0.2]} for k in range(count)]
    data["plan"]["moves"] *= count - 1
    return json.dumps(data, indent=indent)


@pytest.mark.parametrize("indent", [None, 1])
@pytest.mark.parametrize("count", [101, 2000, 10_000])
def test_too_many_waypoints_are_counted(state, count, indent):
    text = of(count, state, indent)
    said = refused(state, text[: MOST_BYTES + 1])
    assert "at most 100 are taken" in said
    if len(text) <= MOST_BYTES:
        assert said.startswith(f"plan: it has {count} waypoints")
    else:
        assert int(said.split()[3]) > 1000
        assert "or more waypoints" in said
    assert "column" not in said


def test_a_hundred_waypoints_are_taken(state):
    assert len(apply(state, reading(of(100, state)))[Plan].waypoints) == 100


def test_a_long_recording_is_not_called_one_of_waypoints(state):
    data = json.loads(plan_json(state))
    rows = [[0.123456789012345, 1.123456789012345]] * 45_000
    data["plan"]["recorded"] = {"t": [], "q": rows}
    text = json.dumps(data, indent=None)
    assert len(text) > MOST_BYTES
    said = refused(state, text)
    assert "larger than 1.5 MB" in said
    assert "waypoints" not in said


@pytest.mark.parametrize(
    ("path", "said"),
    [
        (("plan", "moves"), "plan: moves are missing"),
        (("plan", "waypoints"), "plan: waypoints are missing"),
        (("plan",), "plan: 'plan' is missing in the file"),
        (("robot",), "plan: 'robot' is missing in the file"),
        (("plan", "waypoints", 1, "q"), "waypoint 2: expected 2 finite joint values"),
    ],
)
def test_what_is_missing_is_named(state, path, said):
    data = json.loads(plan_json(state))
    place = data
    for key in path[:-1]:
        place = place[key]
    del place[path[-1]]
    assert refused(state, data) == said


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        (("waypoints", 1), None, "waypoint 2: expected 2 finite joint values"),
        (("waypoints", 1, "q"), [None, 1.0], "waypoint 2: expected 2 finite joint values"),
        (("waypoints", 0, "q"), ["a", 1.0], "waypoint 1: expected 2 finite joint values"),
        (("waypoints", 0, "q"), [[1.0], [2.0, 3.0]], "waypoint 1: expected 2 finite joint values"),
        (("waypoints", 1, "pose"), [1.0, 2.0], "waypoint 2, pose: expected 16 numbers"),
        (("waypoints", 1, "pose"), [2.0] * 16, "waypoint 2: pose of the waypoint"),
        (("moves", 0), None, "move 1: not usable: nothing"),
        (("moves", 0, "space"), "task", "move 1: space: unknown name 'task'"),
        (("moves", 0, "law"), 5, "move 1: kind: expected a key and options"),
        (("moves",), "line", "plan, moves: expected a list, got line"),
        (("samples",), "many", "plan, samples: not usable: many"),
        (("shares",), None, "share"),
        (("velocity",), {"a": 1}, "plan, velocity: not usable"),
        (("selected",), [], "plan, selected: not usable"),
        (("recorded",), {"t": [0.0]}, "plan, recorded: not usable"),
    ],
)
def test_what_is_damaged_is_named(state, path, value, said):
    data = json.loads(plan_json(state))
    place = data["plan"]
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    text = refused(state, data)
    assert said in text
    assert "Error" not in text
