"""Orientation through several waypoints: through all of them, without a jump but at corners, held where it is held."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import ToolPath, about_one_axis, follow, path_type
from armlab.kin.motion.through import NEAR, Through, _coefficients
from armlab.kin.rotations import skew

STEP = 1e-6


def waypoints(rng, count, largest=np.pi):
    """Random orientations, each turned from the last one by up to an angle."""
    axes = rng.normal(size=(count, 3))
    turns = Rotation.from_rotvec(axes / np.linalg.norm(axes, axis=1)[:, None] * largest * rng.random((count, 1)))
    every = [turns[0]]
    for turn in turns[1:]:
        every.append(every[-1] * turn)
    return np.array([each.as_matrix() for each in every])


def random_places(rng, count):
    steps = 0.02 + rng.random(count - 1)
    return np.concatenate([[0.0], np.cumsum(steps)[:-1] / steps.sum(), [1.0]])


def check_rates(orientation, s):
    """Angular velocity and its derivative against central differences."""
    omega, change = orientation.angular(s)
    slope = (orientation.rotation(s + STEP) - orientation.rotation(s - STEP)) / (2 * STEP)
    turned = slope @ np.swapaxes(orientation.rotation(s), 1, 2)
    size = np.abs(omega).max() + 1
    np.testing.assert_allclose(skew(omega), turned, rtol=0, atol=1e-8 * size**3)
    differences = (orientation.angular(s + STEP)[0] - orientation.angular(s - STEP)[0]) / (2 * STEP)
    np.testing.assert_allclose(change, differences, rtol=0, atol=1e-7 * size**3)


@pytest.mark.parametrize("largest", [np.pi, 0.3, 1e-4])
def test_it_passes_all_waypoints_and_its_angular_velocity_does_not_jump(rng, largest):
    for _ in range(30):
        count = int(rng.integers(3, 8))
        matrices, places = waypoints(rng, count, largest), random_places(rng, count)
        orientation = Through(matrices, places)
        np.testing.assert_allclose(orientation.rotation(places), matrices, rtol=0, atol=1e-12)
        before, behind = (orientation.angular(places[1:-1] + side)[0] for side in (-1e-12, 0.0))
        fastest = np.abs(orientation.angular(np.linspace(0, 1, 401))[0]).max()
        np.testing.assert_allclose(before, behind, rtol=0, atol=1e-8 * fastest)
        inside = 0.5 * (places[1:] + places[:-1])
        check_rates(orientation, np.concatenate([inside, inside + 0.005]))
        assert len(orientation.corners) == 0


def test_half_turns_and_shortest_steps_leave_nothing_infinite(rng):
    """A solver for a continuous acceleration diverges here."""
    turn = Rotation.from_rotvec
    matrices = [(turn([0.0, 0.0, np.pi * k]) * turn([np.pi * (k // 2), 0.0, 0.0])).as_matrix() for k in range(6)]
    places = np.array([0.0, 1e-6, 0.5, 0.5 + 1e-6, 1.0 - 1e-6, 1.0])
    orientation = Through(matrices, places)
    np.testing.assert_allclose(orientation.rotation(places), matrices, rtol=0, atol=1e-9)
    turned = np.array([about_one_axis(a, b).angle for a, b in pairwise(matrices)])
    omega, _ = orientation.angular(np.linspace(0, 1, 2001))
    assert np.linalg.norm(omega, axis=1).max() < 5.0 * (turned / np.diff(places)).max()
    assert sum("A half turn" in remark for remark in orientation.remarks) == len(orientation.remarks) > 0


def test_from_corner_to_corner_it_turns_about_one_axis(rng):
    matrices, places = waypoints(rng, 4), np.array([0.0, 0.2, 0.7, 1.0])
    orientation = Through(matrices, places, [0.2, 0.7])
    assert orientation.corners.tolist() == [0.2, 0.7]
    for k in range(3):
        s = np.linspace(0.0, 1.0, 12)[:-1]
        alone = about_one_axis(matrices[k], matrices[k + 1])
        h = places[k + 1] - places[k]
        np.testing.assert_allclose(orientation.rotation(places[k] + h * s), alone.rotation(s), rtol=0, atol=1e-12)
        omega, change = orientation.angular(places[k] + h * s)
        np.testing.assert_allclose(omega, alone.angular(s)[0] / h, rtol=0, atol=1e-11)
        np.testing.assert_allclose(change, 0.0, rtol=0, atol=1e-9)
    one = Through(matrices, places, [0.7])
    assert one.corners.tolist() == [0.7]
    jumps = one.angular([0.2, 0.7])[0] - one.angular([0.2 - 1e-12, 0.7 - 1e-12])[0]
    assert np.abs(jumps[0]).max() < 1e-8 < 0.1 < np.abs(jumps[1]).max()


def test_the_angular_velocity_at_a_waypoint_is_that_of_the_parabola_through_it_and_its_neighbours():
    """Of a turn by s^2 about one axis it is 2 s, however uneven the places are."""
    places, axis = np.array([0.0, 0.1, 0.4, 0.55, 1.0]), np.array([2.0, -1.0, 2.0]) / 3.0
    way = Through(Rotation.from_rotvec(places[:, None] ** 2 * axis).as_matrix(), places)
    omega, _ = way.angular(places[1:-1])
    np.testing.assert_allclose(omega, 2.0 * places[1:-1, None] * axis, rtol=0, atol=1e-12)


def test_turns_in_one_sense_about_one_axis_never_go_back(rng):
    axis = np.array([1.0, 2.0, 2.0]) / 3.0
    for _ in range(20):
        angles = np.cumsum(np.pi * 10.0 ** rng.uniform(-4.0, 0.0, 6))
        way = Through(Rotation.from_rotvec(angles[:, None] * axis).as_matrix(), random_places(rng, 6))
        omega, _ = way.angular(np.linspace(0.0, 1.0, 2001))
        assert (omega @ axis).min() >= -1e-12 * np.abs(omega).max()


def test_the_same_orientation_at_two_waypoints_is_kept_in_between(rng):
    a, b, c = waypoints(rng, 3)
    orientation = Through([a, b, b, c], [0.0, 0.3, 0.6, 1.0])
    np.testing.assert_allclose(orientation.rotation(np.linspace(0.3, 0.6, 20)), [b] * 20, rtol=0, atol=1e-14)


def test_coefficients_are_one_function_on_both_sides(rng):
    """Where the sum of powers ends, the closed form goes on."""
    p = rng.normal(size=(50, 3))
    p *= np.sqrt(NEAR) / np.linalg.norm(p, axis=1)[:, None]
    for below, above in zip(_coefficients(p * (1 - 1e-9)), _coefficients(p * (1 + 1e-9)), strict=True):
        np.testing.assert_allclose(below, above, rtol=1e-8, atol=0)
    for angle in (0.0, 1e-9, 0.3, 1.7, 3.1):
        S = skew(np.array([0.0, angle, 0.0]))
        A, B, *_ = (float(each[0]) for each in _coefficients(np.array([0.0, angle, 0.0])))
        judge = Rotation.from_rotvec([0.0, angle, 0.0]).as_matrix()
        np.testing.assert_allclose(np.eye(3) + A * S + B * S @ S, judge, rtol=0, atol=1e-15)


def test_the_joint_motion_along_a_smooth_path_has_no_corner_either():
    """Accelerations from neighbouring samples do not grow with their number."""
    arm = catalogue()["puma560"].arm
    knots = np.radians([[-18, 62, -160, 0, -62, 0], [0, 50, -145, 20, -50, 30], [20, 60, -150, -20, -70, 60]])
    poses = arm.fk(knots)
    way = path_type("circle").path(poses[:, :3, 3])
    places = [0.0, float(way.pieces[0]) if len(way.pieces) else 0.45, 1.0]
    tool = ToolPath(way, Through(poses[:, :3, :3], places))
    largest = []
    for count in (101, 401, 1601):
        found = follow(arm, tool, knots[0], count)
        assert found.whole, found.reason
        largest.append(np.abs(found.joint_path().at(np.linspace(0, 1, 997), 2)).max())
    assert max(largest) < 1.3 * min(largest)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: Through([np.eye(3)]), "rotations: expected at least two"),
        (lambda: Through([np.eye(3), np.zeros((3, 3))]), "waypoint 2"),
        (lambda: Through([np.eye(3), -np.eye(3)]), "waypoint 2 is not a rotation matrix but a reflection"),
        (lambda: Through([np.eye(3)] * 3, [0, 0.5, 0.5]), "waypoint 3: its time"),
        (lambda: Through([np.eye(3)] * 3, [0, 0.5, 0.9]), "places: expected the first 0 and the last 1"),
    ],
)
def test_what_is_no_orientation_is_refused(make, told):
    with pytest.raises(InputError, match=told):
        make()
