"""Which closed form an arm has; the facts it rests on are looked for in the axes themselves."""

import itertools
import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.structure import structure_of
from support.arms import random_arm, random_pose

H = math.pi / 2

EXPECTED = {
    "planar_2r": ("planar", 2),
    "planar_2r_unequal": ("planar", 2),
    "planar_3r": ("planar", 2),
    "planar_3r_unequal": ("planar", 2),
    "elbow_3r": ("elbow", 4),
    "r4": ("turning_plane", None),
    "openmanipulator_x": ("turning_plane", None),
    "scorbot": ("turning_plane", None),
    "youbot": ("turning_plane", None),
    "cartesian_3p": ("cartesian", 1),
    "cylindrical_rpp": ("cylindrical", 2),
    "polar_rrp": ("polar", 4),
    "scara": ("scara", 2),
    "stanford": ("spherical_wrist", 8),
    "unimate": ("spherical_wrist", 8),
    "puma560": ("spherical_wrist", 8),
    "irb120": ("spherical_wrist", 8),
    "tx60": ("spherical_wrist", 8),
    "manseur_doty": ("general_6r", 16),
    "ur10": ("three_parallel", 8),
    "ur10_notes": ("three_parallel", 8),
    "ur10e": ("three_parallel", 8),
    "ur3e": ("three_parallel", 8),
    "ur5e": ("three_parallel", 8),
    "iiwa7": ("srs", None),
    "panda": ("redundant", None),
    "canadarm2": ("redundant", None),
    "gen3": ("redundant", None),
}
"""Key and largest number of solutions of the arms we know; the facts of all others are tested below."""


def axes_of(arm, q):
    frames = arm.frames(q)
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    return frames[:, :3, 3], frames[:, :3, 2]


def assert_meet(p, z, joints):
    """The axes have one point in common and no two neighbours one direction."""
    rows = [j - 1 for j in joints]
    across = np.array([np.eye(3) - np.outer(z[j], z[j]) for j in rows])
    meeting = np.linalg.solve(across.sum(axis=0), np.einsum("kij,kj->i", across, p[rows]))
    for j, projector in zip(rows, across, strict=True):
        np.testing.assert_allclose(projector @ (meeting - p[j]), 0.0, atol=1e-9)
    for i, j in itertools.pairwise(rows):
        assert np.linalg.norm(np.cross(z[i], z[j])) > 1e-6


def assert_parallel(p, z, joints):
    for i, j in itertools.pairwise([j - 1 for j in joints]):
        np.testing.assert_allclose(np.cross(z[i], z[j]), 0.0, atol=1e-9)


def assert_apart(p, z, joints):
    for i, j in itertools.pairwise([j - 1 for j in joints]):
        assert np.linalg.norm(np.cross(p[j] - p[i], z[i])) > 1e-6


def assert_one_direction(arm, z, key):
    """All turns are parallel; slides are across them, and in an arm that is not planar some are along."""
    turning, sliding = z[arm.revolute], z[~arm.revolute]
    np.testing.assert_allclose(np.cross(turning, turning[0]), 0.0, atol=1e-9)
    along = np.abs(sliding @ turning[0])
    assert np.all((along < 1e-9) | (along > 1 - 1e-9))
    assert np.any(along > 0.5) == (key in ("scara", "cylindrical"))


def assert_facts(arm, rng):
    """Whatever the reason claims about axes is true in random configurations."""
    structure = structure_of(arm)
    for q in rng.uniform(-3.0, 3.0, (4, arm.n)):
        p, z = axes_of(arm, q)
        joints = structure.joints
        if structure.key in ("spherical_wrist", "three_meeting", "wrist"):
            assert_meet(p, z, joints)
        elif structure.key == "srs":
            assert_meet(p, z, joints[:3])
            assert_meet(p, z, joints[3:])
        elif structure.key == "redundant" and joints:
            if "meet in one point" in structure.why:
                assert_meet(p, z, joints)
            else:
                assert_parallel(p, z, joints)
        elif structure.key == "three_parallel":
            assert_parallel(p, z, joints)
            assert_apart(p, z, joints)
        elif structure.key in ("turning_plane", "elbow"):
            assert_parallel(p, z, joints[1:])
            assert_apart(p, z, joints[1:])
            assert abs(z[0] @ z[1]) < 1e-9
        elif structure.key in ("planar", "scara", "cylindrical"):
            assert_one_direction(arm, z, structure.key)
        elif structure.key == "polar":
            assert_meet(p[:2], z[:2], (1, 2))
            assert abs(z[1] @ z[2]) < 1e-9
            assert abs(z[0] @ z[1]) < 1e-9
    assert all(arm.revolute[j - 1] for j in structure.joints) or structure.key in (
        *("planar", "scara", "cylindrical", "cartesian", "polar", "positioning", "three_slides", "single"),
        *("two_joints", "planar_part"),
    )
    return structure


