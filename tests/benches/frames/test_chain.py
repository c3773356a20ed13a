"""The chain of frames: products whose names cancel, points in all frames, operations, and what is refused."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from armlab.benches.frames.chain.commands import (
    AddFrame,
    DragFrame,
    NameFrame,
    PlaceFrame,
    RemoveFrame,
    SetFrameAngle,
    SetFrameEntry,
    SetFrameMatrix,
    SetFramePosition,
    SetParent,
)
from armlab.benches.frames.chain.examples import EXAMPLES, ChooseChainExample
from armlab.benches.frames.chain.facts import FACTS
from armlab.benches.frames.chain.point import (
    DragFramePoint,
    GivePointIn,
    LookAtFrames,
    SelectFrame,
    SetFramePoint,
    SetPointCoordinate,
)
from armlab.benches.frames.chain.stage import LEAST, SHARE, STEP, unit_of
from armlab.benches.frames.chain.state import MOST_FRAMES, WORLD, Chain, Frame
from armlab.benches.frames.chain.tree import counts_of, pair_of, point_of, points_of, poses_of, steps_between
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.rotations import rotation_about
from armlab.session.fields import Set
from armlab.session.state import State, apply
from support.arms import random_pose
from support.done import done

ROBOT = catalogue()["planar_2r"]


def opened(*commands):
    return done(State.initial(ROBOT), *commands)


def branches(*commands):
    """Two branches in the world: A with B on it, and C with D on it."""
    added = [AddFrame(), AddFrame("A"), AddFrame(), AddFrame("C")]
    return opened(*(RemoveFrame(name) for name in "CBA"), *added, *commands)


def turned(name, *degrees):
    return PlaceFrame(name, angles=tuple(math.radians(angle) for angle in degrees))


# --- products


def test_the_names_of_a_product_cancel_up_to_where_both_lines_part_and_down():
    part = branches()[Chain]
    for pair, expected in {
        ("w", "B"): "wA AB",
        ("B", "w"): "BA Aw",
        ("B", "D"): "BA Aw wC CD",
        ("A", "B"): "AB",
        ("B", "B"): "",
    }.items():
        steps = steps_between(part, *pair)
        assert " ".join(step.reference + step.frame for step in steps) == expected
        for one, other in pairwise(steps):
            assert one.frame == other.reference
    assert [step.against for step in steps_between(part, "B", "D")] == [True, True, False, False]


def test_the_product_is_the_pose_of_the_frame_in_the_reference(rng):
    state = branches()
    for name in "ABCD":
        state = apply(state, DragFrame(name, random_pose(rng), object()))
    world = state.derived(poses_of)
    for reference in (WORLD, "B", "D"):
        for frame in ("A", "B", "D", WORLD):
            found = apply(state, LookAtFrames(reference, frame)).derived(pair_of)
            expected = np.linalg.solve(world[reference], world[frame])
            np.testing.assert_allclose(found.T, expected, rtol=0, atol=1e-12)
            np.testing.assert_allclose(found.inverse @ found.T, np.eye(4), rtol=0, atol=1e-12)
            assert found.difference < 1e-14


def test_the_inverse_by_the_transpose_is_that_of_any_matrix(rng):
    """C3.4-homog-inverse: 3.115 on random poses, and on the sphere of the notes by hand."""
    found = opened(ChooseChainExample("sphere"), LookAtFrames("S", WORLD)).derived(pair_of)
    by_hand = [[0, -1, 0, 3], [1, 0, 0, -3], [0, 0, 1, 0], [0, 0, 0, 1]]
    np.testing.assert_allclose(found.T, by_hand, rtol=0, atol=1e-15)
    for _ in range(20):
        found = opened(DragFrame("B", random_pose(rng), 1)).derived(pair_of)
        np.testing.assert_allclose(found.inverse, np.linalg.inv(found.T), rtol=0, atol=1e-14)
        np.testing.assert_allclose(found.inverse[:3, 3], -found.T[:3, :3].T @ found.T[:3, 3], rtol=0, atol=1e-15)


def test_the_pole_of_the_sphere_is_where_the_notes_have_it():
    """C3.1-sphere (3.18-3.19): turned by 90 degrees clockwise about z, at (3, 3, 0)."""
    state = opened(ChooseChainExample("sphere"))
    np.testing.assert_array_equal(state.derived(points_of)["S"], [0, 1, 0])
    np.testing.assert_allclose(state.derived(points_of)[WORLD], [4, 3, 0], rtol=0, atol=1e-15)
    assert state[Chain].globe


def test_operations_are_those_of_the_notes_for_three_rotations_and_one_point(truth):
    expected = truth["C3.1-opcount"]["expected"]
    found = opened(ChooseChainExample("rotations")).derived(counts_of)
    assert found.steps == 3
    for count, listed in ((found.first["rotation"], "matrix_first"), (found.each["rotation"], "vector_chain")):
        assert {"mul": count.products, "add": count.sums} == expected[listed]
    many = opened(ChooseChainExample("rotations"), Set(Chain, "count", 4)).derived(counts_of)
    assert many.first["rotation"].products < many.each["rotation"].products
    assert opened(LookAtFrames("A", "A")).derived(counts_of) is None


def test_two_robots_meet_at_the_pose_of_the_notes(truth):
    case = truth["C3.4.2-BTEB"]
    found = opened(ChooseChainExample("two_robots")).derived(pair_of)
    np.testing.assert_allclose(found.T, case["expected"]["B_T_EB"], rtol=0, atol=case["tol"])


# --- frames


def test_a_frame_is_added_to_a_parent_selected_and_named_by_the_next_letter():
    state = opened(AddFrame("B"))
    assert state[Chain].named("D").parent == "B"
    assert state[Chain].selected == "D"
    assert opened(NameFrame("C", "EE"), AddFrame())[Chain].names == (WORLD, "A", "B", "EE", "C")


def test_a_parent_moves_what_hangs_on_it_and_nothing_else():
    before, after = opened(), opened(SetFramePosition("B", 2, 0.4))
    moved = after.derived(poses_of)["C"][:3, 3] - before.derived(poses_of)["C"][:3, 3]
    np.testing.assert_allclose(moved, [0.0, 0.0, 0.25], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(after.derived(poses_of)["A"], before.derived(poses_of)["A"])
    np.testing.assert_allclose(after.derived(point_of) - before.derived(point_of), moved, rtol=0, atol=1e-12)


@pytest.mark.parametrize("parent", [WORLD, "A"])
def test_another_parent_leaves_a_frame_where_it_is(parent):
    before, after = opened(), opened(SetParent("C", parent))
    assert after[Chain].named("C").parent == parent
    np.testing.assert_allclose(after.derived(poses_of)["C"], before.derived(poses_of)["C"], rtol=0, atol=1e-12)


def test_a_frame_may_hang_on_one_that_was_behind_it():
    state = branches(SetParent("B", "D"))
    assert state[Chain].names == (WORLD, "A", "C", "D", "B")
    again = Chain.from_json(state[Chain].to_json(), ROBOT)
    assert again == state[Chain]


def test_a_removed_frame_leaves_the_point_where_it_is_and_the_pair_at_its_parent():
    before, after = opened(), opened(RemoveFrame("C"))
    assert after[Chain].given == "B"
    assert after[Chain].frame == "B"
    np.testing.assert_allclose(after.derived(point_of), before.derived(point_of), rtol=0, atol=1e-12)


def test_a_new_name_stands_wherever_the_old_one_did():
    part = opened(SelectFrame("C"), NameFrame("C", "K1"))[Chain]
    assert (part.given, part.frame, part.selected) == ("K1", "K1", "K1")
    assert opened(NameFrame("A", "Q"))[Chain].named("B").parent == "Q"


def test_a_typed_matrix_is_kept_and_the_frame_takes_the_nearest_rotation():
    state = opened(SetFrameMatrix("A", (0.0, -1.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)))
    frame = state[Chain].named("A")
    assert frame.matrix[0][1] == -1.1
    np.testing.assert_allclose(frame.R, rotation_about("z", math.pi / 2), rtol=0, atol=1e-12)
    state = apply(state, SetFrameEntry("A", 0, 1, -1.0))
    assert state[Chain].named("A").matrix[0][1] == -1.0
    assert apply(state, SetFrameAngle("A", 2, 0.3))[Chain].named("A").matrix is None
    kept = apply(state, SetFramePosition("A", 0, 1.0))[Chain].named("A")
    assert kept.matrix is not None
    assert kept.angles == state[Chain].named("A").angles


def test_a_dragged_frame_keeps_the_orientation_that_was_typed(rng):
    state = opened(turned("A", 370.0, 0.0, 0.0))
    at = np.array(state.derived(poses_of)["A"])
    at[:3, 3] += [0.1, 0.0, 0.0]
    assert apply(state, DragFrame("A", at, 1))[Chain].named("A").angles[0] == pytest.approx(math.radians(370.0))
    T = random_pose(rng)
    np.testing.assert_allclose(apply(state, DragFrame("B", T, 1)).derived(poses_of)["B"], T, rtol=0, atol=1e-9)


# --- the point


def test_the_point_is_given_in_another_frame_where_it_is_and_then_moves_with_that():
    before = opened()
    after = apply(before, GivePointIn("A"))
    np.testing.assert_allclose(after.derived(point_of), before.derived(point_of), rtol=0, atol=1e-12)
    moved = apply(after, SetFramePosition("C", 0, 2.0))
    np.testing.assert_array_equal(moved.derived(point_of), after.derived(point_of))
    moved = apply(after, SetFramePosition("A", 0, 2.0))
    assert not np.allclose(moved.derived(point_of), after.derived(point_of))


def test_the_point_is_typed_and_dragged_in_its_frame():
    state = opened(SetFramePoint((0.1, 0.2, 0.3), "B"), SetPointCoordinate(1, -0.5))
    assert state[Chain].point == (0.1, -0.5, 0.3)
    assert state[Chain].given == "B"
    place = np.array([0.4, 0.5, 0.6])
    dragged = apply(state, DragFramePoint(place, 1))
    np.testing.assert_allclose(dragged.derived(points_of)[WORLD], place, rtol=0, atol=1e-12)


def test_the_coordinates_of_all_frames_are_one_point(rng):
    state = opened()
    world = state.derived(point_of)
    for name, p in state.derived(points_of).items():
        T = state.derived(poses_of)[name]
        np.testing.assert_allclose(T[:3, :3] @ p + T[:3, 3], world, rtol=0, atol=1e-12)


# --- examples, facts, picture


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_a_frame_is_moved_and_its_pair_may_be_changed(key):
    state = opened(ChooseChainExample(key))
    part = state[Chain]
    assert part.example == key
    assert apply(state, LookAtFrames(part.frame, part.reference))[Chain].example == key
    assert apply(state, GivePointIn(WORLD))[Chain].example == key
    assert apply(state, SetFramePosition(part.frames[0].name, 0, 0.77))[Chain].example == ""


def test_facts_are_those_of_the_pair_and_the_point():
    state = branches(SetFramePoint((0.1, 0.0, 0.0), "D"), LookAtFrames("B", "D"), turned("C", 0.0, 0.0, 90.0))
    value = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    assert value["way"] == "B A w C D"
    assert (value["steps"], value["frames"], value["given"]) == (4, 4, "D")
    T = np.reshape(value["relative"], (4, 4))
    np.testing.assert_allclose(T @ [*value["point_in_frame"], 1.0], [*value["point_in"], 1.0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(T @ np.reshape(value["inverse"], (4, 4)), np.eye(4), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(value["position"], T[:3, 3])
    assert value["products_first_rotation"] == 3 * 27 + 9
    assert value["sums_each_transform"] == 4 * 9
    assert FACTS.facts["products_first_rotation"].now(apply(state, LookAtFrames("B", "B"))).value is None


def test_marks_follow_the_size_of_the_picture_in_steps():
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert unit_of(points) == pytest.approx(SHARE, rel=0.13)
    assert unit_of(1.02 * points) == unit_of(points)
    assert unit_of(4.0 * points) == pytest.approx(4.0 * unit_of(points), rel=STEP - 1.0)
    assert unit_of(np.zeros((2, 3))) == pytest.approx(SHARE * LEAST, rel=0.13)


# --- what is refused


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (RemoveFrame("A"), "A: B is given in it; choose another parent there first"),
        (RemoveFrame(WORLD), "frame: unknown name 'w'"),
        (AddFrame("X"), "parent: unknown name 'X'"),
        (NameFrame("A", "B"), "name: there is a frame B already"),
        (NameFrame("A", "w"), "w is the world and p the point"),
        (NameFrame("A", "1x"), "expected a letter and up to three letters or digits"),
        (NameFrame("A", "<b>"), "expected a letter"),
        (SetParent("A", "C"), "A: expected a parent that does not hang on the frame, got C, which hangs on it"),
        (SetParent("A", "A"), "got the frame itself"),
        (SetFrameMatrix("A", (0.0,) * 9), "expected one with a single nearest rotation"),
        (SetFrameMatrix("A", (1.0, 0, 0, 1, 0, 0, 1, 0, 0)), "columns are not zero and not parallel"),
        (SetFrameMatrix("A", (1.0,)), "matrix: expected 9 numbers, row by row, got 1"),
        (SetFrameMatrix("A", (math.nan,) * 9), "every entry must be finite"),
        (SetFrameMatrix("A", (1e7, 0, 0, 0, 1, 0, 0, 0, 1)), "expected entries up to 1e"),
        (SetFrameEntry("A", 3, 0, 1.0), "row: expected 0 to 2, got 3"),
        (SetFramePosition("A", 0, 1e9), "A: position, x: expected at most 100 m either way, got 1e.09 m"),
        (SetFramePosition("A", 3, 1.0), "index: expected 0 to 2 for x, y, z, got 3"),
        (SetFrameAngle("A", 0, 1e3), "roll: expected at most 3600° either way"),
        (SetFramePoint((1.0, math.inf, 0.0)), "point: expected three finite numbers"),
        (SetFramePoint((1.0, 0.0, 0.0), "Z"), "frame: unknown name 'Z'"),
        (GivePointIn("Z"), "frame: unknown name 'Z'"),
        (LookAtFrames("Z"), "frame: unknown name 'Z'"),
        (SelectFrame("Z"), "frame: unknown name 'Z'"),
        (Set(Chain, "count", 0), "count: expected"),
        (Set(Chain, "count", 2.5), "whole number"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    before = opened()
    with pytest.raises(InputError, match=told):
        command.apply(before)


def test_there_are_no_more_frames_than_names_fit():
    state = opened(*[AddFrame() for _ in range(MOST_FRAMES - 3)])
    assert len(state[Chain].frames) == MOST_FRAMES
    with pytest.raises(InputError, match="expected at most 6 besides the world; remove one first"):
        AddFrame().apply(state)


@pytest.mark.parametrize(
    "frames",
    [
        [Frame("A", "B"), Frame("B", "A")],
        [Frame("A", "A")],
        [Frame("A", WORLD), Frame("A", WORLD)],
        [Frame(f"A{k}", WORLD) for k in range(7)],
    ],
)
def test_a_file_with_a_ring_a_name_twice_or_too_many_frames_is_refused(frames):
    data = opened()[Chain].to_json() | {"frames": [frame.to_json() for frame in frames], "given": "w", "frame": "w"}
    with pytest.raises((InputError, UnknownName)):
        Chain.from_json(data | {"selected": "", "reference": "w"}, ROBOT)


def test_a_file_of_the_page_opens_as_it_was():
    state = opened(SetFrameMatrix("A", (0.0, -1.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)), Set(Chain, "globe", True))
    assert Chain.from_json(state[Chain].to_json(), ROBOT) == state[Chain]
    assert replace(state[Chain], globe=False) != state[Chain]
