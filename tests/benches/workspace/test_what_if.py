"""What if: an arm in thought, what its workspace would be, and taking it over."""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

import armlab
from armlab.benches.workspace.what_if import found as what_if_found
from armlab.benches.workspace.what_if.arm import LIMITS, TOOL, Change, altered, fields_of, span_of, turns, value_of
from armlab.benches.workspace.what_if.facts import FACTS
from armlab.benches.workspace.what_if.found import Question, comparing
from armlab.benches.workspace.what_if.job import JOB, PAGE, compared, delivered, wanted
from armlab.benches.workspace.what_if.state import ChooseQuantity, ForgetChanges, Suppose, TakeOver, WhatIf, is_present
from armlab.benches.workspace.what_if.view import parts_of, thought_pose
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.sections import _kept
from armlab.session.edits import SetCell
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State, apply
from support.done import done

OPEN = frozenset({PAGE})


def opened(key, *commands):
    return done(State.initial(catalogue()[key]), *commands)


def found_of(key, *commands):
    found = compared(opened(key, *commands))[WhatIf].found
    assert found is not None
    return found


# -- the arm in thought ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "panda", "scara", "cartesian_3p"])
def test_what_is_taken_over_is_the_arm_that_was_thought_of(key):
    arm, rng = armlab.load(key), np.random.default_rng(1)
    state = opened(key)
    for row in range(arm.n + 1):
        for field in fields_of(arm, row):
            step = rng.uniform(0.01, 0.04) * (-1 if field == "high" else 1)
            state = apply(state, Suppose(row, field, value_of(arm, row, field) + step))
    other = state[WhatIf].other
    assert len(state[WhatIf].changes) == 5 * arm.n + 3
    taken = apply(state, TakeOver())
    edited = taken[RobotPart].robot.arm
    assert edited.rows == other.rows
    np.testing.assert_array_equal(edited.limits, other.limits)
    np.testing.assert_allclose(edited.tool, other.tool, atol=1e-15)
    assert edited.task == other.task
    assert taken[WhatIf].changes == ()
    assert taken[WhatIf].arm is taken[WhatIf].other is edited


def test_taking_over_is_one_step_of_undo_and_the_page_follows():
    session = Session.fresh("x", catalogue()["planar_2r"])
    session.apply(Suppose(0, "a", 1.5), 0.0)
    session.apply(Suppose(1, "low", -1.0), 0.0)
    assert session.history.past == []
    session.apply(TakeOver(), 0.0)
    assert session.state[RobotPart].robot.arm.rows[0].a == 1.5
    assert session.state[RobotPart].robot.arm.limits[1, 0] == -1.0
    assert session.history.undo_label == "what if"
    session.apply(Undo(), 0.0)
    assert session.state[RobotPart].robot.arm.rows[0].a == 1.0
    for _ in range(2):  # what was changed in thought is there again, to be changed on
        part = session.state[WhatIf]
        assert part.arm is session.state[RobotPart].robot.arm
        assert part.changes == (Change(0, "a", 1.5), Change(1, "low", -1.0))
        assert part.other.rows[0].a == 1.5
        session.apply(Redo(), 0.0)
        assert session.state[WhatIf].changes == ()
        session.apply(Undo(), 0.0)
    session.apply(SetCell(0, "a", 1.1), 0.0)
    assert session.state[WhatIf].changes == ()


def test_nothing_is_taken_over_where_nothing_was_changed():
    with pytest.raises(InputError, match="there are no changes to apply"):
        apply(opened("planar_2r"), TakeOver())


def test_at_hand_is_first_the_longest_link_of_an_arm_without_any_the_longest_offset():
    assert (opened("puma560")[WhatIf].row, opened("puma560")[WhatIf].field) == (1, "a")
    stanford = opened("stanford")[WhatIf]
    assert stanford.field == "d"
    longest = max(abs(row.d) for row in stanford.arm.rows if row.revolute)
    assert abs(value_of(stanford.arm, stanford.row, "d")) == longest


