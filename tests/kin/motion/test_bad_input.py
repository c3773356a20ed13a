"""Waypoints, times and options that cannot be: a sentence that names the waypoint."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.law_types import free_law_types, law_type
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path_types import path_type, path_types

NAN = float("nan")


@pytest.mark.parametrize("key", list(path_types()))
def test_coincident_waypoints_are_named(key, rng):
    kind = path_type(key)
    if not kind.apart:
        return
    count = max(kind.least, min(kind.most or 4, 4))
    knots = rng.normal(size=(count, 3))
    knots[-1] = knots[-2]
    with pytest.raises(InputError, match=f"waypoint {count}: the same as waypoint {count - 1}"):
        kind.path(knots)


@pytest.mark.parametrize("key", ["spline", "blends", "lts_434", "interpolating"])
def test_paths_with_times_may_stay_at_a_waypoint_but_not_share_out_time_by_distance(key, rng):
    knots = rng.normal(size=(4, 2))
    knots[2] = knots[1]
    path = path_type(key).path(knots, times=[0, 1, 2, 3])
    np.testing.assert_allclose(path.at(1.0), knots[-1], rtol=0, atol=1e-9)
    with pytest.raises(InputError, match="waypoint 3: the same as waypoint 2"):
        path_type(key).path(knots)


@pytest.mark.parametrize("second", [1e-17, 1e-10, 1.0 - 1e-16])
def test_waypoints_too_close_in_time_for_one_polynomial_are_named(second):
    k = 2 if second < 0.5 else 3
    with pytest.raises(InputError, match=f"waypoint {k}: its time is too close to that of waypoint {k - 1} for one"):
        path_type("interpolating").path([[0.0], [1.0], [2.0]], times=[0.0, second, 1.0])


@pytest.mark.parametrize("key", list(path_types()))
def test_a_waypoint_that_is_not_a_number_is_named(key, rng):
    kind = path_type(key)
    knots = rng.normal(size=(max(kind.least, 2), 3))
    for bad in (NAN, np.inf):
        knots[1, 2] = bad
        with pytest.raises(InputError, match=r"waypoint 2: expected finite numbers, got \["):
            kind.path(knots)


@pytest.mark.parametrize("key", list(path_types()))
def test_one_waypoint_is_too_few(key):
    kind = path_type(key)
    with pytest.raises(InputError, match=r"waypoints: .* takes .*, got 1"):
        kind.path([[0.0, 1.0, 2.0]])
    with pytest.raises(InputError, match="waypoint"):
        kind.path([])


@pytest.mark.parametrize("key", [key for key, kind in path_types().items() if kind.most])
def test_too_many_are_too_many(key, rng):
    kind = path_type(key)
    with pytest.raises(InputError, match=f"got {kind.most + 1}"):
        kind.path(rng.normal(size=(kind.most + 1, 3)))


@pytest.mark.parametrize(
    ("knots", "told"),
    [
        ([[0, 0], [1, 2, 3]], "waypoint 2: expected 2 numbers as in waypoint 1"),
        ([[0, 0], "text"], "waypoint 2: expected 2 numbers"),
        ([["a", 0], [1, 2]], "waypoint 1: expected numbers"),
        ("text", "waypoint"),
        (None, "waypoint"),
        (np.zeros((2, 3, 4)), "waypoints: expected a list of points"),
    ],
)
def test_what_is_no_list_of_points_is_refused(knots, told):
    with pytest.raises(InputError, match=told):
        path_type("polyline").path(knots)


@pytest.mark.parametrize(
    ("key", "count", "options", "told"),
    [
        ("spline", 4, {"times": [0, 1, 1, 2]}, "waypoint 3: its time 1 s must be later than the 1 s of waypoint 2"),
        ("spline", 4, {"times": [0, 2, 1, 3]}, "waypoint 3: its time 1 s must be later than the 2 s of waypoint 2"),
        ("spline", 4, {"times": [0, 1, 2]}, "times: expected 4, one for each waypoint, got 3"),
        ("spline", 4, {"times": [[0, 1, 2, 3]]}, r"times: expected numbers in one row, got \[\[0, 1, 2, 3\]\]"),
        ("spline", 4, {"v_start": [[1, 0, 0]]}, "v_start: expected numbers in one row"),
        ("spline", 4, {"times": [0, 1, NAN, 2]}, "times: expected finite numbers"),
        ("spline", 4, {"duration": 0.0}, "duration: expected more than 0 s, got 0 s"),
        ("spline", 4, {"ends": "free"}, "ends: unknown name 'free'"),
        (
            "spline",
            4,
            {"ends": "natural", "v_start": [1, 0, 0]},
            "v_start: cannot be used while accelerations are given at both ends of the spline; choose velocities",
        ),
        (
            "spline",
            4,
            {"a_start": [1, 0, 0]},
            "a_start: cannot be used while velocities are given at both ends of the spline; choose accelerations",
        ),
        ("spline", 4, {"v_start": [1, 0]}, "v_start: expected 3 numbers"),
        (
            "spline",
            4,
            {"ends": "both", "times": [0, 1, 2, 3], "virtual": [1.5, 2.5]},
            r"virtual: expected one time inside .*, got 1\.5 s and 2\.5 s$",
        ),
        ("spline", 4, {"tension": 1}, "options of spline: unknown name 'tension'"),
        ("cubic", 2, {"duration": -1.0}, "duration: expected more than 0"),
        ("polynomial", 2, {"degree": 4}, "degree: expected an odd number up to 15, got 4"),
        ("polynomial", 2, {"degree": 3, "start": [[1, 2, 3]]}, "not both"),
        ("polynomial", 2, {"start": [[1, 2]]}, "start: expected rows of 3 numbers"),
        ("exponential", 2, {"rate": 0.0}, "rate: expected a number that is not 0"),
        ("clothoid", 2, {"turn": 0.0}, "turn: expected an angle that is not 0"),
        ("helix", 2, {"turns": 1.5}, "turns: expected a whole number that is not 0"),
        ("helix", 2, {"radius": 0.0}, "radius: expected a positive number$"),
        ("blends", 3, {"times": [0, 1, 2], "blend": [0.1, 1.9, 0.2]}, "waypoint 2: its blend does not fit"),
        ("blends", 3, {"blend": [0.1, 0.2]}, "blend: expected one number, or 3: one for each waypoint; got 2"),
        ("overfly", 4, {"amount": 100.0}, "waypoint 2: its blend does not fit: between waypoints 1 and 2"),
        ("overfly", 4, {"amount": -1.0}, "amount: expected no negative number$"),
        ("overfly", 4, {"speed": [1.0, -math.radians(1.0), 1.0]}, "speed: expected a positive number$"),
        (
            "overfly",
            4,
            {"speed": np.array([[0.5, 1 / 3]])},
            r"speed: expected numbers in one row, got \[\[0\.5, 0\.333333\]\]",
        ),
        ("clothoid", 2, {"turn": 100.0}, "turn: expected at least -3600° and at most 3600°$"),
        ("blends", 3, {"times": [0, 1, 2], "blend": [0.1, 1.9, 0.2]}, "the blends take 1.05 s and there are 1 s$"),
    ],
)
def test_wrong_options_are_named(key, count, options, told, rng):
    with pytest.raises(InputError, match=told):
        path_type(key).path(rng.normal(size=(count, 3)), **options)


def test_three_points_on_a_line_have_no_circle():
    with pytest.raises(InputError, match="waypoint 3: the three points are on a straight line"):
        path_type("circle").path([[0, 0, 0], [1, 1, 1], [3, 3, 3]])
    with pytest.raises(InputError, match="waypoint 3: the same as waypoint 1"):
        path_type("circle").path([[0, 0, 0], [1, 1, 1], [0, 0, 0]])


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_three_points_almost_on_a_line_have_no_circle_to_be_drawn(size):
    # The middle one is h beside the chord of length 1: the radius is h/2 + 1/(8 h).
    def through(h):
        return path_type("circle").path(size * np.array([[0.0, 0.0, 0.0], [0.5, h, 0.0], [1.0, 0.0, 0.0]]))

    assert through(1.0 / 7900.0).radius == pytest.approx(size * (0.5 / 7900.0 + 7900.0 / 8.0), rel=1e-6)
    with pytest.raises(InputError, match=r"waypoint 3: .* almost on a straight line, their circle would be 1020 times"):
        through(1.0 / 8160.0)


def test_blends_that_do_not_fit_are_told_in_parts_of_the_line():
    with pytest.raises(
        InputError, match=r"waypoint 2: .* between waypoints 2 and 3 the blends take 125\.1 % of the line$"
    ):
        path_type("overfly").path([[0, 0], [2, 0], [2, 1], [4, 1]], by="d2", amount=[0.6255, 0.3], speed=[1, 1, 0.48])


def test_a_helix_needs_three_coordinates():
    with pytest.raises(InputError, match="Helix needs 3 coordinates, got 2"):
        path_type("helix").path([[0, 0], [1, 1]])


def test_a_side_along_the_axis_is_refused():
    with pytest.raises(InputError, match="side: expected a direction across the way"):
        path_type("helix").path([[0, 0, 0], [0, 0, 1]], side=[0, 0, 2])


def test_unknown_paths_and_laws_are_told_with_those_that_exist():
    with pytest.raises(InputError, match=r"path: unknown name 'splin'; did you mean 'spline'"):
        path_type("splin")
    with pytest.raises(InputError, match=r"law: unknown name 'quintc'; did you mean 'quintic'"):
        law_type("quintc")


@pytest.mark.parametrize("key", list(free_law_types()))
@pytest.mark.parametrize("value", [0.0, -1.0, NAN, np.inf, "long", None])
def test_a_duration_that_is_not_positive_is_refused(key, value):
    with pytest.raises(InputError, match="duration: expected a positive number"):
        law_type(key).law(value)
    with pytest.raises(InputError, match="distance: expected a positive number"):
        law_type(key).law(1.0, value)


@pytest.mark.parametrize("value", [0.0, -1.0, NAN, "fast", [[1.0]], [1.0, 0.0], 1e-200, 1e200])
@pytest.mark.parametrize("name", ["velocity", "acceleration", "jerk"])
def test_a_limit_that_is_not_a_usable_positive_number_is_refused(name, value):
    with pytest.raises(InputError, match=f"limit of {name}.*: expected a (positive )?number"):
        Limits(**{name: value})


def test_limits_of_another_number_of_joints_are_refused():
    with pytest.raises(InputError, match=r"limit of acceleration: expected one number, or 3: one for each joint"):
        Limits(1.0, [1.0, 2.0]).for_joints(3)
    with pytest.raises(
        InputError, match=r"limits: expected Limits\(velocity=..., acceleration=..., jerk=...\) or an arm"
    ):
        limits_of(2.0, 3)


def test_a_law_without_the_limit_it_needs():
    with pytest.raises(InputError, match=r"limit of jerk: Double S .* needs one"):
        law_type("double_s").within(Limits(1.0, 1.0))
    with pytest.raises(InputError, match="limits: at least one"):
        law_type("quintic").within(Limits())


def test_a_limit_within_which_a_law_would_take_ages_is_refused():
    with pytest.raises(InputError, match=r"limits: the time within them: expected a number from 1e-30 to 1e\+30"):
        law_type("trapezoidal").within(Limits(1e-59, 1.0))
