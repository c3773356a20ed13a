"""The boundary of a workspace as triangles, and what lies near it, against spheres, rings and boxes."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.sections import section
from armlab.kin.workspace.surface import near_boundary, surface

FULL = [[-np.pi, np.pi]]


def elbow(l2=1.0, l3=0.6, turn=np.pi):
    rows = [("R", 0.0, np.pi / 2, 0.5, 0.0), ("R", l2, 0.0, 0.0, 0.0), ("R", l3, 0.0, 0.0, 0.0)]
    return Arm.from_dh(rows, limits=[[-turn, turn], *FULL * 2])


def area(found):
    a, b, c = np.moveaxis(found.vertices[found.faces], 1, 0)
    return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def test_an_elbow_arm_ends_at_two_spheres():
    arm = elbow()
    found = surface(section(arm, 128))
    radius = np.linalg.norm(found.vertices - [0.0, 0.0, 0.5], axis=1)
    on = np.minimum(np.abs(radius - 1.6), np.abs(radius - 0.4))
    # The outline closes along the axis of joint 1, which carries it nowhere.
    off_axis = np.hypot(*found.vertices[:, :2].T) > 1e-6
    assert on[off_axis].max() < 0.02
    assert area(found) == pytest.approx(4.0 * np.pi * (1.6**2 + 0.4**2), rel=0.03)


def test_a_limited_first_joint_ends_at_walls():
    arm = elbow(turn=np.pi / 3)
    found = surface(section(arm, 128))
    azimuth = np.arctan2(found.vertices[:, 1], found.vertices[:, 0])
    # Elbow and shoulder turn all the way, so the arm reaches behind itself: 120 degrees in front and behind.
    folded = np.abs(np.remainder(azimuth + np.pi / 2, np.pi) - np.pi / 2)
    off_axis = np.hypot(*found.vertices[:, :2].T) > 0.1
    assert folded[off_axis].max() < np.pi / 3 + 0.01
    half_disc = 0.5 * np.pi * (1.6**2 - 0.4**2)
    shell = 4.0 * np.pi * (1.6**2 + 0.4**2) * 2.0 / 3.0
    assert area(found) == pytest.approx(shell + 4.0 * half_disc, rel=0.08)


def test_a_cartesian_arm_ends_at_the_sides_of_a_box():
    arm = catalogue()["cartesian_3p"].arm
    found = surface(section(arm, 128))
    corners = np.array([arm.position(q) for q in np.stack(np.meshgrid(*arm.limits), axis=-1).reshape(-1, 3)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    assert np.all(found.vertices > low - 0.05)
    assert np.all(found.vertices < high + 0.05)
    side = np.minimum(np.abs(found.vertices - low), np.abs(found.vertices - high)).min(axis=1)
    assert np.median(side) < 0.01
    a, b, c = high - low
    assert area(found) == pytest.approx(2.0 * (a * b + b * c + c * a), rel=0.08)


def test_a_planar_arm_has_no_surface():
    assert len(surface(section(catalogue()["planar_2r"].arm, 128)).faces) == 0


def test_what_is_near_the_boundary_of_a_ring(rng):
    arm = catalogue()["planar_2r_unequal"].arm
    l1, l2 = (row.a for row in arm.rows)
    q = rng.uniform(-np.pi, np.pi, (4000, 2))
    points = arm.position(q)
    r = np.linalg.norm(points[:, :2], axis=1)
    away = np.minimum(l1 + l2 - r, r - abs(l1 - l2))
    near = near_boundary(section(arm, 512), points, 0.1)
    clear = np.abs(away - 0.1) > 0.005
    np.testing.assert_array_equal(near[clear], away[clear] <= 0.1)
    assert 0 < near.sum() < len(points)


def test_walls_are_near_too(rng):
    arm = elbow(turn=np.pi / 3)
    whole, joint = section(arm, 128), first_joint(arm)
    # On the arc at rho = 1, height of the shoulder: far from both spheres, so only the walls count.
    s = np.linspace(-np.pi / 3, np.pi / 3, 41)
    points = joint.join(np.stack([np.full(41, 1.0), np.full(41, 0.5), s], axis=1))
    near = near_boundary(whole, points, 0.1)
    expected = np.pi / 3 - np.abs(s) <= 0.1
    clear = np.abs(np.pi / 3 - np.abs(s) - 0.1) > 0.03
    np.testing.assert_array_equal(near[clear], expected[clear])
