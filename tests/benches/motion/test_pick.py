"""Pick and place: boxes that the gripper carries, a function of the time in the plan, for every arm that can do it."""

import itertools
import json
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.files.commands import ReadMotion, ReadPlan
from armlab.benches.motion.files.read import plan_json
from armlab.benches.motion.pick.course import CLOSING, GRASP
from armlab.benches.motion.pick.facts import FACTS
from armlab.benches.motion.pick.state import (
    GOAL,
    AddBox,
    DragBox,
    MoveBox,
    Pick,
    PickAndPlace,
    RemoveBox,
    SelectBox,
    course_of,
    placed,
    places_at,
)
from armlab.benches.motion.pick.table import MOST_BOXES, edge_of, table_of
from armlab.benches.motion.pick.ui.words import told
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.points import CopyWaypoint, SetAtWaypoint, SetWaypointJoint
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about, rotation_from_sequence
from armlab.kin.transforms import transform
from armlab.session.edits import PasteTable, SetEnd
from armlab.session.history import History
from armlab.session.parts.joints import Joints
from armlab.session.state import State, apply

FEW = ["puma560", "scara", "planar_2r", "cartesian_3p", "panda", "stanford"]


def set_up(robot="puma560", *commands):
    """Return the state with boxes and plan, after further commands, planned."""
    state = State.initial(catalogue()[robot])
    for command in (PickAndPlace(), *commands):
        state = apply(state, command)
    return with_planned(state)


@pytest.mark.parametrize("robot", catalogue().found)
def test_every_arm_brings_a_box_to_the_goal_within_its_limits(robot):
    state = set_up(robot)
    planned = planned_now(state)
    assert judged(planned).kind == "ok"
    assert 2 <= len(state[Pick].boxes) <= MOST_BOXES
    assert len(state[Plan].waypoints) == 4
    assert placed(state) == 1
    said = told(state)
    assert said.kind == "ok"
    assert any("closes on box 1 and carries it" in line for line in said.lines)
    assert any("box 1 is put down at the goal" in line for line in said.lines)
    edges = edge_of(state[Joints].arm)
    for one, other in itertools.combinations([*state[Pick].boxes, state[Pick].goal], 2):
        assert np.abs(np.array(one) - other).max() >= edges


@pytest.mark.parametrize("robot", FEW)
def test_a_box_rests_goes_with_the_hand_and_rests_again(robot):
    state = set_up(robot)
    planned, arm, boxes = planned_now(state), state[Joints].arm, np.array(state[Pick].boxes)
    closes, opens = (leg.arrival for leg in (planned.legs[0], planned.legs[2]))
    for time in np.linspace(0.0, closes - 1e-6, 7):
        assert np.allclose(places_at(state, time), boxes)
    tool = arm.fk(arm.clip(planned.motion.at(closes)))
    grasp = np.linalg.inv(tool) @ [*boxes[0], 1.0]
    for time in np.linspace(closes, opens, 23)[:-1]:
        now = arm.fk(arm.clip(planned.motion.at(time))) @ grasp
        assert np.allclose(places_at(state, time)[0], now[:3], atol=1e-9)
        assert np.allclose(places_at(state, time)[1:], boxes[1:])
        assert state.derived(course_of).held(time) == 0
    for time in np.linspace(opens, planned.duration, 5):
        assert np.allclose(places_at(state, time)[0], state[Pick].goal, atol=1e-4)
        assert state.derived(course_of).held(time) is None


@pytest.mark.parametrize("turn", [(0, 0, 90), (0, 90, 0), (30, 0, 40)])
def test_an_own_scara_with_a_turned_base_and_a_tool_has_little_room_and_brings_its_box(turn):
    """Its stroke of 1 m makes boxes and lifts large, and its flange is only 0.19 m above its foot."""
    table = "a,alpha,d,theta\n325,0,200,q1\n225,180,0,q2\n0,0,d3+10,0\n0,0,0,q4"
    base = transform(rotation_from_sequence("xyz", np.radians(turn), fixed=True), [0.2, -0.1, 0.5])
    tool = transform(rotation_about("z", 0.5), [0.05, 0.0, 0.02])
    state = set_up("puma560", PasteTable(table), SetEnd("base", base), SetEnd("tool", tool), PickAndPlace())
    assert judged(planned_now(state)).kind == "ok"
    assert placed(state) == 1
    assert told(state).kind == "ok"


