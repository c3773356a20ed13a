"""Which singularity an arm is at, what has become dependent, and which motion is lost."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.velocity.dependence import determinant_tests
from armlab.kin.velocity.singular import singularities, usual_rank
from armlab.kin.velocity.subspaces import task_matrix, task_subspaces
from support.arms import random_pose, random_q
from support.singular import assert_is_lost, at_point

DEGREE = math.radians(1.0)
ROBOTS = catalogue().robots
SPHERICAL = ["puma560", "irb120", "irb140", "kr6r900", "tx60", "stanford", "unimate"]
PARALLEL = ["ur10", "ur10_notes", "ur10e", "ur3e", "ur5e"]
ELBOWED = ["puma560", "irb120", "irb140", "kr6r900", "tx60"]


def kinds(arm, q):
    return [each.kind for each in singularities(arm, q)]


def line_angle(a, b):
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    return float(np.arctan2(np.linalg.norm(a - (a @ b) * b), abs(a @ b)))


def regular(arm, rng):
    """Return a configuration that is far from singular."""
    for q in random_q(arm, rng, 200):
        sigma = task_subspaces(arm, q).sigma
        if sigma[usual_rank(arm) - 1] > 0.03 * sigma[0]:
            return q
    raise AssertionError("no regular configuration")


# -- by determinants -------------------------------------------------------------------------------------------------


def test_the_determinant_of_the_2r_of_the_notes(truth):
    case = truth["C5.1.4-2R-det"]
    l1, l2 = case["inputs"]["l1"], case["inputs"]["l2"]
    arm = Arm.from_dh([("R", l1, 0, 0, 0), ("R", l2, 0, 0, 0)])
    found = determinant_tests(task_matrix(arm, case["inputs"]["q"]))
    assert found.determinant == pytest.approx(case["expected"]["det"], abs=case["tol"])
    for q2 in case["expected"]["singular_q2"]:
        assert determinant_tests(task_matrix(arm, [0.4, q2])).determinant == pytest.approx(0.0, abs=case["tol"])
        assert kinds(arm, [0.4, q2]) == ["elbow"]


def test_a_tall_matrix_is_tested_by_the_other_product(truth, rng):
    J = rng.normal(size=(3, 2))
    found = determinant_tests(J)
    assert found.wide is None
    assert found.determinant is None
    assert found.tall == pytest.approx(np.prod(np.linalg.svd(J)[1]) ** 2, rel=1e-9)
    assert abs(np.linalg.det(J @ J.T)) < 1e-12 < found.tall
    assert truth["ERR-5.84"]["printed_value_if_wrong"]["printed_residual"] == 0.0


@pytest.mark.parametrize(("m", "n"), [(1, 3), (2, 3), (2, 5), (3, 6), (6, 7), (6, 6), (4, 2), (3, 1)])
def test_the_squares_of_the_minors_add_up_to_the_determinant(m, n, rng):
    J = rng.normal(size=(m, n))
    found = determinant_tests(J)
    assert len(found.minors) == found.count == math.comb(max(m, n), min(m, n))
    total = sum(minor.value**2 for minor in found.minors)
    assert total == pytest.approx(found.wide if m <= n else found.tall, rel=1e-9)
    for minor in found.minors:
        chosen = [k - 1 for k in minor.chosen]
        assert minor.value == pytest.approx(np.linalg.det(J[:, chosen] if m <= n else J[chosen]), rel=1e-9, abs=1e-12)


def test_a_small_determinant_alone_says_nothing(truth):
    J = 1e-3 * np.eye(2)
    found = determinant_tests(J)
    assert found.determinant == pytest.approx(truth["ERR-1.19"]["printed_value_if_wrong"]["printed_residual"])
    sigma = np.linalg.svd(J, compute_uv=False)
    assert sigma[0] / sigma[1] - 1.0 == truth["ERR-1.19"]["expected"]["corrected_residual"]


# -- named singularities ---------------------------------------------------------------------------------------------

RIGHT = math.pi / 2


@pytest.mark.parametrize("key", list(ROBOTS))
def test_no_robot_is_singular_where_its_rank_is_the_usual_one(key, rng):
    arm = ROBOTS[key].arm
    for q in random_q(arm, rng, 40):
        spaces = task_subspaces(arm, q)
        assert bool(singularities(arm, q)) == (spaces.rank < usual_rank(arm))
    assert singularities(arm, regular(arm, rng)) == ()


@pytest.mark.parametrize("key", list(ROBOTS))
def test_every_singular_pose_of_a_robot_has_a_reason(key):
    robot = ROBOTS[key]
    for q in (*robot.poses.values(), np.zeros(robot.arm.n)):
        found = singularities(robot.arm, q)
        assert bool(found) == (task_subspaces(robot.arm, q).rank < usual_rank(robot.arm))
        for each in found:
            assert each.says.endswith(".")
            assert each.joints
            assert each.direction is None or abs(np.linalg.norm(each.direction) - 1.0) < 1e-12
            assert_is_lost(robot.arm, q, each)


WRIST = [("R", 0, -RIGHT, 0.5, 0), ("R", 0, RIGHT, 0, 0), ("R", 0, 0, 0.1, 0)]
IN_LINE = {
    "a slide oblique to the planar part": (
        [("R", 0.5, 0, 0, 0.4), ("R", 0, 0.7, 0.7, 0), ("P", 0.5, 0.7, 0.2, RIGHT)],
        [1.317, 0.0, 0.1],
    ),
    "joint 3 behind two parallel axes, and a spherical wrist": (
        [("R", 0.5, 0, 0, 0), ("R", 0.3, 0.7, 0.2, 0), ("R", 0.3, RIGHT, 0, 0), *WRIST],
        [-0.5, 0.0, -0.34, -0.75, 1.2, 0.4],
    ),
}


@pytest.mark.parametrize("key", IN_LINE)
def test_a_stretched_part_that_another_joint_moves_on_loses_another_direction(key):
    rows, q = IN_LINE[key]
    arm = Arm.from_dh(rows)
    places = _zeros_of(lambda q2: _determinant(arm, [q[0], q2, *q[2:]]), (-3.0, 3.1))
    met = 0
    for q2 in places:
        at = [q[0], q2, *q[2:]]
        for each in singularities(arm, at):
            assert_is_lost(arm, at, each)
            met += each.kind == "elbow" and each.direction is not None
    assert met >= 1


def test_a_slide_that_leads_out_of_the_plane_leaves_no_shoulder():
    """RRRP: the tool point is in the plane through axis 1, but joint 4 moves it along axes 2 and 3."""
    rows = [("R", 0, 0, 0.2, 0), ("R", 0, RIGHT, 0, RIGHT), ("R", 0.3, 0, 0.7, RIGHT), ("P", 0, 0, 0.2, RIGHT)]
    arm = Arm.from_dh(rows, convention="modified")
    at = [math.pi, 0.0, -0.01594215067022886, -0.5243194049080313]
    found = singularities(arm, at)
    assert found
    for each in found:
        assert_is_lost(arm, at, each)


def test_a_boundary_is_that_of_what_is_near():
    """RRR with its second part folded: other joint values reach 0.4 m beyond."""
    arm = Arm.from_dh([("R", 0.8, RIGHT, 0, 0), ("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    (found,) = singularities(arm, [0.3, math.pi, math.pi])
    assert found.boundary
    assert "boundary of its workspace" not in found.says
    assert "joint values near these take it to one side only" in found.says
    assert "Others may reach beyond" in found.says


def test_a_boundary_does_not_depend_on_the_axes_in_which_two_motions_are_lost():
    """Straight up at any angle of joint 1, and with axis 1 oblique to the axes of the world."""
    robot, sine, cosine = ROBOTS["openmanipulator_x"].arm, math.sin(0.3), math.cos(0.3)
    tilt = [[1, 0, 0, 0], [0, cosine, -sine, 0], [0, sine, cosine, 0], [0, 0, 0, 1]]
    tilted = Arm.from_dh(ROBOTS["elbow_3r"].arm.rows, base=tilt)
    knee = robot.rows[1].theta
    poses = [(robot, (-RIGHT - knee, knee, 0.0)), (tilted, (RIGHT, 0.0)), (tilted, (RIGHT, math.pi))]
    for q1 in (0.0, 0.3, 1.0, -2.2):
        for arm, others in poses:
            found = {each.kind: each for each in singularities(arm, [q1, *others])}
            assert set(found) == {"shoulder", "elbow"}
            assert found["elbow"].boundary
            assert not found["shoulder"].boundary


@pytest.mark.parametrize(("l1", "l2"), [(1.0, 1.0), (0.9, 0.5)])
def test_the_2r_stretched_and_folded(l1, l2, rng):
    arm = Arm.from_dh([("R", l1, 0, 0, 0), ("R", l2, 0, 0, 0)], base=random_pose(rng))
    for q1 in rng.uniform(-3.0, 3.0, 10):
        for q2, how, boundary in ((0.0, "stretched", True), (math.pi, "folded", l1 != l2)):
            (found,) = singularities(arm, [q1, q2])
            assert found.kind == "elbow"
            assert f"the arm is {how}" in found.says
            assert found.boundary == boundary
            assert ("boundary" in found.says) == boundary
            along = arm.frames([q1, q2])[1][:3, 3] - arm.base[:3, 3]
            assert line_angle(found.direction, along) < DEGREE
            assert task_subspaces(arm, [q1, q2]).null.shape == (2, 1)


@pytest.mark.parametrize("key", SPHERICAL)
def test_wrists_in_line_lose_the_turn_across_their_axes(key, rng):
    arm = ROBOTS[key].arm
    for _ in range(5):
        q = regular(arm, rng)
        q[4] = 0.0 if task_subspaces(arm, [*q[:4], 0.0, q[5]]).rank < 6 else math.pi / 2
        (found,) = singularities(arm, q)
        assert (found.kind, found.joints, found.turning) == ("wrist", (4, 6), True)
        assert "axes 4 and 6 are in one line" in found.says
        # With the wrist centre held no sum of the last three columns turns about it.
        turns = arm.jacobian(q)[3:, 3:]
        assert np.abs(found.direction @ turns).max() < math.sin(DEGREE)


@pytest.mark.parametrize("key", ELBOWED)
def test_elbows_lose_the_motion_along_the_line(key, rng):
    arm = ROBOTS[key].arm
    q = regular(arm, rng)
    q[2] = _zero_of(lambda q3: _determinant(arm, [*q[:2], q3, *q[3:]]), arm.limits[2])
    found = {each.kind: each for each in singularities(arm, q)}
    assert set(found) == {"elbow"}
    assert found["elbow"].joints == (2, 3)
    # The wrist centre: what the last three joints do not move.
    J = _at_wrist_centre(arm, q)[:3, :3]
    assert np.linalg.norm(found["elbow"].direction @ J) < math.sin(DEGREE) * np.linalg.norm(J, 2)


@pytest.mark.parametrize("key", ELBOWED)
def test_shoulders_lose_the_motion_across_the_plane(key, rng):
    arm = ROBOTS[key].arm
    for _ in range(20):
        q = regular(arm, rng)
        places = _zeros_of(lambda q2, q=q: _determinant(arm, [q[0], q2, *q[2:]]), arm.limits[1])
        if places:
            break
    q[1] = places[0]
    found = {each.kind: each for each in singularities(arm, q)}
    assert set(found) == {"shoulder"}
    assert found["shoulder"].joints == (1,)
    J = _at_wrist_centre(arm, q)[:3, :3]
    assert np.linalg.norm(found["shoulder"].direction @ J) < math.sin(DEGREE) * np.linalg.norm(J, 2)


@pytest.mark.parametrize("key", PARALLEL)
def test_arms_with_three_parallel_axes(key, rng):
    arm = ROBOTS[key].arm
    q = regular(arm, rng)
    wrist = [*q[:4], 0.0, q[5]]
    assert kinds(arm, wrist) == ["wrist"]
    assert "axes 4 and 6 are parallel" in singularities(arm, wrist)[0].says
    assert kinds(arm, [*q[:2], 0.0, *q[3:]]) == ["elbow"]
    for _ in range(20):
        q = regular(arm, rng)
        places = _zeros_of(lambda q2, q=q: _determinant(arm, [q[0], q2, *q[2:]]), (-math.pi, math.pi))
        if places:
            break
    q[1] = places[0]
    assert kinds(arm, q) == ["shoulder"]


def test_the_elbow_arm_on_its_axis_and_stretched_upright():
    robot = ROBOTS["elbow_3r"]
    (found,) = singularities(robot.arm, robot.poses["on the axis"])
    assert found.kind == "shoulder"
    assert "joint 1 does not move it" in found.says
    assert line_angle(found.direction, robot.arm.frames(robot.poses["on the axis"])[1][:3, 2]) < DEGREE
    assert not found.boundary
    assert kinds(robot.arm, robot.poses["straight up"]) == ["shoulder", "elbow"]


def test_the_rrp_of_the_notes(truth):
    arm = ROBOTS["polar_rrp"].arm
    (straight_up,) = singularities(arm, truth["C5.1.4-rrp-q2=+90"]["inputs"]["q"])
    assert straight_up.kind == "shoulder"
    assert straight_up.joints == (1,)
    shut = singularities(arm, truth["C5.1.4-rrp-q3=0"]["inputs"]["q"])
    assert [each.joints for each in shut] == [(1,), (2,)]
    assert "joint 1 does not move the tool" in shut[0].says
    assert "Joint 2 does not move the tool" in shut[1].says
    assert abs(shut[0].direction @ shut[1].direction) < 1e-12


SEVEN = {
    "elbow": ([20, 30, 40, 0, 30, 50, 10], False),
    "shoulder": ([20, 0, 90, 80, 30, 40, 10], False),
    "wrist": ([20, 30, 40, 80, 90, 0, 10], True),
}


@pytest.mark.parametrize("kind", SEVEN)
def test_an_arm_of_seven_turns_has_shoulder_elbow_and_wrist(kind):
    arm, (degrees, turning) = ROBOTS["iiwa7"].arm, SEVEN[kind]
    (found,) = singularities(arm, np.radians(degrees))
    assert (found.kind, found.turning) == (kind, turning)
    assert found.says.lower().startswith(kind)
    lost = task_subspaces(arm, np.radians(degrees)).lost
    assert lost.shape == (6, 1)
    if not turning:
        moving = lost[:3, 0] / np.linalg.norm(lost[:3, 0])
        assert line_angle(found.direction, moving) < DEGREE
    else:
        J = arm.jacobian(np.radians(degrees))
        _, _, V_T = np.linalg.svd(at_point(arm, np.radians(degrees), 4, 6)[:3])
        assert np.abs(found.direction @ J[3:] @ V_T[3:].T).max() < math.sin(DEGREE)


def test_seven_turns_two_pairs_in_line_and_none_that_is_not_singular():
    arm = ROBOTS["iiwa7"].arm
    assert kinds(arm, np.radians([20, 0, 40, 80, 30, 0, 10])) == ["wrist"]
    for degrees in ([20, 0, 40, 80, 30, 50, 10], [20, 30, 40, 80, 30, 0, 10]):
        assert singularities(arm, np.radians(degrees)) == ()


def test_the_shoulder_of_an_arm_without_a_planar_part_is_named():
    arm = ROBOTS["stanford"].arm
    q = np.radians([20.0, 0.0, 0.0, 30.0, 40.0, 10.0])
    q[2] = 0.5
    (found,) = singularities(arm, q)
    assert (found.kind, found.joints) == ("shoulder", (1, 2))
    J = _at_wrist_centre(arm, q)[:3, :3]
    assert np.linalg.norm(found.direction @ J) < math.sin(DEGREE) * np.linalg.norm(J, 2)


def test_redundant_arms_say_which_joints_turn_about_one_line():
    (found,) = singularities(ROBOTS["panda"].arm, np.zeros(7))
    assert "oints 1 and 3 turn about the same line" in found.says
    assert found.kind == "dependent"


def test_joint_values_of_another_number_are_refused():
    with pytest.raises(InputError, match="q: expected 2 finite numbers"):
        singularities(ROBOTS["planar_2r"].arm, [1.0])


def _determinant(arm, q):
    return float(np.linalg.det(task_matrix(arm, q)))


def _at_wrist_centre(arm, q):
    """Return the Jacobian at the point where the last three axes meet."""
    frames = np.asarray(arm.frames(q))
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    z, o = frames[:, :3, 2], frames[:, :3, 3]
    a, b, way = z[3], z[4], o[4] - o[3]
    normal = np.cross(a, b)
    centre = o[3] + np.cross(way, b) @ normal / (normal @ normal) * a
    J = arm.jacobian(q)
    linear = J[:3] + np.cross(J[3:].T, centre - arm.position(q)).T
    return np.vstack([linear, J[3:]])


def _zeros_of(function, limits, samples=181):
    places = np.linspace(*limits, samples)
    values = [function(place) for place in places]
    found = []
    for k in range(samples - 1):
        if values[k] * values[k + 1] < 0.0:
            low, high = places[k], places[k + 1]
            for _ in range(80):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if function(low) * function(middle) > 0.0 else (low, middle)
            found.append(0.5 * (low + high))
    return found


def _zero_of(function, limits):
    """Return the zero with both neighbours regular; there is one where the arm is stretched or folded."""
    return _zeros_of(function, limits)[0]


@pytest.mark.parametrize("size", [1.0, 1e-2, 1e-3, 1e-4])
def test_the_usual_rank_does_not_depend_on_the_size_of_an_arm_that_slides(size):
    """The slide of a small arm is short, too: one of metres would leave no length that counts beside it."""
    turn = math.pi / 2
    table = [("R", 0, turn, 0.3, turn), ("R", 0, -1.5, 0.3, 0), ("R", 0.5, 0, 0.3, 0)]
    table += [("P", 0.5, -turn, 0.3, 0), ("R", 1, math.pi, 0, 0), ("R", 0, 0.6, 0.2, 0.6)]
    sized = [(kind, size * a, alpha, size * d, theta) for kind, a, alpha, d, theta in table]
    limits = [(0.0, size) if kind == "P" else (-np.pi, np.pi) for kind, *_ in table]
    arm = Arm.from_dh(sized, limits=limits, task="pose")
    assert usual_rank(arm) == 6
    assert singularities(arm, [0.3, 0.5, 0.7, 0.4 * size, 0.9, 0.2]) == ()
