"""Where an eye stands and what it sees."""

import itertools

import numpy as np
import pytest

from armlab.ui.eye import TALL, Eye, Facing, Z, between, nearest_view
from support.looking import degrees_off, upper_side

BOX = np.array(list(itertools.product((-1.0, 1.0), (-0.3, 0.3), (0.0, 0.5))))
X, Y = np.eye(3)[:2]


def directions(rng, count):
    """Return directions all around, and two that are nearly vertical."""
    found = rng.normal(size=(count, 3))
    found[0], found[1] = [1e-7, 0.0, 1.0], [0.0, 1e-4, -1.0]
    return found / np.linalg.norm(found, axis=1)[:, None]


@pytest.mark.parametrize("aspect", [0.4, 1.0, 1.5, 3.0])
def test_from_every_side_all_points_are_in_the_picture_and_fill_it(aspect, rng):
    for back in directions(rng, 25):
        points = rng.normal(size=(60, 3)) * rng.uniform(0.05, 3.0, 3) + rng.normal(size=3)
        eye = nearest_view(points, back, Z, TALL, aspect)
        assert degrees_off(eye.back, back) < 1e-6
        assert eye.sees(points, TALL, aspect)
        nearer = Eye(eye.position - 0.15 * eye.distance * back, eye.look_at, Z)
        assert not nearer.sees(points, TALL, aspect), "no nearer than it has to be"


def test_what_is_beside_or_behind_is_not_seen():
    eye = Eye(np.array([0.0, -10.0, 0.0]), np.zeros(3), Z)
    assert eye.sees(np.zeros((1, 3)), TALL, 1.0)
    for away in ([0.0, -20.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -3.0], [0.0, -10.0, 0.0]):
        assert not eye.sees(np.array([away]), TALL, 1.0)
    assert eye.sees(np.array([[3.0, 0.0, 0.0]]), TALL, 1.2), "a wider picture shows more"


@pytest.mark.parametrize(
    ("normal", "up"),
    [
        (Z, Y),
        (Z, -X),
        (-Z, Y),
        (X, Z),
        (-Y, Z),
        (X, -Z),
        (np.array([0.6, 0.8, 0.0]), Z),
        (np.array([0.0, -0.6, 0.8]), X),
    ],
)
def test_a_plane_is_looked_at_square_with_its_vertical_up_and_never_from_below(normal, up):
    facing = Facing(normal, up)
    eye = nearest_view(BOX, *facing.direction(), TALL, 1.5)
    assert degrees_off(eye.back, normal if normal[2] >= 0.0 else -normal) < 0.1
    assert degrees_off(upper_side(eye), up if up[2] >= 0.0 else -up) < 0.1
    assert eye.squares(facing)
    assert eye.sees(BOX, TALL, 1.5)
    aside = Eye(eye.position + 0.005 * eye.distance * np.cross(up, eye.back), eye.look_at, eye.up)
    assert not aside.squares(facing)


def test_an_upright_plane_leaves_the_eye_upright_so_that_a_hand_turns_it_as_always():
    for normal, up in ((Z, Y), (Z, X), (Y, Z), (np.array([0.6, 0.8, 0.0]), Z)):
        np.testing.assert_array_equal(Facing(normal, up).direction()[1], Z)


def test_a_way_begins_and_ends_where_it_should_and_keeps_its_distance_from_what_is_looked_at():
    start = Eye(np.array([3.0, 0.0, 1.0]), np.zeros(3), Z)
    top = nearest_view(BOX, *Facing(Z, Y).direction(), TALL, 1.5)
    for end in (top, Eye(np.array([-3.0, 0.1, 1.0]), np.array([0.0, 0.2, 0.1]), Z)):
        assert between(start, end, 1.0) is end
        assert between(start, end, 0.0).near(start)
        on_the_way = [between(start, end, s) for s in np.linspace(0.0, 1.0, 40)]
        for one, other in itertools.pairwise(on_the_way):
            assert degrees_off(one.back, other.back) < 8.0, "no jump, and no flip where it passes the vertical"
            assert degrees_off(upper_side(one), upper_side(other)) < 12.0
        low, high = sorted((start.distance, end.distance))
        assert all(low - 1e-9 <= eye.distance <= high + 1e-9 for eye in on_the_way)


def test_an_eye_that_looks_at_itself_has_a_direction_too():
    lost = Eye(np.ones(3), np.ones(3), Z)
    np.testing.assert_array_equal(lost.back, Z)
    assert not lost.near(Eye(np.ones(3), np.ones(3) + 1e-3, Z))