def test_scrubbed_backwards_everything_is_where_it_was():
    state = set_up("scara")
    end = planned_now(state).duration
    times = np.linspace(0.0, end, 41)
    forwards = [places_at(state, time) for time in times]
    mixed = np.random.default_rng(3).permutation(len(times))
    for k in (*range(len(times) - 1, -1, -1), *mixed):
        assert np.array_equal(places_at(state, times[k]), forwards[k])
    again = set_up("scara")
    assert all(np.array_equal(places_at(again, time), here) for time, here in zip(times, forwards, strict=True))


def test_the_fingers_close_in_the_wait_and_open_at_the_goal():
    state = set_up()
    planned, found = planned_now(state), set_up().derived(course_of)
    closes, opens = planned.legs[0].arrival, planned.legs[2].arrival
    assert [found.closed(t) for t in (0.0, closes - 0.01, closes + CLOSING, opens - 0.01)] == pytest.approx(
        [0.0, 0.0, 1.0, 1.0]
    )
    assert found.closed(closes + 0.5 * CLOSING) == pytest.approx(0.5)
    assert found.closed(planned.duration) == 0.0


def test_a_hand_that_misses_says_by_how_far_and_carries_nothing():
    state = set_up()
    x, _, _ = state[Pick].boxes[0]
    edge = edge_of(state[Joints].arm)
    near = with_planned(apply(state, MoveBox(0, 0, x + 0.98 * GRASP * edge)))
    assert placed(near) == 1
    missed = with_planned(apply(state, MoveBox(0, 0, x + 1.02 * GRASP * edge)))
    assert placed(missed) == 0
    said = told(missed)
    assert said.kind == "no"
    assert said.lines[0].endswith(f"closes on nothing: the middle of box 1 is {1020 * GRASP * edge:.1f} mm away")
    assert np.array_equal(places_at(missed, planned_now(missed).duration), np.array(missed[Pick].boxes))


def test_a_gripper_that_is_closed_takes_a_box_only_when_it_has_opened_again():
    state = set_up("puma560", SetAtWaypoint(0, "gripper", "close"))
    assert [(each.taken, each.shut) for each in state.derived(course_of).tries] == [(False, False), (False, True)]
    assert placed(state) == 0
    said = told(state)
    assert said.kind == "no"
    assert said.lines[1].endswith(" s: the gripper is closed already; let it open first")
    assert np.array_equal(places_at(state, planned_now(state).duration), np.array(state[Pick].boxes))
    first = set_up()[Plan].waypoints[0].q[0]
    opens = CopyWaypoint(0), SetWaypointJoint(1, 0, first + 0.1), SetAtWaypoint(1, "gripper", "open")
    again = set_up("puma560", *opens, SetAtWaypoint(0, "gripper", "close"))
    assert [(each.taken, each.shut) for each in again.derived(course_of).tries] == [(False, False), (True, False)]


def test_without_closing_and_without_opening_the_words_say_what_to_do():
    never = set_up("puma560", SetAtWaypoint(1, "gripper", "leave"))
    assert told(never).lines == ("the gripper never closes: let it close at the waypoint at a box",)
    kept = set_up("puma560", SetAtWaypoint(3, "gripper", "leave"))
    assert "box 1 is still in the gripper at the end: let it open at the goal" in told(kept).lines
    assert placed(kept) == 0


def test_a_motion_from_a_file_has_no_gripper_whatever_its_waypoints_say():
    state = set_up("puma560", SetAtWaypoint(0, "gripper", "close"))
    rows = "\n".join(f"{t},{','.join(f'{value:.6f}' for value in planned_now(state).motion.at(t))}" for t in (0.0, 1.0))
    read = with_planned(apply(state, ReadMotion(rows)))
    assert planned_now(read).grips == ()
    assert read.derived(course_of).tries == ()
    assert told(read) == ("warn", "0 of 3 boxes at the goal at the end", ())


def test_one_undo_brings_the_former_plan_and_no_boxes_back():
    before = apply(State.initial(catalogue()["puma560"]), SetWaypointJoint(1, 0, 0.3))
    after = apply(before, PickAndPlace())
    assert after[Plan].waypoints != before[Plan].waypoints
    history = History()
    history.note(before, after, PickAndPlace(), 0.0)
    restored = history.undo(after)
    assert restored[Plan] is before[Plan]
    assert restored[Pick].boxes == ()
    assert restored[Pick].goal is None


