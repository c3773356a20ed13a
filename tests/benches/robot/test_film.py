"""The film of the table through its own time."""

import numpy as np
import pytest

from armlab.benches.robot.film.clip import (
    BEAT_SECONDS,
    CLIP,
    JUST_AFTER,
    MOVE_SECONDS,
    end_of,
    ends_of,
    has_tool,
    moves_in,
    moving_frame,
    place_at,
    place_of,
    row_product,
    running_product,
    start_of,
)
from armlab.content.robots import catalogue
from armlab.kin.moves import moves_of
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints, RandomPose, TakePose
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import State, apply
from support.arms import KINDS

PUMA = catalogue()["puma560"].arm
ROBOTS = sorted(KINDS)


def opened(key, draws=1):
    """Return the state of an arm in a random pose with the film on."""
    state = State.initial(catalogue()[key])
    for _ in range(draws):
        state = apply(state, RandomPose())
    return apply(state, OpenClip("film"))


def at(state, time):
    return apply(state, Seek(time))


@pytest.mark.parametrize("key", ROBOTS)
def test_the_last_picture_is_forward_kinematics(key):
    for draws in (0, 1, 2):
        state = opened(key, draws)
        end = at(state, duration(state))
        joints = end[Joints]
        np.testing.assert_allclose(end.derived(moving_frame), joints.arm.fk(joints.q), rtol=0, atol=1e-12)
        inside = inverse(joints.arm.base) @ joints.arm.fk(joints.q)
        np.testing.assert_allclose(running_product(end), inside, rtol=0, atol=1e-12)


@pytest.mark.parametrize("key", ROBOTS)
def test_each_row_ends_in_its_frame_and_starts_in_the_one_before(key):
    state = opened(key)
    arm, frames = state[Joints].arm, state[Joints].frames
    for row in range(arm.n):
        begun, ended = at(state, start_of(arm, row)), at(state, end_of(arm, row, 3))
        assert (place_of(begun).row, place_of(begun).move) == (row, 0)
        assert (place_of(ended).row, place_of(ended).move, place_of(ended).part) == (row, 3, 1.0)
        # Just after the start of a row its first move is begun by less than a part in a hundred million.
        np.testing.assert_allclose(moving_frame(begun), frames[row], rtol=0, atol=1e-7)
        np.testing.assert_allclose(moving_frame(ended), frames[row + 1], rtol=0, atol=1e-12)
        np.testing.assert_allclose(frames[row] @ row_product(ended), frames[row + 1], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("key", "order"), [("puma560", "theta d a alpha"), ("panda", "alpha a theta d")])
def test_the_moves_come_in_the_order_of_the_convention(key, order):
    """After each move the frame differs from the one before by that move alone."""
    state = opened(key)
    arm, q = state[Joints].arm, state[Joints].q
    assert [move.symbol for move in moves_of(arm.rows[1], q[1], arm.convention)] == order.split()
    before = state[Joints].frames[1]
    for k, symbol in enumerate(order.split()):
        after = moving_frame(at(state, end_of(arm, 1, k)))
        step = inverse(before) @ after
        axis = {"theta": 2, "d": 2, "a": 0, "alpha": 0}[symbol]
        if symbol in ("d", "a"):
            np.testing.assert_allclose(step[:3, :3], np.eye(3), rtol=0, atol=1e-12)
            across = np.delete(step[:3, 3], axis)
        else:
            np.testing.assert_allclose(step[:3, axis], np.eye(3)[axis], rtol=0, atol=1e-12)
            across = step[:3, 3]
        np.testing.assert_allclose(across, 0.0, rtol=0, atol=1e-12)
        before = after


def test_it_lasts_four_moves_a_row_and_one_to_a_tool_and_what_is_none_is_a_beat():
    plain, tooled = opened("planar_2r"), opened("panda")
    assert not has_tool(plain[Joints].arm)
    assert has_tool(tooled[Joints].arm)
    assert moves_in(tooled[Joints].arm) == 4 * 7 + 1
    assert len(CLIP.stops(tooled)) == 4 * 7
    # Both rows of the plane arm: theta moves, d is none, a moves, alpha is none.
    times = (1.5, 1.8, 3.3, 3.6, 5.1, 5.4, 6.9, 7.2)
    assert (*CLIP.stops(plain), duration(plain)) == pytest.approx(times)


@pytest.mark.parametrize("key", ROBOTS)
def test_only_what_the_table_says_is_none_is_short(key):
    state = opened(key)
    arm, stops = state[Joints].arm, (0.0, *CLIP.stops(state), duration(state))
    for row in range(arm.n):
        for move, begin, end in zip(
            moves_of(arm.rows[row], 0.0, arm.convention), stops[4 * row :], stops[4 * row + 1 :], strict=False
        ):
            none = move.amount == 0.0 and not move.variable
            assert end - begin == pytest.approx(BEAT_SECONDS if none else MOVE_SECONDS)
    if has_tool(arm):
        assert stops[-1] - stops[-2] == pytest.approx(MOVE_SECONDS)


def test_the_time_of_a_place_does_not_depend_on_the_joints():
    state = at(opened("puma560"), 10.0)
    assert place_of(apply(state, TakePose("zero"))) == place_of(state)


def test_a_row_the_arm_has_not_is_the_end():
    assert end_of(PUMA, 9, 2) == ends_of(PUMA)[-1]


def test_stepping_stops_at_every_factor():
    state = opened("panda")
    seen = []
    for _ in range(moves_in(state[Joints].arm)):
        state = apply(state, Step(True))
        place = place_of(state)
        assert place.part == 1.0
        seen.append((place.row, place.move))
    assert seen == [*((row, move) for row in range(7) for move in range(4)), (7, 0)]
    assert state[Timeline].time == duration(state)


def test_a_step_back_from_the_start_of_a_row_is_the_end_of_the_row_before():
    state = apply(at(opened("puma560"), start_of(PUMA, 2)), Step(False))
    assert (place_of(state).row, place_of(state).move) == (1, 3)


def test_the_film_moves_no_joint_and_follows_those_that_move():
    state = at(opened("puma560"), 12.0)
    moved = apply(state, RandomPose())
    assert moved[Timeline].time == 12.0
    assert not np.allclose(moving_frame(moved), moving_frame(state))
    assert at(state, 15.0)[Joints] is state[Joints]


def test_a_move_is_eased_and_never_goes_back():
    arm = catalogue()["planar_2r"].arm
    progress = [place_at(arm, t).progress for t in np.linspace(0.0, 1.5, 61)]
    assert np.all(np.diff(progress) >= 0.0)
    assert progress[30] == pytest.approx(0.5)
    assert progress[1] < 0.001
    assert place_at(arm, 1e9) == place_at(arm, 7.2)
    assert place_at(arm, -3.0) == place_at(arm, 0.0)
    assert place_at(arm, start_of(arm, 1)).part < 1e-6 < JUST_AFTER