def test_what_is_claimed_about_the_axes_of_a_robot_is_true(robot, rng):
    structure = assert_facts(robot.arm, rng)
    if robot.key in EXPECTED:
        assert (structure.key, structure.most_solutions) == EXPECTED[robot.key]


def test_both_conventions_have_one_structure(robot):
    other = converted(robot.arm, "modified" if robot.arm.convention == "standard" else "standard")
    assert structure_of(other) == structure_of(robot.arm)


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_what_is_claimed_about_the_axes_of_special_arms_is_true(convention, rng):
    keys = set()
    for _ in range(8):
        for n in (1, 2, 3, 4, 5, 6, 7, 8):
            keys.add(assert_facts(random_arm(rng, n, convention=convention, special=True), rng).key)
    assert {"planar", "scara", "spherical_wrist", "three_meeting", "three_parallel", "redundant", "general"} <= keys


def test_the_reason_names_the_axes():
    arms = catalogue().robots
    assert structure_of(arms["puma560"].arm).why == (
        "Axes 4, 5 and 6 meet in one point: position and orientation separate (Pieper)."
    )
    assert structure_of(arms["ur10"].arm).why.startswith("Axes 2, 3 and 4 are parallel")
    assert structure_of(arms["scara"].arm).why == (
        "Axes 1, 2 and 4 are parallel; joint 3 slides parallel to them: height and planar 3R separate."
    )
    assert structure_of(arms["canadarm2"].arm).why == (
        "Axes 3, 4 and 5 are parallel. The task, position (x, y, z) and orientation, leaves 1 of 7 joints free: a "
        "one-parameter family, infinitely many solutions. With joint 7 fixed: Three parallel axes (joints 3, 4 and 5)."
    )


def test_a_task_that_leaves_joints_free_has_a_family_of_solutions(robot):
    structure = structure_of(robot.arm)
    assert (structure.free > 0) == ("-parameter family" in structure.why)
    assert structure.free == 0 or structure.most_solutions is None
    assert structure.free >= robot.arm.n - robot.arm.task.m


def test_the_same_arm_with_a_smaller_task_is_redundant():
    rows = [("R", 1, 0, 0, 0)] * 3
    with_angle, without = (structure_of(Arm.from_dh(rows, task=task)) for task in ("xy phi", "xy"))
    assert (with_angle.free, with_angle.most_solutions) == (0, 2)
    assert (without.free, without.most_solutions) == (1, None)
    assert without.title == "Planar 3R"
    assert "leaves 1 of 3 joints free: a one-parameter family" in without.why


R, P = "R", "P"


@pytest.mark.parametrize(
    ("rows", "key", "title", "most"),
    [
        ([(R, 1, 0, 0, 0)], "single", "One revolute joint", 1),
        ([(P, 0, 0, 0, 0)], "single", "One prismatic joint", 1),
        ([(R, 0, -H, 0, 0), (P, 0, 0, 0, 0)], "planar", "Planar RP", 2),
        ([(P, 0, H, 0, 0), (R, 0.5, 0, 0, 0)], "planar", "Planar PR", 2),
        ([(R, 0, H, 0, H), (P, 0, -H, 0, 0), (R, 0.5, 0, 0, 0)], "planar", "Planar RPR", 2),
        ([(R, 0.5, 0, 0, 0), (P, 0, 0, 0, 0), (R, 0.5, 0, 0, 0)], "scara", "SCARA", 2),
        ([(R, 0, H, 0.3, 0), (R, 0.5, 0, 0, 0)], "two_joints", "Two joints RR", 2),
        ([(R, 0.2, H, 0.3, 0), (R, 0.5, 0.3, 0, 0), (R, 0.4, 0, 0, 0)], "positioning", "Positioning arm RRR", 4),
        ([(P, 0, 0.4, 0, 0), (R, 0.5, 0.3, 0, 0), (P, 0, 0, 0, 0)], "positioning", "Positioning arm PRP", 2),
    ],
)
def test_small_arms(rows, key, title, most):
    structure = structure_of(Arm.from_dh(rows))
    assert (structure.key, structure.title, structure.most_solutions) == (key, title, most)
    assert structure.closed_form