def test_boxes_are_added_typed_dragged_and_removed_and_what_cannot_be_is_refused():
    state = State.initial(catalogue()["scara"])
    for count in range(1, MOST_BOXES + 1):
        state = apply(state, AddBox())
        assert len(set(state[Pick].boxes)) == count
    assert state[Pick].boxes == table_of(catalogue()["scara"]).boxes
    with pytest.raises(InputError, match="at most 3"):
        apply(state, AddBox())
    # A box that has been nudged still stands at its place.
    nudged = apply(apply(state, RemoveBox(1)), MoveBox(0, 0, state[Pick].boxes[0][0] + 0.001))
    assert apply(nudged, AddBox())[Pick].boxes[2] == state[Pick].boxes[1]
    with pytest.raises(InputError, match="no place within reach of the arm is free; move or remove a box first"):
        apply(set_up("cartesian_3p"), AddBox())
    moved = apply(state, MoveBox(1, 2, 0.2))
    assert moved[Pick].boxes[1] == (*state[Pick].boxes[1][:2], 0.2)
    dragged = apply(moved, DragBox(GOAL, np.array([0.1, 0.2, 0.3]), object()))
    assert dragged[Pick].goal == (0.1, 0.2, 0.3)
    for command, words in (
        (MoveBox(0, 0, float("nan")), "box 1"),
        (MoveBox(0, 0, 1e9), "box 1"),
        (MoveBox(GOAL, 1, 2000.0), "goal: expected coordinates of at most 1000 m"),
        (SelectBox(7), "box 8: it is not there; there are: box 1, box 2, box 3, goal"),
        (RemoveBox(5), "box 6: it is not there"),
    ):
        with pytest.raises(InputError, match=words):
            apply(state, command)
    for _ in range(MOST_BOXES):
        state = apply(state, RemoveBox(0))
    assert (state[Pick].boxes, state[Pick].goal, state[Pick].selected) == ((), None, None)


def test_an_arm_that_brings_its_tool_nowhere_is_refused_in_words():
    turns = [("R", 0.0, twist, 0.0, 0.0) for twist in (np.pi / 2.0, -np.pi / 2.0, 0.0)]
    wrist = Arm.from_dh(turns)
    robot = replace(catalogue()["elbow_3r"], arm=wrist, poses={"home": np.zeros(3)})
    with pytest.raises(InputError, match="pick and place: "):
        table_of(robot)


def test_facts_tell_lessons_what_the_planned_motion_does_with_the_boxes():
    state = set_up()
    facts = {name: fact.now(state).value for name, fact in FACTS.facts.items()}
    assert facts["boxes"] == 3
    assert facts["picked"] == facts["placed"] == 1
    assert facts["missed"] == 0.0
    assert facts["from_goal"] < 1e-4
    assert facts["waits"] == pytest.approx(0.8)
    unplanned = apply(state, SetAtWaypoint(1, "wait", 1.0))
    assert FACTS.facts["placed"].now(unplanned).value is None


def test_a_plan_in_a_file_brings_its_boxes_along():
    state = set_up("scara", MoveBox(0, 2, 0.04), SelectBox(1))
    text = plan_json(state)
    assert "selected" not in json.loads(text)["pick"]
    other = with_planned(apply(State.initial(catalogue()["puma560"]), ReadPlan(text)))
    assert (other[Pick].boxes, other[Pick].goal) == (state[Pick].boxes, state[Pick].goal)
    assert told(other) == told(state)
    assert plan_json(other) == text
    with pytest.raises(InputError, match="box 1: expected three finite numbers"):
        apply(state, ReadPlan(text.replace("0.04", '"up"')))
    without = json.loads(plan_json(State.initial(catalogue()["scara"])))
    assert "pick" not in without
    assert apply(state, ReadPlan(json.dumps(without)))[Pick].boxes == state[Pick].boxes


def test_boxes_are_saved_and_go_with_their_arm():
    state = set_up()
    robot = catalogue()["puma560"]
    written = state[Pick].to_json()
    assert Pick.from_json(written, robot).to_json() == written
    assert state[Pick].for_robot(catalogue()["scara"]).boxes == ()
    with pytest.raises(InputError, match="at most 3"):
        Pick.from_json({"boxes": [[0.0, 0.0, 0.0]] * 4}, robot)
    with pytest.raises(InputError, match="box 1"):
        Pick.from_json({"boxes": [[0.0, 0.0]]}, robot)
