"""Two lines: the four cases, snapping, the arm's own axes."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.robot.normal.state import (
    SNAP_ANGLE,
    SNAP_DISTANCE,
    DragLine,
    HandleLines,
    KeepLines,
    Lines,
    PlaceLines,
    TakeAxes,
    snapped_to,
    table_entry,
)
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.lines import Line, common_normal
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.session.edits import SetCell, SetEnd
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.session import Session, Undo
from armlab.session.share import state_of_parts
from armlab.session.state import State, apply
from support.done import done

PUMA = catalogue()["puma560"]


@pytest.fixture
def state():
    return State.initial(PUMA)


@pytest.mark.parametrize("kind", ["skew", "parallel", "intersecting", "coincident"])
def test_each_case_can_be_chosen_for_every_arm(kind, robot):
    state = apply(State.initial(robot), PlaceLines(kind))
    normal = state[Lines].normal
    assert normal.kind == kind
    assert (normal.a > 0.0) == (kind in ("skew", "parallel"))


def test_a_drag_moves_one_line_and_is_one_step_of_undo():
    session = Session.fresh("token", PUMA)
    before = session.state
    line, other = before[Lines].second, before[Lines].first
    drag = object()
    for k in range(1, 11):
        session.apply(DragLine(1, line.point + np.array([0.0, 0.0, 0.02 * k]), line.direction, drag), 0.05 * k)
    lines = session.state[Lines]
    np.testing.assert_allclose(lines.second.point, line.point + np.array([0.0, 0.0, 0.2]), atol=1e-12)
    assert lines.first is other
    assert lines.normal.kind == "skew"
    assert not lines.snapped
    session.apply(Undo(), 9.0)
    assert session.state[Lines] is before[Lines]


def test_nearly_parallel_becomes_parallel_either_way_round(state, rng):
    state = apply(state, PlaceLines("skew"))
    first = state[Lines].first
    for sense in (1.0, -1.0):
        side = np.cross(first.direction, rng.normal(size=3))
        turn = rotation_from_axis_angle(side, 0.9 * SNAP_ANGLE)
        nearly = sense * (turn @ first.direction)
        lines = apply(state, DragLine(1, state[Lines].second.point, nearly, 1))[Lines]
        assert lines.snapped
        assert lines.normal.kind == "parallel"
        np.testing.assert_allclose(lines.second.direction, sense * first.direction, atol=1e-15)
        np.testing.assert_array_equal(lines.second.point, state[Lines].second.point)


@pytest.mark.parametrize("seed", range(20))
def test_nearly_meeting_lines_meet_and_others_are_left_alone(seed):
    rng = np.random.default_rng(seed)
    other = Line(rng.normal(size=3), rng.normal(size=3))
    z = rng.normal(size=3)
    scale = 1.7
    normal = np.cross(other.direction, z)
    normal /= np.linalg.norm(normal)
    meeting = other.point + rng.normal() * other.direction + rng.normal() * z / np.linalg.norm(z)
    near = Line(meeting + 0.9 * SNAP_DISTANCE * scale * normal, z)
    far = Line(meeting + 1.1 * SNAP_DISTANCE * scale * normal, z)
    snapped = snapped_to(other, near, scale)
    assert common_normal(other, snapped, scale=scale).kind == "intersecting"
    np.testing.assert_allclose(snapped.direction, near.direction, atol=1e-15)
    assert snapped_to(other, far, scale) is far
    assert snapped_to(other, snapped, scale) is snapped or np.allclose(
        snapped_to(other, snapped, scale).point, snapped.point, atol=1e-12
    )


def test_nearly_the_same_becomes_the_same(state):
    first = state[Lines].first
    tilt = rotation_from_axis_angle([1.0, 0.2, 0.0], 0.5 * SNAP_ANGLE)
    point = first.point + 0.3 * first.direction + 0.5 * SNAP_DISTANCE * state[Lines].scale * np.array([0.8, 0.6, 0.0])
    lines = apply(state, DragLine(1, point, tilt @ first.direction, 1))[Lines]
    assert lines.normal.kind == "coincident"
    assert lines.snapped


def test_axes_of_the_arm_give_a_and_alpha_of_its_table(robot):
    state = State.initial(robot)
    for pair in range(robot.arm.n - 1):
        state = apply(state, TakeAxes(pair))
        normal = state[Lines].normal
        row, a, alpha = table_entry(state)
        assert row == (pair if robot.arm.convention == "standard" else pair + 1)
        assert normal.a == pytest.approx(abs(a), abs=1e-9)
        sign = -1.0 if a < 0.0 else 1.0
        differences = [abs(math.remainder(normal.alpha - way * alpha, 2.0 * math.pi)) for way in (sign, -sign)]
        # Lines that meet have a normal of either sense: alpha up to its sign.
        allowed = differences[:1] if normal.a > 1e-9 else differences
        assert min(allowed) < 1e-9


def test_axes_follow_the_arm_until_a_line_is_dragged(state):
    state = apply(apply(state, TakeAxes(1)), MoveJoint(0, 0.9))
    frames = state[Joints].frames
    np.testing.assert_array_equal(state[Lines].first.point, frames[1][:3, 3])
    np.testing.assert_allclose(state[Lines].second.direction, frames[2][:3, 2], atol=1e-15)
    longer = apply(state, SetCell(1, "a", 0.7))
    assert longer[Lines].normal.a == pytest.approx(0.7)
    own = apply(state, DragLine(0, [0.1, 0.2, 0.3], [0.0, 0.0, 1.0], 1))
    assert own[Lines].pair is None
    assert table_entry(own) is None
    assert apply(own, MoveJoint(0, 0.1))[Lines] is own[Lines]


def test_lines_of_ones_own_stay_where_the_axes_were(state):
    taken = apply(state, TakeAxes(1))
    own = apply(taken, KeepLines())
    assert own[Lines].pair is None
    assert own[Lines].second is taken[Lines].second
    assert apply(own, MoveJoint(0, 0.1))[Lines] is own[Lines]
    assert apply(own, KeepLines()) is own


def test_what_cannot_be_is_refused(state):
    for point in ([math.nan, 0.0, 0.0], [1e6, 0.0, 0.0]):
        with pytest.raises(InputError, match="within"):
            apply(state, DragLine(0, point, [0.0, 0.0, 1.0], 1))
    with pytest.raises(InputError, match="direction"):
        apply(state, DragLine(0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], 1))
    with pytest.raises(InputError, match="expected 0 to 1, got 2"):
        apply(state, DragLine(2, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1))
    with pytest.raises(UnknownName):
        apply(state, PlaceLines("crossed"))
    with pytest.raises(UnknownName):
        apply(state, HandleLines("pull"))
    with pytest.raises(InputError, match="expected 1 to 5, got 6"):
        apply(state, TakeAxes(5))


def test_another_arm_gets_lines_of_its_own_size(state):
    state = apply(apply(state, HandleLines("turn")), ChooseRobot("canadarm2"))
    lines = state[Lines]
    assert lines.handle == "turn"
    assert lines.normal.a > 1.0
    assert np.linalg.norm(lines.first.point - state[Joints].arm.base[:3, 3]) < lines.scale


def read_back(state):
    return state_of_parts(json.loads(json.dumps(state.to_json())))


def small(state):
    """The state with a planar 3R arm of links of 40, 25 and 20 mm."""
    return done(state, *(SetCell(i, "a", a) for i, a in enumerate((0.04, 0.025, 0.02))))


def at_90_metres(state):
    """The state with the base far away."""
    base = np.eye(4)
    base[0, 3] = 90.0
    return apply(state, SetEnd("base", base))


@pytest.mark.parametrize("edited", [small, at_90_metres])
def test_lines_come_along_where_an_edit_leaves_them_too_far_away(edited):
    state = edited(apply(State.initial(catalogue()["planar_3r"]), HandleLines("turn")))
    lines = state[Lines]
    assert lines.handle == "turn"
    assert np.linalg.norm(lines.first.point - state[Joints].arm.base[:3, 3]) < lines.scale
    np.testing.assert_array_equal(read_back(state)[Lines].first.point, lines.first.point)
    on_axes = edited(apply(State.initial(catalogue()["planar_3r"]), TakeAxes(1)))
    assert on_axes[Lines].pair == 1
    np.testing.assert_array_equal(on_axes[Lines].first.point, on_axes[Joints].frames[1][:3, 3])


def test_saved_lines_too_far_away_are_read_as_the_first_ones():
    state = small(State.initial(catalogue()["planar_3r"]))
    first = state[Lines].first
    far = state.replace(replace(state[Lines], first=Line([5.0, 0.0, 0.0], first.direction), handle="turn"))
    np.testing.assert_array_equal(read_back(far)[Lines].first.point, first.point)
    assert read_back(far)[Lines].handle == "turn"


def test_they_are_written_and_read_and_damage_is_noticed(state):
    part = apply(apply(state, TakeAxes(2)), HandleLines("turn"))[Lines]
    data = json.loads(json.dumps(part.to_json()))
    again = Lines.from_json(data, PUMA)
    np.testing.assert_array_equal(again.first.point, part.first.point)
    np.testing.assert_allclose(again.second.direction, part.second.direction, atol=1e-15)
    assert (again.pair, again.handle, again.normal.kind) == (2, "turn", part.normal.kind)
    with pytest.raises(InputError):
        Lines.from_json({**data, "pair": 5}, PUMA)
    with pytest.raises(InputError):
        Lines.from_json({**data, "lines": [[[0, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 1]]]}, PUMA)
