"""The bench of timing laws: the numbers of the notes through its state, scaling, bounds, limits, words."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.commands import (
    AsFastAsAllowed,
    ChooseLaw,
    LowerSpeed,
    SetLawOption,
    SetQuantity,
    Stretch,
    StretchOptimally,
    TakeBounds,
    optimal,
)
from armlab.benches.motion.laws.examples import ChooseLawExample
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import Entry, Timing, excesses, law_of, phases
from armlab.benches.motion.laws.words import (
    bounds_text,
    corrections,
    excess_text,
    factor,
    gain,
    joint_rows,
    optimal_text,
    phases_text,
    stretch_rows,
)
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.scaling import optimal_scaling
from armlab.session.fields import Set
from armlab.session.state import apply
from support.laws import after, bench, example

# -- the numbers of the notes ------------------------------------------------------------------------------------------


def test_the_profile_of_1_41_comes_back_to_rest_where_it_began():
    part = example("plus_minus_one")
    (law,) = part.laws
    assert law.duration == 8.0
    assert float(law.at(8.0, 1)) == pytest.approx(0.0, abs=1e-14)
    assert float(law.at(8.0)) == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose(law.at([2.0, 4.0, 6.0], 1), 0.0, rtol=0, atol=1e-14)
    assert gain(law) == 0.0
    assert factor(law, law.peak_speed, 1) is None
    said = corrections(part.entries[0], part.timing, phases(law))
    assert said[0].startswith("⟦Notes 1.41 has 3/8, 5/8, 7/8 for 3, 5, 7: corrected.")
    # Another table is not the one of 1.41.
    other = bench(ChooseLawExample("plus_minus_one"), SetLawOption(0, "rows", [[0, 1, 1]]))
    assert corrections(other.entries[0], other.timing, None) == ()


def test_rest_to_rest_on_a_line(truth):
    case = truth["C1.3-line-rest-to-rest"]
    part = bench(ChooseLaw(0, "quintic"), SetQuantity("duration", case["inputs"]["T"]))
    s, speed, acceleration = (float(part.laws[0].at(case["inputs"]["t"], order)) for order in range(3))
    expected = case["expected"]
    line = np.array(case["inputs"]["pb"]) - np.array(case["inputs"]["pa"])
    assert s == pytest.approx(expected["s"], abs=case["tol"])
    np.testing.assert_allclose(speed * line, expected["pdot"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(acceleration * line, expected["pddot"], rtol=0, atol=case["tol"])
    assert gain(part.laws[0]) == 0.0


@pytest.mark.parametrize("name", ["a", "c", "tri"])
def test_trapezoid_and_triangle(truth, name):
    case = truth[f"C6.3.1-trapezoid-{name}"]
    given, expected, tol = case["inputs"], case["expected"], case["tol"]
    part = bench(
        ChooseLaw(0, "trapezoidal"),
        SetQuantity("distance", given["L"]),
        SetQuantity("speed", given["v_max"]),
        SetQuantity("acceleration", given["a_max"]),
        AsFastAsAllowed(True),
    )
    law, found = part.laws[0], phases(part.laws[0])
    assert (found.up, found.coast) == pytest.approx((expected["T_s"], expected["coast"]), abs=tol)
    assert found.peak == pytest.approx(expected["v_peak"], abs=tol)
    assert law.duration == pytest.approx(expected["T"], abs=tol)
    np.testing.assert_allclose(law.at(expected["t"]), expected["sigma"], rtol=0, atol=tol)
    assert law.distance == pytest.approx(expected["sigma_T"], abs=tol)
    assert found.triangle == (expected["coast"] == 0.0)
    assert excesses(part.entries[0], part.timing) == ()
    assert optimal(part).k == pytest.approx(1.0, abs=1e-12)


def test_trapezoid_and_triangle_are_told_apart_in_words():
    assert phases_text(example("bang_coast_bang"), 0) == (
        "Trapezoid: L = 2 > V²/A = 1, so T_s = V/A = 1 s, T = (L A + V²)/(A V) = 3 s, constant speed for 1 s."
    )
    part = example("triangle")
    assert phases_text(part, 0) == (
        "Triangle: L = 0.5 < V²/A = 1, so no constant speed: peak √(L A) = 0.7071 1/s, T_s = √(L/A) = 0.7071 s, "
        "T = 2 T_s = 1.414 s."
    )
    assert corrections(part.entries[0], part.timing, phases(part.laws[0]))[0].startswith("⟦Notes 6.112")
    just = bench(ChooseLawExample("triangle"), SetQuantity("distance", 1.0))
    assert "L = 1 = V²/A = 1" in phases_text(just, 0)
    without = bench(ChooseLawExample("triangle"), SetQuantity("speed", None))
    assert phases_text(without, 0).startswith("Triangle: there is no limit V")
    ends = example("end_speeds")
    assert (
        phases_text(ends, 0) == "Trapezoid of speed: speeds up for 0.35 s, moves at 1 1/s for 1.112 s, slows "
        "down for 0.2 s."
    )
    assert phases_text(ends, 1) == ""
    assert phases(example("plus_minus_one").laws[0]) is None


def test_cosine(truth):
    case = truth["C6.2.1-cosine"]
    part = bench(ChooseLawExample("cosine"), SetQuantity("duration", case["inputs"]["T"]))
    for order, key in enumerate(("q", "qdot", "qddot")):
        found = part.laws[0].at(case["inputs"]["t"], order)
        np.testing.assert_allclose(found, case["expected"][key], rtol=0, atol=case["tol"])
    assert "6.60" in corrections(part.entries[0], part.timing, None)[0]


@pytest.mark.parametrize(("name", "key"), [("C6.3.4-k", "slower"), ("C6.3.4-k-speedup", "faster")])
def test_the_optimal_time_scaling_both_ways(truth, name, key):
    case = truth[name]
    given, expected, tol = case["inputs"], case["expected"], case["tol"]
    plain = after(ChooseLawExample(key), Stretch(1.0))
    part = plain[Laws]
    assert (part.timing.duration, part.timing.distance) == (given["T"], abs(given["dq"][0]))
    law = part.laws[0]
    peaks = np.abs(given["dq"]) / part.timing.distance
    np.testing.assert_allclose(peaks * law.peak_speed, expected["v_peak"], rtol=0, atol=10 * tol)
    np.testing.assert_allclose(peaks * law.peak_acceleration, expected["a_peak"], rtol=0, atol=100 * tol)
    whole = optimal_scaling(
        Limits(given["v_max"], given["a_max"]), peaks * law.peak_speed, peaks * law.peak_acceleration
    )
    assert whole.k == pytest.approx(expected["k"], abs=tol)
    # The joint with the longer way decides, and it is the law of the bench.
    scaled = after(StretchOptimally(), state=plain)[Laws]
    assert scaled.k == pytest.approx(expected["k"], abs=tol)
    assert scaled.stretched.duration == pytest.approx(expected["T_s"], abs=10 * tol)
    assert example(key).k == pytest.approx(expected["k"], abs=tol)
    assert ("slower" in optimal_text(part)) == (expected["k"] > 1.0)
    assert "V is just reached" in optimal_text(part)


def test_time_scaling_divides_accelerations_by_k_squared(truth):
    """sin(1.3 t) is a cosine law of T = pi/1.3 and L = 2, a quarter of a period later and 1 lower."""
    case = truth["C6.3.4-time-scale"]
    given, expected, tol = case["inputs"], case["expected"], case["tol"]
    k, quarter = given["k"], 0.5 * math.pi / 1.3
    part = bench(
        ChooseLaw(0, "cosine"),
        SetQuantity("duration", math.pi / 1.3),
        SetQuantity("distance", 2.0),
        Stretch(k),
    )
    r = k * quarter + given["r"]
    q, speed, acceleration = (float(part.stretched.at(r, order)) for order in range(3))
    assert q - 1.0 == pytest.approx(expected["q"], abs=tol)
    assert speed == pytest.approx(expected["qd"], abs=tol)
    assert acceleration == pytest.approx(expected["qdd"], abs=tol)
    # What 6.160 prints is another number.
    assert speed / k == pytest.approx(case["printed_value_if_wrong"]["qdd_printed"], abs=tol)


def test_time_scaling_of_any_law(rng):
    for key in free_law_types():
        entry = Entry(Chosen(key))
        law = law_of(entry, Timing(duration=float(rng.uniform(0.5, 5.0)), distance=float(rng.uniform(0.2, 3.0))))
        k = float(rng.uniform(0.2, 4.0))
        slow, t = law.stretched(k), rng.uniform(0.0, law.duration, 20)
        for order in range(4):
            np.testing.assert_allclose(slow.at(k * t, order) * k**order, law.at(t, order), rtol=1e-9, atol=1e-9)


def test_the_chosen_law_is_the_one_that_is_stretched():
    part = bench(Set(Laws, "scaled", 1), Stretch(3.0))
    second, after_ = part.laws[1], part.stretched
    assert after_.peak_acceleration == pytest.approx(second.peak_acceleration / 9.0)
    assert part.laws[0].peak_acceleration != pytest.approx(second.peak_acceleration)
    assert stretch_rows(part)[2][2] == second.peak_acceleration


def test_the_optimal_scaling_keeps_the_limit_of_jerk_of_a_law_that_is_to_move_at_its_ends():
    double_s = Set(Laws, "scaled", 1)
    state = after(ChooseLawExample("end_speeds"), SetQuantity("jerk", 2.0), AsFastAsAllowed(False), double_s)
    assert "J is just reached" in optimal_text(state[Laws])
    assert apply(state, StretchOptimally())[Laws].stretched.peak_jerk == pytest.approx(2.0)


def test_before_and_after_are_told_with_their_powers_of_k():
    rows = stretch_rows(bench(ChooseLaw(0, "quintic"), Stretch(2.0)))
    assert [after / before for _, _, before, after, _ in rows] == pytest.approx([2.0, 1 / 2, 1 / 4, 1 / 8])
    assert [power for *_, power in rows] == ["k", "1/k", "1/k²", "1/k³"]
    plain = stretch_rows(bench(ChooseLaw(0, "quintic")))
    assert all(before == after for _, _, before, after, _ in plain)


@pytest.mark.parametrize(
    ("rows", "first", "said"),
    [
        (
            [[0, 1, 1], [1, 3, 0], [3, 4, -1]],
            0.0,
            "Trapezoid of speed: speeds up for 1 s, moves at 1 1/s for 2 s, ",
        ),
        ([[0, 1, 1], [1, 2, 0]], 0.5, "Trapezoid of speed: speeds up for 1 s, moves at 1.5 1/s for 1 s."),
        ([[0, 1, 1], [1, 3, 0], [3, 5, -2]], 0.0, ""),
        ([[0, 1, 1], [1, 2, 0]], -2.0, ""),
    ],
)
def test_a_table_has_phases_only_if_it_never_turns_back(rows, first, said):
    entry = Entry(Chosen.of(free_law_types(), "table", rows=rows, sdot_first=first), True)
    text = phases_text(replace(Laws(), entries=(entry,)), 0)
    assert text.startswith(said)
    assert bool(text) == bool(said)


def test_the_bound_of_speed_of_the_example_is_one_half():
    part = example("bound")
    first, second = joint_rows(part.bounded)
    assert (first.M_v, second.M_v) == pytest.approx((4.0, 4.0), abs=1e-12)
    assert (first.M_v_at, second.M_v_at) == pytest.approx((1.0, 1.0), abs=1e-12)
    assert pytest.approx((0.75, 0.5), abs=1e-12) == (first.V, second.V)
    assert (first.first_speed, second.first_speed) == (False, True)
    assert pytest.approx(0.5, abs=1e-12) == part.bounded.found.V
    kind, said = bounds_text(part.bounded, part.bounded.found)
    assert kind == "ok"
    assert said.startswith("V = 0.5 1/s, joint 2 decides.")
    np.testing.assert_allclose([law.peak_speed for law in part.laws], 0.5, rtol=0, atol=1e-12)


def test_the_bound_of_acceleration_that_is_negative(truth):
    case = truth["C6.1.1-accel-bound-infeasible"]
    state = after(ChooseLawExample("no_bound"))
    bounded = state[Laws].bounded
    assert (bounded.speed, list(bounded.a_max)) == (case["inputs"]["V"], case["inputs"]["a_max"])
    np.testing.assert_allclose(
        [row.A for row in joint_rows(bounded)], case["expected"]["bounds"], rtol=0, atol=case["tol"]
    )
    assert [row.first_acceleration for row in joint_rows(bounded)] == [False, True]
    assert bounded.found.V_bend == pytest.approx(case["expected"]["V_feasible_max"], abs=case["tol"])
    kind, said = bounds_text(bounded, bounded.found)
    assert kind == "no"
    assert "Lower |ṡ| below 0.4082 1/s first" in said
    with pytest.raises(InputError, match="lower V first"):
        apply(state, TakeBounds())
    lowered = apply(state, LowerSpeed())
    found = lowered[Laws].bounded.found
    assert found.possible
    assert case["expected"]["V_feasible_max"] > found.V
    taken = apply(lowered, TakeBounds())[Laws].timing
    assert (taken.speed, taken.acceleration, taken.fastest) == (found.V, found.A, True)


# -- limits ------------------------------------------------------------------------------------------------------------


def test_limits_that_are_not_kept_are_said_with_their_times():
    part = bench(ChooseLaw(0, "quintic"), SetQuantity("duration", 1.0), SetQuantity("acceleration", 4.0))
    speed, acceleration = excesses(part.entries[0], part.timing)
    assert (speed.order, acceleration.order) == (1, 2)
    assert speed.peak == pytest.approx(1.875)
    ((low, high),) = speed.spans
    np.testing.assert_allclose(part.laws[0].at([low, high], 1), 1.0, rtol=0, atol=1e-6)
    assert len(acceleration.spans) == 2
    assert excess_text(speed).startswith("max|ṡ| = 1.875 1/s is above V = 1 1/s, from 0.")


def test_jumps_break_the_limit_of_the_derivative_above():
    part = bench(ChooseLaw(0, "constant"), ChooseLaw(1, "trapezoidal"), SetQuantity("jerk", 5.0), AsFastAsAllowed(True))
    constant, trapezoid = (excesses(entry, part.timing) for entry in part.entries)
    assert [(each.order, each.peak) for each in constant] == [(2, math.inf), (3, math.inf)]
    assert [(each.order, each.peak) for each in trapezoid] == [(3, math.inf)]
    assert excess_text(trapezoid[0]) == "s̈ jumps, so jerk is infinite there: J = 5 1/s³ is not kept."
    assert part.laws[1].remarks == ()


def test_a_speed_at_an_end_that_is_meant_is_no_jump():
    part = example("end_speeds")
    assert [each.order for each in excesses(part.entries[0], part.timing)] == [3]
    assert excesses(part.entries[1], part.timing) == ()
    assert [gain(law) for law in part.laws] == pytest.approx([0.3, 0.3])


def test_as_fast_as_allowed_meets_a_limit_with_every_law():
    state = after(SetQuantity("jerk", 8.0), AsFastAsAllowed(True))
    for key in free_law_types():
        part = apply(state, ChooseLaw(0, key) if key != "cubic" else ChooseLaw(1, "cubic"))[Laws]
        entry = next(each for each in part.entries if each.chosen.key == key)
        law = law_of(entry, part.timing)
        over = [each for each in excesses(entry, part.timing) if math.isfinite(each.peak)]
        assert over == []
        smooth = law.continuity_from_rest >= 2
        quotients = [law.peak_speed / 1.0, law.peak_acceleration / 2.0, law.peak_jerk / 8.0 if smooth else 0.0]
        assert max(quotients) == pytest.approx(1.0, abs=1e-9), key


def test_peak_factors_do_not_depend_on_duration_and_distance():
    for duration_, distance in ((1.0, 1.0), (3.0, 0.4)):
        part = bench(
            ChooseLawExample("same_time"), SetQuantity("duration", duration_), SetQuantity("distance", distance)
        )
        speeds = [factor(law, law.peak_speed, 1) for law in part.laws]
        accelerations = [factor(law, law.peak_acceleration, 2) for law in part.laws]
        assert speeds == pytest.approx([2.0, 1.5, 1.875])
        assert accelerations == pytest.approx([4.0, 6.0, 10.0 / math.sqrt(3.0)])