def test_a_change_back_to_what_it_is_is_none():
    state = opened("planar_2r", Suppose(0, "a", 1.3), Suppose(1, "a", 0.7), Suppose(0, "a", 1.4))
    assert state[WhatIf].changes == (Change(0, "a", 1.4), Change(1, "a", 0.7))
    assert state[WhatIf].other.rows[0].a == 1.4
    state = apply(state, Suppose(0, "a", 1.0))
    assert state[WhatIf].changes == (Change(1, "a", 0.7),)
    state = apply(state, ForgetChanges())
    assert state[WhatIf].changes == ()
    assert state[WhatIf].other is state[WhatIf].arm


def test_another_joint_keeps_the_kind_of_number_it_has():
    state = opened("scara", ChooseQuantity(0, "d"))
    assert (apply(state, ChooseQuantity(1))[WhatIf].field) == "d"
    prismatic = next(i for i in range(4) if not catalogue()["scara"].arm.revolute[i])
    assert apply(state, ChooseQuantity(prismatic))[WhatIf].field == "a"
    assert apply(state, ChooseQuantity(4))[WhatIf].field == "x"


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (ChooseQuantity(3, "a"), "joint: expected 1 to 2, or 3 for the tool, got 4"),
        (ChooseQuantity(0, "theta"), "a, alpha, d, high, low"),
        (Suppose(2, "a", 1.0), "x, y, z"),
        (Suppose(0, "low", 4.0), "the smaller comes first"),
        (Suppose(0, "a", 1e4), "expected at most 100 m"),
        (Suppose(0, "a", math.nan), "expected a number"),
    ],
)
def test_what_no_arm_can_be_is_refused(command, says):
    with pytest.raises(InputError, match=says):
        apply(opened("planar_2r"), command)


@pytest.mark.parametrize("key", ["planar_2r", "scara", "stanford", "cartesian_3p", "puma560", "panda", "canadarm2"])
def test_every_value_in_the_span_of_a_slider_makes_an_arm(key):
    arm = armlab.load(key)
    for row in range(arm.n + 1):
        for field in fields_of(arm, row):
            low, high = span_of(arm, arm, row, field)
            assert low < high
            assert low <= value_of(arm, row, field) <= high
            angle = field in ("alpha", "theta") or (field in LIMITS and bool(arm.revolute[row]))
            assert turns(arm, row, field) == angle
            for value in (low, 0.5 * (low + high), high):
                other = altered(arm, [Change(row, field, value)])
                assert value_of(other, row, field) == pytest.approx(value)
                assert turns(arm, row, field) == (
                    field in ("alpha", "theta") or (field in LIMITS and arm.revolute[row])
                )


def test_a_value_beyond_the_slider_makes_it_longer():
    arm = armlab.load("planar_2r")
    assert span_of(arm, arm, 0, "a") == (0.0, 2.0)
    assert span_of(arm, altered(arm, [Change(0, "a", 7.0)]), 0, "a") == (0.0, 7.0)
    assert span_of(arm, arm, 2, TOOL[2]) == (-0.5 * arm.reach, 0.5 * arm.reach)


def test_it_is_written_down_and_read_back():
    state = opened("puma560", Suppose(1, "a", 0.5), Suppose(2, "high", 1.0), ChooseQuantity(6, "z"))
    part = state[WhatIf]
    again = WhatIf.from_json(part.to_json(), state[RobotPart].robot)
    assert (again.row, again.field, again.changes) == (6, "z", part.changes)
    assert again.other.rows == part.other.rows
    with pytest.raises(InputError):
        WhatIf.from_json({"row": 9, "field": "a", "changes": []}, state[RobotPart].robot)
    with pytest.raises(InputError):
        WhatIf.from_json({"row": 0, "field": "a", "changes": [[0, "a", 1e9]]}, state[RobotPart].robot)


def test_another_arm_and_an_edited_table_begin_anew():
    state = opened("puma560", ChooseQuantity(2, "a"), Suppose(2, "a", 0.5), SetCell(1, "a", 0.6))
    assert (state[WhatIf].row, state[WhatIf].field, state[WhatIf].changes) == (2, "a", ())
    assert state[WhatIf].arm is state[RobotPart].robot.arm
    state = apply(state, ChooseRobot("planar_2r"))
    assert state[WhatIf].arm is catalogue()["planar_2r"].arm


