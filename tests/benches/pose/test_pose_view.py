"""Which transform is looked at, and what is selected in it."""

import math

import numpy as np
import pytest

from armlab.benches.pose.tool.state import (
    MATRIX,
    Invert,
    LookAt,
    PoseView,
    frame_names,
    link_parameters,
    pair_of,
    step_of,
)
from armlab.benches.pose.tool.ui.chooser import chooser_markup
from armlab.benches.pose.tool.ui.notation import cosine
from armlab.benches.pose.tool.ui.scene import marks_of
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.dh import link_transform
from armlab.kin.transforms import inverse
from armlab.session.edits import RemoveJoint
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.selection import Select, Selection
from armlab.session.state import State, apply
from armlab.ui.units import Units
from support.forms import asked


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


def written(state, axes):
    """Return the state with the angles written in a sequence about axes that stay."""
    return apply(apply(state, Set(PoseView, "axes", axes)), Set(PoseView, "fixed", True))


def looked_at(state, reference, frame):
    return pair_of(apply(state, LookAt(reference, frame))).transform


def test_it_opens_with_the_tool_in_the_world(state):
    np.testing.assert_array_equal(pair_of(state).transform, state[Joints].tool_pose)


def test_every_arm_is_the_product_of_its_steps(robot):
    """wT0 A1 ... An nTE is the tool in the world, and each A_i is that of the table with the joint in its place."""
    state = apply(State.initial(robot), RandomPose())
    joints = state[Joints]
    n = joints.arm.n
    product = looked_at(state, "w", "0")
    np.testing.assert_allclose(product, joints.arm.base, atol=1e-12)
    for i in range(1, n + 1):
        step = looked_at(state, str(i - 1), str(i))
        table = link_transform(**link_parameters(joints.arm, joints.q, i), convention=joints.arm.convention)
        np.testing.assert_allclose(step, table, atol=1e-9)
        product = product @ step
        running = looked_at(state, "0", str(i))
        np.testing.assert_allclose(looked_at(state, "w", "0") @ running, product, atol=1e-9)
    np.testing.assert_allclose(looked_at(state, str(n), "E"), joints.arm.tool, atol=1e-9)
    np.testing.assert_allclose(product @ looked_at(state, str(n), "E"), joints.tool_pose, atol=1e-9)


def test_exchanged_frames_give_the_inverse(state):
    forward, back = looked_at(state, "1", "4"), looked_at(state, "4", "1")
    np.testing.assert_allclose(back, inverse(forward), atol=1e-12)
    np.testing.assert_allclose(back @ forward, np.eye(4), atol=1e-12)
    assert apply(state, LookAt("4", "1"))[PoseView].inward
    assert not apply(state, LookAt("1", "4"))[PoseView].inward
    assert apply(state, LookAt("E", "w"))[PoseView].outer_pair == ("w", "E")


def test_the_inverse_stays_while_other_frames_are_chosen(state):
    inverted = apply(state, Invert())
    assert (inverted[PoseView].reference, inverted[PoseView].frame) == ("E", "w")
    other = apply(inverted, LookAt("1", "2", keeps_sense=True))[PoseView]
    assert (other.reference, other.frame) == ("2", "1")
    straight = apply(state, LookAt("1", "2", keeps_sense=True))[PoseView]
    assert (straight.reference, straight.frame) == ("1", "2")
    assert apply(inverted, Invert())[PoseView] == state[PoseView]


@pytest.mark.parametrize(
    ("reference", "frame", "step"),
    [("0", "1", 1), ("3", "4", 4), ("4", "3", 4), ("0", "2", None), ("w", "0", None), ("6", "E", None)],
)
def test_a_step_is_known_as_one(state, reference, frame, step):
    assert step_of(apply(state, LookAt(reference, frame))[PoseView]) == step


def test_the_angle_between_axes_has_the_entry_as_its_cosine(state):
    for _ in range(5):
        state = apply(state, RandomPose())
        pair = pair_of(state)
        for i in range(3):
            for j in range(3):
                assert math.cos(pair.angle(i, j)) == pytest.approx(pair.transform[i, j], abs=1e-12)
                assert 0.0 <= pair.angle(i, j) <= math.pi


def test_no_cosine_is_minus_zero():
    """That of a quarter turn is a little above or below zero, by rounding."""
    state = State.initial(catalogue()["irb120"])
    pair, units = pair_of(state), Units(Notation())
    said = [cosine(float(pair.transform[i, j]), pair.angle(i, j), units) for i in range(3) for j in range(3)]
    assert "cos 90.0° = 0.000" in said
    assert not any("−0.000" in text for text in said)
    labels = [
        marks_of(pair, state.replace(Selection(MATRIX, i, j))[Selection], 1.0, units).label
        for i in range(3)
        for j in range(3)
    ]
    assert labels == said


