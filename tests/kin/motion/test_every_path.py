"""What every path in the folder keeps: ends, rest, derivatives, continuity as stated, peaks."""

import numpy as np
import pytest

from armlab.kin.motion.extremes import extremes
from armlab.kin.motion.path_types import path_types

STEP = 1e-5


def away_from(places, rng, count=200):
    s = rng.uniform(2 * STEP, 1 - 2 * STEP, count)
    near = np.abs(s[:, None] - places).min(axis=1, initial=1.0) < 3 * STEP
    return s[~near]


ROUNDING = 1e-12
"""Relative: no path adds up terms more than a thousand times as large as their sum."""


def test_it_meets_its_waypoints(path_case):
    _, example, knots, path = path_case
    scale = np.abs(knots).max() + 1.0
    np.testing.assert_allclose(path.at(0.0), knots[0], rtol=0, atol=1e-12 * scale)
    if example.meets != "first":
        np.testing.assert_allclose(path.at(1.0), knots[-1], rtol=0, atol=ROUNDING * scale)
    if example.meets == "all" and example.knots > 2:
        s = np.concatenate([path.pieces, np.linspace(0.0, 1.0, 20001)])
        near = np.linalg.norm(path.at(s)[:, None] - knots, axis=2).min(axis=0)
        speed = np.linalg.norm(path.at(s, 1), axis=1).max()
        assert near.max() < speed / 20000


def test_it_rests_at_its_ends_as_far_as_stated_and_no_further(path_case):
    _, example, _, path = path_case
    values = path.derivatives([0.0, 1.0])
    for order in range(1, 4):
        size = np.abs(path.at(np.linspace(0, 1, 101), order)).max()
        if order <= example.rest:
            np.testing.assert_allclose(values[order], 0.0, rtol=0, atol=1e-9 * max(size, 1.0))
        elif order == example.rest + 1:
            assert np.abs(values[order]).max() > 1e-3 * size or size == 0.0


def test_its_derivatives_are_those_of_central_differences(path_case, rng):
    *_, path = path_case
    s = away_from(path.pieces, rng)
    for order in range(1, 4):
        differences = (path.at(s + STEP, order - 1) - path.at(s - STEP, order - 1)) / (2 * STEP)
        sizes = [np.abs(path.at(s, k)).max() for k in (order - 1, order)]
        # Truncation is of the fifth derivative at most; cancellation of the lower one over the step.
        tolerance = 1e-6 * sizes[1] + 1e-9 * sizes[0] / STEP + 3e-6 * max(sizes)
        np.testing.assert_allclose(path.at(s, order), differences, rtol=0, atol=tolerance)


def test_its_class_of_continuity_is_the_one_stated(path_case):
    """Not less: no lower derivative jumps anywhere. Not more: the next one jumps at a break."""
    _, example, _, path = path_case
    assert path.continuity == example.continuity
    eps = 1e-9
    for order in range(4):
        size = np.abs(path.at(np.linspace(0, 1, 1001), min(order + 1, 3))).max() + 1.0
        jumps = np.abs(path.at(path.breaks + eps, order) - path.at(path.breaks - eps, order))
        if order <= example.continuity:
            assert jumps.max(initial=0.0) < 1e-5 * size
        elif order == example.continuity + 1:
            assert jumps.max() > 1e-3 * np.abs(path.at(np.linspace(0, 1, 1001), order)).max()


def test_between_its_breaks_nothing_jumps(path_case, rng):
    *_, path = path_case
    s = away_from(path.breaks, rng)
    for order in range(3):
        higher = np.abs(path.at(np.linspace(0, 1, 2001), order + 1)).max()
        jumps = np.abs(path.at(s + 1e-7, order) - path.at(s - 1e-7, order))
        assert jumps.max() <= 2.2e-7 * higher * 1.5 + 1e-9


def test_batches_have_the_shape_of_s(path_case):
    *_, path = path_case
    s = np.array([[0.1, 0.2, 0.9], [0.95, 0.3, 0.0]])
    for order in range(4):
        values = path.at(s, order)
        assert values.shape == (2, 3, path.m)
        one_by_one = [[path.at(float(x), order) for x in row] for row in s]
        size = np.abs(values).max() + 1.0
        np.testing.assert_allclose(values, one_by_one, rtol=0, atol=ROUNDING * size)


def test_many_sorted_samples_are_those_in_any_order(path_case, rng):
    """Sorted samples are evaluated in runs, others one by one."""
    *_, path = path_case
    s = np.sort(rng.uniform(0, 1, 3000))
    shuffled = rng.permutation(3000)
    for order in range(4):
        sorted_values, size = path.at(s, order), np.abs(path.at(s, order)).max() + 1.0
        np.testing.assert_allclose(path.at(s[shuffled], order), sorted_values[shuffled], rtol=0, atol=ROUNDING * size)


def test_exact_peaks_are_those_of_dense_samples_and_never_less(path_case):
    *_, path = path_case
    s = np.concatenate([np.linspace(0, 1, 20001), path.pieces])
    for order in (0, 1, 2):
        degree = None if path.degree is None else max(path.degree - order, 0)
        found = extremes(lambda x, order=order: path.at(x, order), path.edges, degree)
        both = np.concatenate([path.at(s, order), path.derivatives(path.pieces, (order,), before=True)[0]])
        size = np.abs(both).max() + 1e-12
        assert np.all(found.highest >= both.max(axis=0) - 1e-10 * size)
        assert np.all(found.lowest <= both.min(axis=0) + 1e-10 * size)
        np.testing.assert_allclose(found.highest, both.max(axis=0), rtol=0, atol=2e-4 * size)
        np.testing.assert_allclose(found.lowest, both.min(axis=0), rtol=0, atol=2e-4 * size)


@pytest.mark.parametrize("s", [-0.1, 1.1, float("nan"), [0.5, 2.0]])
def test_an_s_outside_is_refused(path_case, s):
    *_, path = path_case
    with pytest.raises(ValueError, match="s: expected numbers from 0 to 1"):
        path.at(s)


def test_every_path_says_what_it_is():
    for key, kind in path_types().items():
        assert kind.key == key
        assert kind.title
        assert set(kind.spaces) <= {"joint", "cartesian"}
        assert len({field.key for field in kind.fields}) == len(kind.fields)
        for field in kind.fields:
            assert field.title or field.symbol
            field.checked(field.default)


def test_paths_with_their_own_time_say_whether_they_rest(path_case):
    kind, example, *_ = path_case
    if "duration" in {field.key for field in kind.fields} and not example.options:
        assert kind.rests == (example.rest > 0)
