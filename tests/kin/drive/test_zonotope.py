"""The outline of a zonotope against the convex hull of all corners of the box."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from armlab.kin.drive.tool_error import corners
from armlab.kin.drive.zonotope import outline


def volume(triangles):
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return float(np.abs(np.einsum("ki,ki->k", a, np.cross(b, c))).sum()) / 6.0


@pytest.mark.parametrize("n", [3, 4, 6, 7, 12])
def test_a_body_has_the_volume_and_the_corners_of_the_convex_hull(n, rng):
    generators = rng.normal(size=(3, n))
    found, hull = outline(generators), ConvexHull(corners(n) @ generators.T)
    assert found.rank == 3
    # Every side is seen from the middle, which lies inside.
    assert volume(found.triangles) == pytest.approx(hull.volume, rel=1e-9)
    kept = np.unique(np.round(np.concatenate(found.polygons), 9), axis=0)
    assert len(kept) == len(hull.vertices)


def test_parallel_and_coplanar_directions_share_a_side(rng):
    generators = rng.normal(size=(3, 6))
    generators[:, 1] = 2.0 * generators[:, 0]
    generators[:, 4] = generators[:, 0] - generators[:, 3]
    generators[:, 5] = 0.0
    found = outline(generators)
    assert volume(found.triangles) == pytest.approx(ConvexHull(corners(6) @ generators.T).volume, rel=1e-9)
    # Of 4 directions 3 are in one plane: that side, and three pairs with the remaining one.
    assert len(found.polygons) == 8


def test_a_flat_one_is_one_polygon(rng):
    plane = np.linalg.qr(rng.normal(size=(3, 2)))[0]
    flat = rng.normal(size=(2, 5))
    found = outline(plane @ flat)
    assert (found.rank, len(found.polygons)) == (2, 1)
    a, b, c = (found.triangles[:, k] for k in range(3))
    area = 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
    assert area == pytest.approx(ConvexHull(corners(5) @ flat.T).volume, rel=1e-9)


def test_a_line_and_a_point_have_no_sides():
    along = np.outer([1.0, 2.0, -1.0], [0.5, -0.25, 1.0])
    assert (outline(along).rank, outline(along).polygons) == (1, [])
    assert outline(np.zeros((3, 4))).rank == 0
    assert outline(np.zeros((3, 4))).triangles.shape == (0, 3, 3)
