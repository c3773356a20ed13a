"""Trapezoids and double S with end speeds, unequal accelerations and short ways; tables."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.timing.table import BANG_COAST_BANG, PLUS_MINUS_ONE, acceleration_law


def feasible(rng, jerk):
    """Return random limits, distance and end speeds that are possible; jerk None for a trapezoid."""
    V, A = rng.uniform(0.2, 3.0), 10 ** rng.uniform(-1, 1)
    v_0, v_1 = rng.uniform(0, V, 2) * (rng.random(2) > 0.3)
    change = abs(v_1 - v_0)
    time = change / A
    if jerk is not None:
        time = change / A + A / jerk if change >= A * A / jerk else 2 * np.sqrt(change / jerk)
    needed = 0.5 * (v_0 + v_1) * time
    return V, A, v_0, v_1, needed * (1 + 1e-9) + 10 ** rng.uniform(-3, 1.5) * (rng.random() > 0.1) + 1e-6


def test_every_trapezoid_keeps_its_limits_and_its_ends(rng):
    for _ in range(200):
        V, A, v_0, v_1, L = feasible(rng, None)
        law = law_type("trapezoidal").within(Limits(V, A), distance=L, sdot_start=v_0, sdot_end=v_1)
        assert law.distance == pytest.approx(L, rel=1e-9)
        np.testing.assert_allclose(law.derivatives(0.0, (1,))[0], v_0, rtol=0, atol=1e-9 * V)
        np.testing.assert_allclose(law.derivatives(law.duration, (1,), before=True)[0], v_1, rtol=0, atol=1e-7 * V)
        assert law.peak_speed <= V * (1 + 1e-9)
        assert law.peak_acceleration <= A * (1 + 1e-9)
        assert law.monotone


def test_every_double_s_keeps_its_limits_and_its_ends(rng):
    for _ in range(200):
        J = 10 ** rng.uniform(-1, 2)
        V, A, v_0, v_1, L = feasible(rng, J)
        law = law_type("double_s").within(Limits(V, A, J), distance=L, sdot_start=v_0, sdot_end=v_1)
        assert law.distance == pytest.approx(L, rel=1e-9)
        end = [float(values) for values in law.derivatives(law.duration, (1, 2), before=True)]
        assert end[0] == pytest.approx(v_1, abs=1e-7 * V)
        assert end[1] == pytest.approx(0.0, abs=1e-6 * A)
        assert law.peak_speed <= V * (1 + 1e-9)
        assert law.peak_acceleration <= A * (1 + 1e-9)
        assert law.peak_jerk <= J * (1 + 1e-9)
        assert law.continuity == 2
        assert law.monotone


def test_a_double_s_with_much_jerk_is_a_trapezoid(rng):
    for _ in range(50):
        V, A, v_0, v_1, L = feasible(rng, None)
        trapezoid = law_type("trapezoidal").within(Limits(V, A), distance=L, sdot_start=v_0, sdot_end=v_1)
        law = law_type("double_s").within(Limits(V, A, 1e9), distance=L * (1 + 1e-6), sdot_start=v_0, sdot_end=v_1)
        assert law.duration == pytest.approx(trapezoid.duration, rel=1e-4, abs=1e-5)


@pytest.mark.parametrize("ends", [{"sdot_start": 1.0}, {"sdot_end": 1.0}])
def test_an_end_at_rest_keeps_no_limit_of_jerk_where_the_other_end_moves(ends):
    """Half a metre from 1 m/s to rest at 1 m/s² or the other way: one ramp, whose acceleration jumps at the rest."""
    law = law_type("trapezoidal").within(Limits(1.0, 1.0), 0.5, **ends)
    assert (law.continuity, law.continuity_from_rest) == (3, 0)
    with pytest.raises(InputError, match=r"limit of jerk: the acceleration of .* jumps, so no time keeps it"):
        law_type("trapezoidal").within(Limits(1.0, 1.0, 5.0), 0.5, **ends)


@pytest.mark.parametrize("much", [10.0**k for k in (13, 14, 17, 20, 60)])
def test_ramps_too_short_to_be_told_from_none_are_jumps(much):
    trapezoid, double_s = law_type("trapezoidal"), law_type("double_s")
    laws = [trapezoid.shaped(Limits(1.0, much)), trapezoid.law(1.0, ramp=1.0 / much)]
    laws += [double_s.shaped(Limits(1.0, 1.0, much)), double_s.law(1.0, ramp=1.0 / much)]
    for law, end in zip(laws, (1.0, 1.0, 2.0, 1.0), strict=True):
        assert (law.distance, law.duration, law.peak_speed) == pytest.approx((1.0, end, 1.0), rel=1e-9)
        assert law.at(0.25 * law.duration) == pytest.approx(0.25 if end == 1.0 else 0.125, rel=1e-9)
    for kind, limits in ((trapezoid, Limits(1.0, much)), (double_s, Limits(1.0, 1.0, much))):
        with pytest.raises(InputError, match=r"limit of \w+: the \w+ of .* jumps, so no time keeps it"):
            kind.within(limits)


def test_the_fastest_trapezoid_is_fastest(rng):
    """No profile of the same kind with a lower peak, and no other ramps within the limits, is faster."""
    for _ in range(12):
        V, A = rng.uniform(0.5, 2.0, 2)
        law = law_type("trapezoidal").within(Limits(V, A))
        for ramp in np.linspace(0.01, 0.5, 25):
            other = law_type("trapezoidal").law(1.0, ramp=ramp)
            k = max(other.peak_speed / V, np.sqrt(other.peak_acceleration / A))
            assert law.duration <= k * (1 + 1e-12)


def test_braking_may_be_softer_than_speeding_up_and_not_harder_than_the_limit():
    law = law_type("trapezoidal").within(Limits(2.0, 4.0), distance=10.0, sddot_down=1.0)
    # Half a second up over 0.5 m, 2 s down over 2 m, 7.5 m at 2 m/s between.
    np.testing.assert_allclose(law.edges, [0.0, 0.5, 4.25, 6.25], rtol=0, atol=1e-12)
    assert law.at(6.0, 2) == -1.0
    with pytest.raises(InputError, match="sddot_down: expected at most the limit of acceleration 4, got 5"):
        law_type("trapezoidal").within(Limits(2.0, 4.0), distance=10.0, sddot_down=5.0)


@pytest.mark.parametrize("law", ["trapezoidal", "double_s"])
def test_a_way_too_short_for_its_end_speeds_is_refused_with_the_least(law):
    limits = Limits(3.0, 1.0, 1e6 if law == "double_s" else np.inf)
    with pytest.raises(InputError, match=r"distance: to get from speed 2 to 0 within the limits takes at least 2"):
        law_type(law).within(limits, distance=1.0, sdot_start=2.0)
    with pytest.raises(InputError, match="sdot_end: expected at most the speed limit 3, got 4"):
        law_type(law).within(limits, distance=100.0, sdot_end=4.0)


@pytest.mark.parametrize("law", ["trapezoidal", "double_s"])
def test_end_speeds_too_large_for_the_time_are_refused(law):
    with pytest.raises(InputError, match="sdot_start and sdot_end"):
        law_type(law).law(10.0, sdot_start=1.0, sdot_end=1.0)


def test_a_table_is_integrated_exactly(rng):
    for _ in range(10):
        ends = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 2.0, 6))])
        rows = np.column_stack([ends[:-1], ends[1:], rng.normal(size=6)])
        law = acceleration_law(rows, 0.3)
        t = np.linspace(0, ends[-1], 200001)
        a = rows[np.searchsorted(ends[1:-1], t, side="right"), 2]
        v = 0.3 + np.concatenate([[0.0], np.cumsum(0.5 * (a[1:] + a[:-1]) * np.diff(t))])
        np.testing.assert_allclose(law.at(t, 1), v, rtol=0, atol=1e-3)
        s = np.concatenate([[0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(t))])
        np.testing.assert_allclose(law.at(t), s, rtol=0, atol=5e-3)


def test_a_table_that_comes_back_cannot_be_scaled_to_a_distance():
    with pytest.raises(InputError, match=r"rows: the table ends at s = 0, so it cannot be scaled to end at 1"):
        law_type("table").law(rows=PLUS_MINUS_ONE)
    assert law_type("table").law(3.0, 2.0, rows=BANG_COAST_BANG).distance == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("rows", "told"),
    [
        ([], "rows: expected rows of three numbers"),
        ([[0, 1]], "rows: expected rows of three numbers"),
        ([[0, 1, float("nan")]], "rows: expected rows of three numbers"),
        ([[0, 1, 1], [1, 1, 2]], "row 2: it must end after 1 s"),
        ([[0, 1, 1], [2, 3, 2]], "row 2: it must begin at 1 s where the row before ends, got 2 s"),
        ([[1, 2, 1]], "row 1: it must begin at 0 s"),
    ],
)
def test_a_wrong_row_is_named(rows, told):
    with pytest.raises(InputError, match=told):
        acceleration_law(rows)
