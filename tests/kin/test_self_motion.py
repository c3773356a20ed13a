"""The motion of a redundant arm while its tool stands still."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.self_motion import MOST_ON_SURFACE, STEP, distance_to, evenly, self_motion, trace_self_motion
from support.arms import random_q
from support.solutions import worst_error

ARMS = ("panda", "iiwa7", "gen3", "r4", "youbot", "openmanipulator_x", "scorbot", "canadarm2")


def lengths(arm, q):
    """Return the distances between neighbours, radians and length scales."""
    return np.linalg.norm(np.diff(q, axis=0) / np.where(arm.revolute, 1.0, arm.length_scale), axis=1)


@pytest.mark.parametrize("key", ARMS)
@pytest.mark.parametrize("limits", [True, False])
def test_every_point_has_the_pose_and_they_are_even(key, limits, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    T = np.asarray(arm.fk(q))
    points = self_motion(arm, q, 40, limits=limits)
    assert points.shape == (40, arm.n)
    assert worst_error(arm, points, T) < 1e-9
    if limits:
        assert all(arm.within_limits(row, 1e-8) for row in points)
    between = lengths(arm, points)
    # Chords of a curve that turns sharply are shorter than its pieces.
    assert between.max() < 1.2 * np.median(between)


@pytest.mark.parametrize("key", ARMS)
def test_the_curve_passes_through_where_it_began(key, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    motion = trace_self_motion(arm, q, np.asarray(arm.fk(q)))
    assert motion.freedom == arm.n - arm.task.m
    assert np.abs(motion.q - q).max(axis=1).min() < 1e-12
    assert lengths(arm, motion.q).max() < 1.6 * STEP
    assert distance_to(arm, q, [motion.q]) < 1e-12
    assert distance_to(arm, q, []) == math.inf


def test_a_planar_3r_with_its_hand_fixed_goes_all_around_when_it_can():
    """The four-bar linkage of links 1, .8, .5 and the way to the hand: does a link turn fully (Grashof)?"""
    arm = Arm.from_dh([("R", length, 0.0, 0.0, 0.0) for length in (1.0, 0.8, 0.5)], task="xy")
    q = np.array([0.2, 1.3, -0.8])
    T = np.asarray(arm.fk(q))
    motion = trace_self_motion(arm, q, T, limits=False)
    assert motion.closed
    assert motion.stops == (-1, -1)
    assert worst_error(arm, motion.q, T) < 1e-9
    points = evenly(arm, motion, 24)
    assert np.allclose(points[0], q, atol=1e-9)
    around = np.vstack([points, points[:1] + 2 * math.pi * np.round((points[-1] - points[0]) / (2 * math.pi))])
    between = lengths(arm, around)
    assert between.max() < 1.2 * between.min()


def test_a_limit_stops_it_exactly():
    arm = Arm.from_dh(
        [("R", length, 0.0, 0.0, 0.0) for length in (1.0, 0.8, 0.5)], task="xy", limits=[[-0.1, 0.5], [-3, 3], [-3, 3]]
    )
    q = np.array([0.2, 1.3, -0.8])
    motion = trace_self_motion(arm, q, np.asarray(arm.fk(q)))
    assert not motion.closed
    assert sorted(motion.stops) in ([0, 0], [0, 1], [0, 2])
    ends = motion.q[[0, -1]]
    for end, joint in zip(ends, motion.stops, strict=True):
        assert min(abs(end[joint] - arm.limits[joint])) < 1e-9
        assert arm.within_limits(end)


def test_a_step_across_a_narrow_range_ends_at_the_other_limit():
    """A step is longer than this range of 2 degrees, and it begins at the one end of it."""
    arm = Arm.from_dh(
        [("R", length, 0.0, 0.0, 0.0) for length in (1.0, 1.0, 1.0)], task="xy", limits=[[0.30, 0.34], [-3, 3], [-3, 3]]
    )
    for start in (0.30, 0.34):
        q = np.array([start, -0.43, 0.80])
        motion = trace_self_motion(arm, q, np.asarray(arm.fk(q)))
        assert motion.stops == (0, 0)
        assert np.ptp(motion.q[:, 0]) == pytest.approx(0.04, abs=1e-9)


def test_limits_that_are_left_already_do_not_count():
    arm = Arm.from_dh(
        [("R", length, 0.0, 0.0, 0.0) for length in (1.0, 0.8, 0.5)], task="xy", limits=[[1.0, 1.5], [-3, 3], [-3, 3]]
    )
    q = np.array([0.2, 1.3, -0.8])
    points = self_motion(arm, q, 10)
    assert len(points) == 10
    assert points[:, 0].min() > 0.2 - 1e-9


def test_a_stretched_arm_and_one_without_freedom_stay_where_they_are():
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 3, task="xy")
    assert np.allclose(self_motion(arm, [0.3, 0.0, 0.0], 8), [0.3, 0.0, 0.0], atol=1e-6)
    two = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2, task="xy")
    assert self_motion(two, [0.3, 0.7], 8).tolist() == [[0.3, 0.7]]


def test_slides_do_not_go_on_for_ever():
    """Two slides in one line: 2 m one way is 2 m the other."""
    arm = Arm.from_dh([("P", 0.0, 0.0, 0.3, 0.0), ("P", 0.0, 0.0, 0.2, 0.0)], task="xyz")
    inside = self_motion(arm, [0.4, 0.5], 10)
    assert inside[:, 0].min() == pytest.approx(0.0, abs=1e-9)
    assert np.allclose(inside.sum(axis=1), 0.9)
    outside = self_motion(arm, [0.4, 0.5], 10, limits=False)
    assert np.abs(outside).max() < 2.0 * arm.reach
    assert np.allclose(outside.sum(axis=1), 0.9)


def test_more_than_one_freedom_gives_one_curve_of_the_surface(rng):
    arm = catalogue()["trunk9"].arm
    q = 0.5 * random_q(arm, rng)
    motion = trace_self_motion(arm, q, np.asarray(arm.fk(q)))
    assert motion.freedom == arm.n - arm.task.m > 1
    assert len(motion.q) > 5
    T = np.asarray(arm.fk(q))
    np.testing.assert_allclose(arm.fk(motion.q), np.broadcast_to(T, (len(motion.q), 4, 4)), rtol=0, atol=1e-9)
    assert worst_error(arm, motion.q[::50], T) < 1e-9


@pytest.mark.parametrize(
    ("q", "count", "words"),
    [([0.0] * 6, 8, "q"), ([math.nan] * 7, 8, "q"), ([0.0] * 7, 1, "count"), ([0.0] * 7, 2.5, "count")],
)
def test_bad_input_is_refused_in_words(q, count, words):
    with pytest.raises(InputError, match=words):
        self_motion(catalogue()["panda"].arm, q, count)


def test_a_line_on_a_surface_comes_to_an_end():
    """Folded, links of one length leave three directions; straight on through them no line closes."""
    arm = catalogue()["iiwa7"].arm
    q = np.array([0.3, 0.5, -0.4, np.pi, 0.7, -0.6, 0.2])
    motion = trace_self_motion(arm, q, np.asarray(arm.fk(q)), limits=False)
    assert motion.freedom == 3
    assert len(motion.q) <= 2 * MOST_ON_SURFACE + 1