@pytest.mark.parametrize("turned", [1e-9, 1e-5, math.pi - 1e-9])
def test_the_angle_keeps_its_digits_near_parallel_axes(state, turned):
    state = apply(State.initial(catalogue()["planar_2r"]), LookAt("0", "1"))
    joints = state[Joints]
    moved = state.replace(joints.moved_to([turned, 0.0]))
    assert pair_of(moved).angle(0, 0) == pytest.approx(turned, rel=1e-6, abs=1e-15)


@pytest.mark.parametrize(("reference", "frame"), [("w", "7"), ("-1", "E"), ("", "E"), ("w", "e")])
def test_frames_there_are_not_are_refused(state, reference, frame):
    with pytest.raises(UnknownName, match=r"frame: unknown name .*Available: 0, 1"):
        apply(state, LookAt(reference, frame))


def test_a_frame_in_itself_is_refused(state):
    with pytest.raises(InputError, match="two different frames, got '3' for both"):
        apply(state, LookAt("3", "3"))


def test_sequences_are_chosen_or_refused(state):
    view = written(state, "zxz")[PoseView]
    assert (view.axes, view.fixed) == ("zxz", True)
    assert apply(state, Set(PoseView, "axes", state[PoseView].axes)) is state
    with pytest.raises(UnknownName, match="axes: unknown name 'zzx'"):
        apply(state, Set(PoseView, "axes", "zzx"))


def test_another_arm_keeps_what_it_has_and_a_removed_joint_takes_its_frame_along(state):
    three = written(apply(state, LookAt("0", "3")), "xyz")
    other = apply(three, ChooseRobot("scara"))[PoseView]
    assert (other.n, other.reference, other.frame, other.axes, other.fixed) == (4, "0", "3", "xyz", True)
    six = apply(state, LookAt("5", "6"))
    shorter = apply(six, RemoveJoint(5))[PoseView]
    assert (shorter.n, shorter.reference, shorter.frame) == (5, "w", "E")


def test_the_buttons_look_at_their_pair_in_the_sense_that_is_chosen(state):
    def pressed(state, cell):
        return asked(lambda form: chooser_markup(form, state[PoseView]), cell)

    assert pressed(state, "0-3") == (LookAt("0", "3", keeps_sense=True),)
    assert pressed(state, "inverse") == (Invert(),)
    assert pressed(state, "0-7") == ()
    inverse = apply(state, Invert())
    assert looked_at(inverse, "E", "0").tolist() == pair_of(apply(inverse, *pressed(inverse, "0-E"))).transform.tolist()


def test_looking_and_selecting_are_no_steps_of_undo():
    assert not LookAt.undoable
    assert not Set(PoseView, "axes", "zxz").undoable
    assert not Select.undoable
    assert PoseView.kept_by_undo
    assert Selection.kept_by_undo


def test_it_is_written_and_read_back(state):
    changed = written(apply(state, LookAt("E", "2")), "yzy")
    robot = catalogue()["puma560"]
    assert PoseView.from_json(changed[PoseView].to_json(), robot) == changed[PoseView]


@pytest.mark.parametrize(
    "damage", [{"reference": "9"}, {"frame": "w"}, {"axes": "abc"}, {"reference": None}, {"frame": ["E"]}]
)
def test_damaged_data_are_refused(state, damage):
    data = state[PoseView].to_json() | damage
    with pytest.raises(InputError, match=r"reference|frame|axes"):
        PoseView.from_json(data, catalogue()["puma560"])


def test_names_go_from_the_world_to_the_tool():
    assert frame_names(2) == ("w", "0", "1", "2", "E")


def test_a_selection_is_let_go_by_the_same_press_and_by_an_empty_one(state):
    chosen = apply(state, Select("pose", 1, 2))
    assert chosen[Selection] == Selection("pose", 1, 2)
    assert apply(chosen, Select("pose", 1, 2))[Selection] == Selection()
    assert apply(chosen, Select("pose"))[Selection] == Selection()
    assert apply(chosen, Select("pose", 1))[Selection] == Selection("pose", 1)
    assert apply(state, Select("")) is state
    with pytest.raises(InputError, match="count from 0"):
        apply(state, Select("pose", -1, 0))


@pytest.mark.parametrize(
    ("row", "column", "held"),
    [(1, 2, {(1, 2)}), (1, None, {(1, 0), (1, 1), (1, 2)}), (None, 0, {(0, 0), (1, 0), (2, 0)})],
)
def test_a_selection_holds_its_entries_and_no_others(row, column, held):
    selection = Selection("pose", row, column)
    assert {(i, j) for i in range(3) for j in range(3) if selection.holds(i, j)} == held
    assert not any(Selection().holds(i, j) for i in range(3) for j in range(3))
    assert selection.of("jacobian") == Selection()
    assert selection.of("pose") == selection


def test_another_arm_has_nothing_selected(state):
    chosen = apply(state, Select("pose", None, 3))
    assert apply(chosen, ChooseRobot("scara"))[Selection] == Selection()
