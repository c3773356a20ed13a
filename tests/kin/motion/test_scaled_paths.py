"""Paths through coordinates of different units: what is measured along the way is in units of the scales."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.path_types import path_type, path_types
from armlab.kin.motion.trajectory import Trajectory

JOINT = [key for key, kind in path_types().items() if "joint" in kind.spaces]

MM = np.array([1.0, 1.0, 1000.0])
SCALES = np.array([1.0, 1.0, 0.4])
"""Two angles and a sliding joint in metres, on an arm with a length scale of 0.4 m."""

OPTIONS = [
    ("overfly", {}),
    ("overfly", {"amount": [0.05], "speed": [0.5]}),
    ("overfly", {"by": "time", "amount": [0.02], "shape": "quartic"}),
    *(
        (key, {"spacing": spacing})
        for key in ("spline", "blends", "interpolating", "hermite")
        for spacing in ("chord", "centripetal")
    ),
]

S = np.linspace(0.0, 1.0, 41)


def knots_for(kind, rng):
    count = min(max(kind.least, 4), kind.most or 4)
    return np.cumsum(rng.uniform(0.2, 0.9, size=(count, 3)) * [1.0, -1.0, 0.3], axis=0)


@pytest.mark.parametrize(
    ("key", "options"), [*OPTIONS, *((key, {}) for key in JOINT if key not in dict(OPTIONS))], ids=str
)
def test_metres_or_millimetres_make_no_difference(key, options, rng):
    kind = path_type(key)
    knots = knots_for(kind, rng)
    metres = kind.path(knots, scales=SCALES, **options)
    millimetres = kind.path(knots * MM, scales=SCALES * MM, **options)
    assert (metres.duration or 1.0) == pytest.approx(millimetres.duration or 1.0, rel=1e-12)
    np.testing.assert_allclose(metres.pieces, millimetres.pieces, rtol=0, atol=1e-12)
    s = rng.uniform(size=40)
    for order in range(4):
        one, other = metres.at(s, order), millimetres.at(s, order) / MM
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-9 * max(1.0, float(np.abs(one).max())))


@pytest.mark.parametrize(("key", "options"), OPTIONS[:1] + OPTIONS[3:], ids=str)
def test_without_scales_they_would(key, options, rng):
    kind = path_type(key)
    knots = knots_for(kind, rng)
    one, other = kind.path(knots, **options).at(S) * MM, kind.path(knots * MM, **options).at(S)
    assert np.abs(one - other).max() > 1e-3


def test_the_speed_along_the_way_is_in_radians_and_length_scales():
    path = path_type("overfly").path([[0, 0], [0.3, 0.16], [1, 0.16]], scales=[1.0, 0.4], speed=[0.5], amount=[0.0])
    # 0.16 m are 0.4 length scales: the first line is 0.5 long, the second 0.7.
    assert path.duration == pytest.approx(0.5 / 0.5 + 0.7 / 0.5, rel=1e-12)
    np.testing.assert_allclose(path.at(0.1, 1) / path.duration, [0.3, 0.16], rtol=1e-12)


@pytest.mark.parametrize(
    ("key", "names"),
    [("spline", ("v_start", "v_end")), ("cubic", ("v_start", "v_end")), ("quintic", ("a_start", "a_end"))],
)
def test_a_number_for_each_coordinate_is_in_its_own_unit(key, names, rng):
    knots, given = rng.normal(size=(2, 3)), rng.normal(size=(2, 3))
    path = path_type(key).path(knots, scales=SCALES, duration=2.0, **dict(zip(names, given, strict=True)))
    motion = Trajectory(path, law_type("constant").law(2.0))
    found = motion.at([0.0, 2.0], 1 if names[0][0] == "v" else 2)
    np.testing.assert_allclose(found, given, rtol=0, atol=1e-9)
    np.testing.assert_allclose(motion.at([0.0, 2.0]), knots, rtol=0, atol=1e-12)


def test_rows_of_derivatives_are_in_their_own_units(rng):
    knots, start = rng.normal(size=(2, 3)), rng.normal(size=(2, 3))
    path = path_type("polynomial").path(knots, scales=SCALES, start=start)
    np.testing.assert_allclose([path.at(0.0, 1), path.at(0.0, 2)], start, rtol=0, atol=1e-9)


@pytest.mark.parametrize("scales", [[1.0, 1.0], [1.0, 0.0, 1.0], [1.0, -1.0, 1.0], [1.0, np.inf, 1.0], "metres", 1.0])
def test_scales_that_cannot_be_are_refused(scales, rng):
    with pytest.raises(InputError, match="scales: expected 3 positive numbers, got"):
        path_type("line").path(rng.normal(size=(2, 3)), scales=scales)


def test_an_option_with_too_few_numbers_is_named_with_scales_as_without(rng):
    with pytest.raises(InputError, match=r"v_start: expected 3 numbers, one for each coordinate, got \[1, 0\]"):
        path_type("spline").path(rng.normal(size=(3, 3)), scales=SCALES, v_start=[1.0, 0.0])