def test_a_turn_behind_two_slides_has_one_solution():
    rows = [(P, 0, H, 0, 0), (P, 0, H, 0, H), (R, 0.5, 0, 0, 0)]
    structure = structure_of(Arm.from_dh(rows, task="pose"))
    assert (structure.title, structure.most_solutions) == ("Planar PPR", 1)


def test_a_wrist_alone_has_two_solutions_for_an_orientation():
    rows = [(R, 0, -H, 0.3, 0), (R, 0, H, 0, 0), (R, 0, 0, 0.1, 0)]
    assert structure_of(Arm.from_dh(rows, task="pose")).most_solutions == 2
    for_a_point = structure_of(Arm.from_dh(rows, task="xyz"))
    assert (for_a_point.key, for_a_point.free, for_a_point.most_solutions) == ("wrist", 1, None)


@pytest.mark.parametrize(("rows", "most"), [("RRR", 8), ("RRP", 8), ("RPP", 4), ("PPP", 2)])
def test_three_axes_through_one_point_may_sit_anywhere(rows, most, rng):
    wrist = [(R, 0, H, 0.2, 0), (R, 0, -H, 0, 0), (R, 0.3, 0.5, 0.1, 0)]
    arm = [(kind, *rng.uniform(0.2, 1.0, 3), 0.3) for kind in rows]
    for place in range(4):
        before = arm[:place]
        if place:  # no common normal between the arm and the wrist would make a second triple
            before = [*before[:-1], (before[-1][0], 0.4, 0.7, 0.1, 0.2)]
        structure = structure_of(Arm.from_dh([*before, *wrist, *arm[place:]], tool=random_pose(rng), task="pose"))
        assert structure.joints == (place + 1, place + 2, place + 3)
        assert structure.key == ("spherical_wrist" if place == 3 else "three_meeting")
        assert structure.most_solutions == most


def test_three_slides_leave_the_orientation_to_the_turns():
    rows = [(P, 0.1, 0.7, 0, 0), (R, 0.2, 0.6, 0.1, 0), (P, 0.3, -0.9, 0, 0.5)]
    rows += [(R, 0.1, 1.1, 0.2, 0), (P, 0.2, 0.8, 0, 1.0), (R, 0.1, 0.3, 0.1, 0)]
    structure = structure_of(Arm.from_dh(rows, task="pose"))
    assert (structure.key, structure.most_solutions, structure.joints) == ("three_slides", 2, (1, 3, 5))


def test_the_numbers_are_those_of_the_notes(truth):
    arms = catalogue().robots
    assert structure_of(arms["ur10_notes"].arm).most_solutions == truth["C4.3-UR10-notes"]["expected"]["n"]
    assert structure_of(arms["ur10"].arm).most_solutions == truth["C4.3-UR10-manufacturer"]["expected"]["n"]
    assert structure_of(arms["manseur_doty"].arm).most_solutions == truth["C4.3-IK16-MD"]["expected"]["n"]


def solutions_found(arm, rng, starts=120):
    """Count the solutions for one reachable point that Newton finds from many starts."""
    target = arm.position(rng.uniform(-1.5, 1.5, arm.n))
    q = rng.uniform(-math.pi, math.pi, (starts, arm.n))
    for _ in range(40):
        J = arm.jacobian(q)[:, :3]
        damped = J.swapaxes(1, 2) @ J + 1e-12 * np.eye(arm.n)
        step = np.linalg.solve(damped, J.swapaxes(1, 2) @ (target - arm.position(q))[..., None])[..., 0]
        q += step * np.minimum(1.0, 1.0 / np.maximum(np.linalg.norm(step, axis=1), 1e-300))[:, None]
    q = q[np.linalg.norm(arm.position(q) - target, axis=1) < 1e-9]
    # Turns are compared by their points on the circle.
    seen = np.where(arm.revolute, np.cos(q), q), np.where(arm.revolute, np.sin(q), 0.0)
    return len(np.unique(np.round(np.hstack(seen), 4) + 0.0, axis=0))


@pytest.mark.parametrize("kinds", ["".join(kinds) for kinds in itertools.product("RP", repeat=3)])
def test_newton_finds_no_more_solutions_than_are_claimed_and_as_many_somewhere(kinds, rng):
    found = []
    for _ in range(14):
        rows = [(kind, *rng.uniform((-1, -3, -1, -3), (1, 3, 1, 3))) for kind in kinds]
        tool = random_pose(rng)
        tool[:3, 3] *= 4.0
        arm = Arm.from_dh(rows, tool=tool, task="xyz")
        structure = structure_of(arm)
        found.append(solutions_found(arm, rng))
        assert 1 <= found[-1] <= structure.most_solutions
    assert max(found) == structure.most_solutions
