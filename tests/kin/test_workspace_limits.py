"""Workspaces whose first joint is limited, locked or slides far: where it ends, and where branches end inside."""

from math import pi

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_sequence
from armlab.kin.transforms import transform
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar_regions import regions
from armlab.kin.workspace.section_size import has_no_size, size
from armlab.kin.workspace.sections import section
from armlab.kin.workspace.wrist_points import wrist_points
from armlab.kin.workspace.wrist_turns import turns_freely

ELBOW = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
BEFORE_WRIST = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, 0.4, 0)]


def test_a_branch_that_ends_inside_the_outline_is_a_boundary():
    """The arm reaches behind itself only with part of its elbows: a step away lies a point it does not reach."""
    arm = Arm.from_dh(ELBOW, limits=[[-1.5, 1.5], [0.0, 2.5], [-2.4, 0.0]])
    whole = section(arm, 128, 60_000)
    found = whole.distance([-0.212, 0.027, 1.063])
    assert 0.0 < found.distance < 0.04
    assert np.linalg.norm(found.foot - [-0.212, 0.027, 1.063]) == pytest.approx(found.distance)


def test_what_is_nearest_may_lie_at_the_end_of_joint_1():
    arm = Arm.from_dh([("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)], limits=[[-1, 1], [0.3, 2]])
    whole, point = section(arm), np.array([0.005, -0.601, 0.0])
    away = np.linalg.norm(arm.position(whole.nearest(point)) - point)
    some = arm.position(arm.limits[:, 0] + np.ptp(arm.limits, axis=1) * np.random.default_rng(0).random((200_000, 2)))
    assert away <= np.linalg.norm(some - point, axis=1).min() + 1e-6
    assert -whole.distance(point).distance == pytest.approx(away, abs=0.003)


def test_a_long_stroke_of_joint_1_ends(rng):
    """Ten metres are no whole turn."""
    rows = [("P", 0, pi / 2, 0, 0), ("P", 0, -pi / 2, 0, -pi / 2), ("P", 0, 0, 0, 0)]
    arm = Arm.from_dh(rows, limits=[[0, 10], [0, 20], [0, 20]])
    whole = section(arm, 64, 20_000)
    along = arm.position([1.0, 0.0, 0.0]) - arm.position([0.0, 0.0, 0.0])
    assert whole.distance(arm.position([0.5, 10, 10])).distance == pytest.approx(0.5, abs=0.01)
    assert whole.distance(arm.position([10, 10, 10]) + along).distance == pytest.approx(-1.0, abs=0.01)


def test_scorbot_is_as_far_from_a_point_as_its_nearest_configuration(rng):
    arm = catalogue()["scorbot"].arm
    whole, point = section(arm, 128, 65_536), np.array([-0.597, 0.044, 0.367])
    q = np.array([0.001, 2.266, 1.172, 0.175, -2.48])
    assert arm.within_limits(q)
    away = np.linalg.norm(arm.position(whole.nearest(point)) - point)
    assert away <= np.linalg.norm(arm.position(q) - point)
    assert -whole.distance(point).distance == pytest.approx(away, abs=0.02)


GANTRY = [("P", 0, -pi / 2, 0, -pi / 2), ("P", 0, -pi / 2, 0, -pi / 2), ("P", 0, 0, 0, 0)]
LOCKED = {
    "2R, joint 1": ([("R", 1.0, 0, 0, 0), ("R", 0.5, 0, 0, 0)], [[0, 0], [-pi, pi]]),
    "2R, joint 2": ([("R", 1.0, 0, 0, 0), ("R", 0.5, 0, 0, 0)], [[-pi, pi], [0.5, 0.5]]),
    "PR, joint 1": ([("P", 0, pi / 2, 0, 0), ("R", 1.0, 0, 0, 0)], [[0.5, 0.5], [-1, 0.5]]),
    "elbow, joint 1": (ELBOW, [[0.3, 0.3], *[[-pi, pi]] * 2]),
    "gantry, joint 1": (GANTRY, [[1, 1], [-1, 0.5], [-3, -2]]),
}


@pytest.mark.parametrize("key", LOCKED)
def test_an_arm_with_a_locked_joint_that_it_needs_reaches_no_area_and_no_volume(key):
    rows, limits = LOCKED[key]
    found = section(Arm.from_dh(rows, limits=limits), 48, 10_000)
    assert has_no_size(found)
    assert (size(found).value, size(found).error) == (0.0, 0.0)


@pytest.mark.parametrize("limits", [[0.505, 0.52], [0.5, 0.5], [0.5, 0.9]])
def test_a_narrow_first_joint_still_brings_the_wrist_somewhere(limits, rng):
    rows = [("R", 0.1, pi / 2, 0.3, 0), ("R", 0.5, 0.3, 0.1, 0), *BEFORE_WRIST[2:], ("R", 0, pi / 2, 0, 0)]
    arm = Arm.from_dh([*rows, ("R", 0, 0, 0.1, 0)], limits=[limits] + [[-pi, pi]] * 5)
    q = arm.limits[:, 0] + np.ptp(arm.limits, axis=1) * rng.random((500, 6))
    pose = arm.fk(q)
    wrists = pose[:, :3, 3] - 0.1 * pose[:, :3, 2]
    assert wrist_points(arm).holds(wrists).mean() > 0.95


@pytest.mark.parametrize(
    ("links", "expected"),
    [
        ((1.0, 0.5, 0.9), {1.4: 1}),
        ((0.1, 0.9, 0.9), {1.7: 1}),
        ((0.8, 0.6, 0.8), {1.0: 1}),
        ((0.4, 0.3, 0.9), {0.8: 1}),
    ],
)
def test_ranges_that_meet_on_a_singular_circle_are_one(links, expected):
    found = {round(each.low, 9): each.ranges for each in regions(links) if each.kind == "crossing"}
    assert {r: found[r] for r in expected} == expected


def test_equal_links_are_equal_up_to_rounding():
    exact, rounded = ([each.solutions for each in regions(links)] for links in ((0.3, 0.3, 0.2), (0.1 + 0.2, 0.3, 0.2)))
    assert any("q₁ is free" in each for each in exact)
    assert exact == rounded


def test_a_plane_that_a_locked_joint_stands_on_is_not_planar_in_its_coordinates():
    arm = Arm.from_dh(
        [("R", 0, pi / 2, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.5, 0, 0, 0)], limits=[[0, 0], *[[-pi, pi]] * 2]
    )
    assert not first_joint(arm).planar
    assert size(section(arm, 64, 20_000)).unit == "m³"
    along_axis = Arm.from_dh([("R", 0, 0, 0, 0), ("P", 0, 0, 0, 0)])
    assert not first_joint(along_axis).planar
    assert first_joint(catalogue()["planar_3r"].arm).planar


@pytest.mark.parametrize(
    "turn", [(0.0, 0.0, 0.0), (0.3, 0.2, 0.1), (1.0, -2.0, 0.5), (-0.4, 1.3, 2.2), (2.0, 2.0, 2.0)]
)
@pytest.mark.parametrize("row", [("P", 0, 0, 0, 0), ("P", 0.3, 0.4, 0, 0.2)])
def test_whether_a_slide_stays_in_a_plane_does_not_depend_on_how_the_base_is_turned(row, turn):
    """A locked slide alone reaches one point, with a second slide a line: a plane along the first goes through both."""
    base = transform(rotation_from_sequence("xyz", turn), [0.1, -0.2, 0.3])
    second, short = ("P", 0, 0.5, 0, 0.7), [0.0, 1e-6]
    for rows, limits in (([row], [[0.2, 0.2]]), ([row, second], [[0.2, 0.2], [0, 1]]), ([row, second], [short, short])):
        arm = Arm.from_dh(rows, limits=limits, base=base)
        found = first_joint(arm)
        assert found.planar
        q = arm.limits[:, 0] + np.ptp(arm.limits, axis=1) * np.random.default_rng(0).random((50, arm.n))
        assert np.ptp(found.split(arm.position(q))[:, 1]) < 1e-9
        np.testing.assert_allclose(found.axes.T @ found.axes, np.eye(3), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("middle", "free"),
    [([-6.1, 6.1], True), ([-6, 6], True), ([0, pi], True), ([0.1, pi], False), ([0.1, 2 * pi], True)],
)
def test_a_wrist_turns_freely_where_its_middle_joint_makes_every_angle(middle, free):
    rows = [*BEFORE_WRIST, ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.1, 0)]
    assert turns_freely(Arm.from_dh(rows, limits=[[-pi, pi]] * 4 + [middle] + [[-pi, pi]])) is free


def test_an_arc_in_front_and_one_behind_stay_two_wherever_they_are_found():
    """Shoulder and elbow turn all the way: each place is reached at s = 0 and at s = pi, 120 degrees about each."""
    arm = catalogue()["elbow_3r"].arm
    limited = Arm.from_dh(arm.rows, arm.convention, limits=[[-pi / 3, pi / 3], *arm.limits[1:]])
    covered = section(limited, 48, 20_000).arcs.covered
    assert np.ptp(covered[covered > 0.0]) < 1e-6
    assert covered.max() == pytest.approx(4 * pi / 3)
