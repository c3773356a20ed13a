"""The study of orientations of a student: what is asked, delivered in pieces, stopped, looked at, clicked."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from armlab.benches.workspace.dexterous.job import delivered, wanted
from armlab.benches.workspace.dexterous.job import studied as studied_anew
from armlab.benches.workspace.dexterous.picture import at_tool, body_shown, largest_share, slice_shown
from armlab.benches.workspace.dexterous.state import (
    COUNTS,
    Dexterous,
    GoToSlice,
    LookThroughTool,
    ResumeDexterous,
    StopDexterous,
    orientation_of,
    question_of,
    rings_alone,
    slice_of,
    study_of,
)
from armlab.benches.workspace.dexterous.study import (
    methods,
    misses_orientations,
    never_turns,
    studying,
    turns_in_place,
    why_sampled_alone,
)
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import lengths_of, planar_workspace
from armlab.kin.wrist import wrist_centre
from armlab.session.edits import SetCell, SetKind, SetLimits
from armlab.session.field_words import SetFields
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import State, apply

OPEN = frozenset({"dexterous"})


def state_of(key, **settings):
    """Return the state with an arm of the catalogue, few samples, and these settings."""
    return apply(State.initial(catalogue()[key]), SetFields.of(Dexterous, **{"count": COUNTS[0], **settings}))


@cache
def study(question):
    """Return all that is found to a question: many tests look at the same arms."""
    return [found for found in studying(question) if found is not None][-1]


def studied(state):
    """Return the state with everything found, from before if another test has asked the same."""
    question = question_of(state)
    return state if question is None else delivered(state, question, study(question))


def limited():
    """Return a state with a planar 3R whose joints do not turn all the way round."""
    arm = catalogue()["planar_3r"].arm
    tight = Arm.from_dh(arm.rows, limits=[[-2.5, 2.5], [-2.0, 2.0], [-1.5, 1.5]], task=arm.task)
    return apply(State.initial(own_robot(tight, "tight")), Set(Dexterous, "count", COUNTS[0]))


@pytest.mark.parametrize(
    ("key", "wanted"),
    [
        ("planar_3r", ("rings", "sampled", "count")),
        ("puma560", ("wrist", "sampled", "count")),
        ("ur5e", ("sampled", "count")),
        ("panda", ("sampled",)),
        ("elbow_3r", ("sampled", "count")),
    ],
)
def test_what_can_be_asked_follows_from_the_arm(key, wanted):
    assert methods(catalogue()[key].arm) == wanted


WRIST = [("R", 0.0, np.pi / 2, 0.0, 0.0), ("R", 0.0, -np.pi / 2, 0.0, 0.0)]


@pytest.mark.parametrize("hand", [0.0, 0.1])
@pytest.mark.parametrize(
    "front",
    [
        [("P", 0.0, 0.0, 0.0, 0.0)],
        [("R", 0.5, 0.3, 0.2, 0.0)],
        [("R", 0.0, np.pi / 2, 0.3, 0.0), ("R", 0.4, -np.pi / 2, 0.0, 0.0)],
        [("R", 0.4, 0.0, 0.0, 0.0), ("R", 0.3, 0.0, 0.0, 0.0), ("R", 0.2, 0.5, 0.0, 0.0)],
    ],
)
def test_a_wrist_whose_centre_stays_on_a_line_or_a_surface_has_no_shares_of_the_directions(front, hand):
    arm = Arm.from_dh([*front, *WRIST, ("R", 0.0, 0.0, hand, 0.0)])
    assert wrist_centre(arm) is not None
    assert methods(arm) == ("sampled",)
    assert "keep its centre on a line or a surface; not by Solutions" in why_sampled_alone(arm)


def test_it_is_computed_while_the_page_is_seen_and_once():
    state = state_of("puma560")
    assert wanted(state, frozenset({"workspace"})) is None
    first = wanted(state, OPEN)
    assert first.inputs.method == "wrist"
    state = studied_anew(state)
    assert wanted(state, OPEN) is None
    state = apply(state, Set(Dexterous, "method", "sampled"))
    assert wanted(state, OPEN).key != first.key
    # What was found before is there at once when it is looked at again.
    state = apply(studied(state), Set(Dexterous, "method", "wrist"))
    assert wanted(state, OPEN) is None
    assert study_of(state).finished


def test_the_closed_form_alone_needs_no_work():
    state = state_of("planar_3r")
    assert rings_alone(state)
    assert question_of(state) is None
    assert wanted(state, OPEN) is None
    assert slice_shown(state) is None


def test_with_joint_limits_a_planar_arm_is_sampled_beside_the_closed_form():
    state = limited()
    assert not rings_alone(state)
    assert question_of(state).method == "sampled"
    state = studied(state)
    arm, shown = state[Joints].arm, slice_shown(state)
    there = np.argwhere(np.isfinite(shown.values))
    centres = shown.corner + (there + 0.5) @ (shown.step * np.array([shown.right, shown.up]))
    r = first_joint(arm).split(centres)[:, 0]
    assert r.max() <= planar_workspace(lengths_of(arm)).outer + shown.step
    assert np.nanmax(shown.values) < 1.0


def test_it_comes_in_pieces_and_is_let_go_for_another_arm_or_when_stopped():
    state = state_of("ur5e")
    question = question_of(state)
    found = [one for one in studying(question) if one is not None]
    assert 4 <= len(found) < 40
    assert [one.finished for one in found] == [False] * (len(found) - 1) + [True]
    done = [one.done for one in found]
    assert done == sorted(done)
    stopped = apply(state, StopDexterous())
    assert wanted(stopped, OPEN) is None
    assert delivered(stopped, question, found[0]) is stopped
    assert wanted(apply(stopped, ResumeDexterous()), OPEN).key == question
    other = apply(state, ChooseRobot("ur3e"))
    assert delivered(other, question, found[-1]) is other
    assert apply(delivered(state, question, found[-1]), ChooseRobot("ur3e"))[Dexterous].found == {}


def test_the_slice_goes_through_the_tool_when_asked_and_a_full_turn_needs_no_new_samples():
    state = studied(state_of("ur5e"))
    state = apply(state, MoveJoint(0, 1.0))
    before = study_of(state)
    state = apply(state, LookThroughTool())
    assert study_of(state) is before
    tool = state[Joints].tool_pose[:3, 3]
    shown = slice_shown(state)
    assert abs(np.cross(shown.right, shown.up) @ (tool - shown.corner)) < 1e-9
    # The limits of the first joint of this one take more away on one side than on another.
    state = apply(studied(state_of("puma560", method="sampled")), Set(Dexterous, "s", 2.5))
    assert study_of(state) is None


@pytest.mark.parametrize("key", ["puma560", "ur5e", "scara", "cartesian_3p"])
def test_a_click_on_a_sampled_slice_puts_the_tool_into_that_cell(key):
    state = studied(state_of(key, method="sampled"))
    state = (
        apply(state, Set(Dexterous, "s", slice_of(state))) if key != "ur5e" else apply(state, Set(Dexterous, "s", 0.9))
    )
    shown = slice_shown(state)
    cells = np.argwhere(np.isfinite(shown.values))
    for cell in cells[:: len(cells) // 6]:
        point = shown.corner + shown.step * (cell[0] + 0.5) * shown.right + shown.step * (cell[1] + 0.5) * shown.up
        normal = np.cross(shown.right, shown.up)
        hit = shown.met(point + normal, -normal)
        np.testing.assert_allclose(hit, point, atol=1e-9)
        now = apply(state, GoToSlice(tuple(hit)))
        away = now[Joints].tool_pose[:3, 3] - point
        assert np.abs([away @ shown.right, away @ shown.up]).max() <= 0.501 * shown.step
        assert abs(away @ normal) < 1e-4
        assert at_tool(now).value > 0.0


def test_a_line_of_sight_past_the_slice_or_away_from_it_meets_nothing():
    shown = slice_shown(studied(state_of("ur5e")))
    normal = np.cross(shown.right, shown.up)
    assert shown.met(shown.corner - 5.0 * shown.right + normal, -normal) is None
    assert shown.met(shown.corner + normal, normal) is None
    assert shown.met(shown.corner + normal, shown.right) is None


def test_held_joints_stay_on_a_click_and_the_tool_comes_another_way():
    state = studied(state_of("planar_3r", method="sampled"))
    held = apply(state, LockJoint(0, True))
    q = np.array([held[Joints].q[0], 0.9, 0.7])
    wanted = held[Joints].arm.position(q)
    now = apply(held, GoToSlice(tuple(wanted.tolist())))
    assert now[Joints].q[0] == q[0]
    assert np.linalg.norm(now[Joints].tool_pose[:3, 3] - wanted) < 2.0 * slice_shown(state).step


def test_where_no_sample_is_the_arm_stays():
    state = studied(state_of("ur5e"))
    with pytest.raises(InputError, match="no sample"):
        apply(state, GoToSlice((9.0, 9.0, 9.0)))


def test_a_click_on_solutions_goes_there_with_the_tool_turned_as_they_were_counted():
    state = studied(state_of("planar_3r_unequal", method="count"))
    R = np.reshape(orientation_of(state), (3, 3))
    state = apply(state, RandomPose())
    state = apply(state, GoToSlice((-1.0, 0.7, 0.0)))
    np.testing.assert_allclose(state[Joints].tool_pose[:3, 3], [-1.0, 0.7, 0.0], atol=1e-5)
    np.testing.assert_allclose(state[Joints].tool_pose[:3, :3], R, atol=1e-4)
    assert at_tool(state).value == 2.0
    turned = apply(state, MoveJoint(2, 0.9))
    assert study_of(turned) is study_of(state)
    assert study_of(apply(turned, LookThroughTool())) is None


@pytest.mark.parametrize(("q3", "ways"), [(0.0, 2), (0.02, 4), (0.05, 4), (1.0, 4)])
def test_the_number_of_solutions_at_the_tool_is_of_its_place_and_not_of_its_cell(q3, ways):
    state = studied(state_of("elbow_3r", method="count"))
    state = state.replace(state[Joints].moved_to(np.array([0.3, 0.4, q3])))
    assert study_of(state).finished
    assert at_tool(state).value == ways


def test_the_wrist_is_shown_as_a_slice_or_as_a_body_cut_open():
    state = studied(state_of("irb140"))
    wrist = study_of(state).wrist
    shown = slice_shown(state)
    cell = np.unravel_index(np.nanargmax(shown.values), shown.values.shape)
    point = shown.corner + shown.step * ((cell[0] + 0.5) * shown.right + (cell[1] + 0.5) * shown.up)
    assert wrist.at(point) == pytest.approx(shown.values[cell], abs=1e-6)
    assert body_shown(state) is None
    bodies = [
        body_shown(apply(state, SetFields.of(Dexterous, draw="body", share=share))).sum() for share in (0.25, 0.5, 0.75)
    ]
    assert bodies[0] > bodies[1] > bodies[2] > 0
    assert bodies[0] < 0.7 * (wrist.fraction > 0.25).sum()
    here = at_tool(state)
    assert here.of == 2048
    assert here.value == pytest.approx(float(wrist.at(state[Joints].tool_pose[:3, 3])), abs=0.05)


@pytest.mark.parametrize("q1", [(-180, 180), (-90, -10)])
def test_a_body_is_cut_open_where_enough_of_it_lies_behind_the_arm_and_else_drawn_whole(q1):
    state = apply(state_of("irb140", draw="body", share=0.5), SetLimits(0, *np.radians(q1)))
    state = studied(apply(state, SetLimits(1, 0.0, math.pi / 2)))
    drawn, body = body_shown(state), study_of(state).wrist.fraction > 0.5
    assert drawn.sum() >= 0.4 * body.sum() > 0
    assert np.array_equal(drawn, body) == (q1[1] < 90)


# -- settings --------------------------------------------------------------------------------------------------------


def test_settings_are_written_down_and_read_back():
    state = apply(state_of("puma560", draw="body", share=0.5, method="count"), LookThroughTool())
    robot = catalogue()["puma560"]
    data = state[Dexterous].to_json()
    again = Dexterous.from_json(data, robot)
    assert again.to_json() == data
    assert replace(state[Dexterous], found={}, stopped=None).s == again.s
    for name, value in (("method", "rings"), ("share", 0.3), ("count", 7), ("draw", "cube"), ("s", math.nan)):
        with pytest.raises((InputError, UnknownName)):
            Dexterous.from_json({**data, name: value}, robot)
    with pytest.raises(InputError, match="nine"):
        Dexterous.from_json({**data, "turned": [1.0, 2.0]}, robot)


@pytest.mark.parametrize("turns", [-7, -1, 0, 1, 2_777_777])
def test_the_angle_of_a_slice_is_within_one_turn(turns):
    state = apply(state_of("ur5e"), SetFields.of(Dexterous, s=0.9 + turns * math.tau))
    assert slice_of(state) == pytest.approx(0.9, abs=1e-8)
    assert slice_of(apply(state, Set(Dexterous, "s", -math.pi))) == math.pi


def test_a_slice_at_an_angle_is_not_one_at_a_distance_of_another_kind_of_joint():
    state = apply(state_of("elbow_3r"), Set(Dexterous, "s", 3.0))
    assert apply(state, SetCell(1, "a", 1.1))[Dexterous].s == 3.0
    assert apply(state, SetKind(0, "P"))[Dexterous].s is None
    elbow, cartesian = catalogue()["elbow_3r"], catalogue()["cartesian_3p"]
    far = Dexterous.from_json({**state[Dexterous].to_json(), "s": 1e12}, elbow)
    assert slice_of(state.replace(far)) == pytest.approx(math.remainder(1e12, math.tau))
    data = State.initial(cartesian)[Dexterous].to_json()
    with pytest.raises(InputError, match="place of the slice"):
        Dexterous.from_json({**data, "s": 1e12}, cartesian)


def test_a_plane_beyond_the_reach_is_refused():
    state = state_of("cartesian_3p")
    reach = state[Joints].arm.reach
    assert slice_of(apply(state, SetFields.of(Dexterous, s=-0.9 * reach))) == -0.9 * reach
    with pytest.raises(InputError, match="at most"):
        apply(state, SetFields.of(Dexterous, s=1.1 * reach))


@pytest.mark.parametrize(
    ("key", "ways"),
    [("cartesian_3p", 0), ("polar_rrp", 0), ("scara", 1), ("r4", 1), ("scorbot", 2), ("puma560", 3), ("panda", 3)],
)
def test_how_far_the_tool_turns_in_place_follows_from_the_joints(key, ways):
    arm = catalogue()[key].arm
    assert turns_in_place(arm) == ways
    assert never_turns(arm) == (key == "cartesian_3p")
    assert misses_orientations(arm) == (ways < 3 and key != "scara")


def test_joints_without_a_range_turn_nothing():
    arm = catalogue()["planar_3r"].arm
    locked = Arm.from_dh(arm.rows, limits=[[-2.5, 2.5], [-2.0, 2.0], [0.5, 0.5]], task=arm.task)
    assert turns_in_place(locked) == 0
    assert not never_turns(locked)


def test_the_largest_share_is_one_that_a_voxel_has():
    most = {key: largest_share(study_of(studied(state_of(key))).wrist) for key in ("puma560", "irb140")}
    assert most == {"puma560": 0.5, "irb140": 0.75}


def test_what_is_none_of_the_choices_is_refused():
    state = state_of("ur5e")
    for command in (
        Set(Dexterous, "method", "wrist"),
        Set(Dexterous, "share", 2.0),
        Set(Dexterous, "s", math.inf),
    ):
        with pytest.raises((InputError, UnknownName)):
            apply(state, command)


def test_another_arm_keeps_how_finely_it_is_looked_at_only():
    state = apply(studied(state_of("planar_3r_unequal", method="count")), ChooseRobot("ur5e"))
    part = state[Dexterous]
    assert (part.method, part.s, part.turned, part.count) == ("", None, (), COUNTS[0])