# -- the two workspaces ------------------------------------------------------------------------------------------


def test_a_longer_link_of_a_full_2r_gives_the_area_of_its_disc():
    found = found_of("planar_2r", Suppose(1, "a", 0.5))
    before, after = (each.size for each in found.figures)
    lengths = [row.a for row in found.before.rows]
    for size, (a, b) in ((before, lengths), (after, (lengths[0], 0.5))):
        exact = math.pi * ((a + b) ** 2 - (a - b) ** 2)
        assert size.unit == "m²"
        assert abs(size.value - exact) <= size.error
        assert size.error < 0.01 * exact
    assert found.figures[1].reach.outer == pytest.approx(lengths[0] + 0.5, abs=0.01)
    assert found.figures[1].reach.inner == pytest.approx(lengths[0] - 0.5, abs=0.01)
    # What is lost lies in the hole or beyond the shorter reach; nothing is gained.
    assert found.gained.sum() == 0
    r = np.hypot(*found.old.points[found.lost][:, :2].T)
    assert np.all((r < lengths[0] - 0.5 + 0.03) | (r > lengths[0] + 0.5 - 0.03))
    inside = np.hypot(*found.old.points[~found.lost][:, :2].T)
    assert np.all((inside > lengths[0] - 0.5 - 0.03) & (inside < lengths[0] + 0.5 + 0.03))


def test_the_outer_reach_is_a_fact_where_joint_1_turns_only():
    turns, slides = (compared(opened(key, Suppose(1, "high", 0.5))) for key in ("planar_2r", "cartesian_3p"))
    for name in ("outer_before", "outer_after"):
        assert FACTS.facts[name].now(turns).value == pytest.approx(2.0, abs=0.1)
        assert FACTS.facts[name].now(slides).value is None
    assert FACTS.facts["size_after"].now(slides).value is not None


def test_a_narrower_limit_of_a_box_takes_away_its_part():
    arm = armlab.load("cartesian_3p")
    low, high = arm.limits[1].tolist()
    found = found_of("cartesian_3p", Suppose(1, "high", 0.5 * (low + high)))
    before, after = (each.size.value for each in found.figures)
    assert before == pytest.approx(np.prod(arm.limits[:, 1] - arm.limits[:, 0]), rel=0.01)
    assert after / before == pytest.approx(0.5, abs=0.01)
    assert found.lost.mean() == pytest.approx(0.5, abs=0.03)
    # What is told wrong lies within a cell of the boundary: next to nothing.
    assert found.gained.mean() < 0.002


@pytest.mark.parametrize(("key", "row"), [("scara", 0), ("elbow_3r", 0), ("polar_rrp", 0)])
def test_narrower_limits_gain_nothing_also_on_the_boundary_of_both_workspaces(key, row):
    low, high = armlab.load(key).limits[row].tolist()
    found = found_of(key, Suppose(row, "high", high - 0.2 * (high - low)))
    assert found.told_apart
    assert found.gained.sum() == 0


def test_of_two_lines_or_surfaces_no_point_is_said_to_be_gained_or_lost():
    """Nothing but where it ends changes on the arc of a single joint."""
    arc = State.initial(own_robot(armlab.Arm.from_dh([("R", 0.5, 0.0, 0.0, 0.0)]), "One joint"))
    state = compared(apply(arc, Suppose(0, "high", 1.0)))
    found, parts = state[WhatIf].found, state.derived(parts_of)
    assert found.finished
    assert not found.told_apart
    assert (len(parts.kept), len(parts.thought)) == (len(found.old.points), len(found.new.points))
    assert len(parts.gained) == len(parts.lost) == 0
    # A line beside an area is not in it, but for some of its points.
    wider = compared(apply(arc, Suppose(1, "x", 0.3)))[WhatIf].found
    assert not wider.told_apart
    area = compared(opened("planar_2r", Suppose(1, "a", 0.0)))[WhatIf].found
    assert area.told_apart
    assert area.lost.mean() > 0.99


@cache
def longer_puma():
    """Return a Puma with a longer link, what comes of it piece by piece, and the same once it is remembered."""
    state = opened("puma560", Suppose(1, "a", 0.6))
    for remembered in (what_if_found._known, _kept):
        remembered.cache_clear()
    question = Question(state[WhatIf].arm, state[WhatIf].other)
    first, again = ([each for each in comparing(question) if each is not None] for _ in range(2))
    return state, first, again


def test_points_come_first_and_everything_gets_better():
    _, kinds, again = longer_puma()
    sizes = [len(each.new.points) for each in kinds]
    assert sizes[:2] == [4096, 24_576]
    assert all(one <= other for one, other in pairwise(sizes))
    assert kinds[0].figures[0].size is None
    rough = next(each for each in kinds if each.figures[1].size is not None)
    assert not rough.figures[0].refined
    assert not rough.figures[1].refined
    last = kinds[-1]
    assert last.finished
    assert all(each.refined for each in last.figures)
    for of_samples, of_boundary in zip(kinds[0].figures, last.figures, strict=True):
        assert of_samples.reach.outer <= of_boundary.reach.outer + 1e-6
    for one, other in zip(rough.figures, last.figures, strict=True):
        assert one.size.value == pytest.approx(other.size.value, rel=0.15)
    assert again[0].new is last.new
    assert again[-1].figures == last.figures


def test_every_drawn_point_obeys_the_limits_it_belongs_to():
    part = opened("puma560", Suppose(1, "high", 1.0), Suppose(0, "low", -1.0))[WhatIf]
    drawn = (each for each in comparing(Question(part.arm, part.other)) if each is not None)
    found = next(each for each in drawn if len(each.new.points) == what_if_found.POINTS)
    assert len(found.old.points) == what_if_found.POINTS
    for arm, cloud in ((found.before, found.old), (found.after, found.new)):
        q = cloud.q.astype(float)
        assert np.all((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1]))
        np.testing.assert_allclose(cloud.points, arm.position(q), atol=1e-5)


def test_the_job_wants_nothing_while_the_page_is_closed_or_all_is_known():
    state = opened("planar_2r", Suppose(0, "a", 1.2))
    assert wanted(state, frozenset()) is None
    assert wanted(state, OPEN) is not None
    known = compared(state)
    assert is_present(known)
    assert wanted(known, OPEN) is None
    changed = apply(known, Suppose(0, "a", 1.3))
    assert not is_present(changed)
    assert wanted(changed, OPEN).key != wanted(state, OPEN).key
    assert JOB.wanted is wanted


def test_what_was_found_of_an_arm_that_is_not_thought_of_any_more_is_let_go():
    state = opened("planar_2r", Suppose(0, "a", 1.2))
    question = wanted(state, OPEN).inputs
    found = next(each for each in comparing(question) if each is not None)
    assert delivered(state, question, found)[WhatIf].found is found
    later = apply(state, Suppose(0, "a", 1.3))
    assert delivered(later, question, found) is later


# -- what is drawn -----------------------------------------------------------------------------------------------


def test_points_are_kept_gained_or_lost_and_the_half_in_front_is_left_away():
    state, kinds, _ = longer_puma()
    state = state.replace(replace(state[WhatIf], found=kinds[-1]))
    found, parts = state[WhatIf].found, state.derived(parts_of)
    assert len(parts.thought) == 0
    assert 0 < len(parts.gained) < found.gained.sum()
    assert 0 < len(parts.kept) < (~found.lost).sum()
    assert not np.any(found.sections[0].holds(parts.gained))
    planar = compared(opened("planar_2r", Suppose(0, "a", 1.2)))
    assert first_joint(planar[WhatIf].arm).planar
    everything = planar.derived(parts_of)
    assert len(everything.kept) + len(everything.lost) == len(planar[WhatIf].found.old.points)


def test_the_arm_in_thought_stands_as_the_arm_does_inside_its_own_limits():
    state = opened("planar_2r", MoveJoint(1, 1.0))
    assert state.derived(thought_pose) is None
    state = apply(state, Suppose(1, "high", 0.4))
    q = state.derived(thought_pose)
    assert q[0] == state[Joints].q[0]
    assert q[1] == 0.4
