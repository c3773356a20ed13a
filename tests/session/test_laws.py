"""The bench of timing laws: the numbers of the notes through its state, scaling, bounds, words, and what is refused."""

import json
import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import law_types
from armlab.kin.motion.scaling import optimal_scaling
from armlab.kin.timing.table import PLUS_MINUS_ONE
from armlab.session.chosen import Chosen
from armlab.session.clips.laws import CLIP, present_time
from armlab.session.laws_bounds import Bounded, joint_paths
from armlab.session.laws_commands import (
    AddLaw,
    AsFastAsAllowed,
    ChooseBoundPath,
    ChooseLaw,
    LeaveAsTyped,
    LowerSpeed,
    RemoveLaw,
    SetBound,
    SetBoundOption,
    SetLawOption,
    SetQuantity,
    ShowBounds,
    Stretch,
    StretchLaw,
    StretchOptimally,
    TakeBounds,
    optimal,
)
from armlab.session.laws_examples import EXAMPLES, ChooseLawExample
from armlab.session.laws_timing import Entry, Timing, excesses, law_of, phases
from armlab.session.laws_words import (
    bounds_text,
    corrections,
    excess_text,
    factor,
    gain,
    joint_rows,
    optimal_text,
    phases_text,
    remarks,
    stretch_rows,
)
from armlab.session.parts.laws import Laws
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import State, apply


def opened():
    return State.initial(catalogue()["planar_2r"])


def after(*commands, state=None):
    state = state or opened()
    for command in commands:
        state = apply(state, command)
    return state


def bench(*commands):
    return after(*commands)[Laws]


def example(key):
    return bench(ChooseLawExample(key))


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
    assert said[0].startswith("Notes 1.41 has 3/8, 5/8, 7/8 for 3, 5, 7: corrected.")
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
    assert corrections(part.entries[0], part.timing, phases(part.laws[0]))[0].startswith("Notes 6.112")
    just = bench(ChooseLawExample("triangle"), SetQuantity("distance", 1.0))
    assert "L = 1 = V²/A = 1" in phases_text(just, 0)
    without = bench(ChooseLawExample("triangle"), SetQuantity("speed", None))
    assert phases_text(without, 0).startswith("Triangle: there is no V to reach")
    ends = example("end_speeds")
    assert (
        phases_text(ends, 0) == "Trapezoid of speed: speeds up for 0.35 s, goes on at 1 1/s for 1.112 s, slows "
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
    whole = optimal_scaling(peaks * law.peak_speed, peaks * law.peak_acceleration, given["v_max"], given["a_max"])
    assert whole.k == pytest.approx(expected["k"], abs=tol)
    # The joint with the longer way decides, and it is the law of the bench.
    scaled = after(StretchOptimally(), state=plain)[Laws]
    assert scaled.k == pytest.approx(expected["k"], abs=tol)
    assert scaled.stretched.duration == pytest.approx(expected["T_s"], abs=10 * tol)
    assert example(key).k == pytest.approx(expected["k"], abs=tol)
    assert ("slower" in optimal_text(part)) == (expected["k"] > 1.0)
    assert "V is met exactly" in optimal_text(part)


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
    for key in law_types():
        entry = Entry(Chosen(key))
        law = law_of(entry, Timing(duration=float(rng.uniform(0.5, 5.0)), distance=float(rng.uniform(0.2, 3.0))))
        k = float(rng.uniform(0.2, 4.0))
        slow, t = law.stretched(k), rng.uniform(0.0, law.duration, 20)
        for order in range(4):
            np.testing.assert_allclose(slow.at(k * t, order) * k**order, law.at(t, order), rtol=1e-9, atol=1e-9)


def test_before_and_after_are_told_with_their_powers_of_k():
    rows = stretch_rows(bench(ChooseLaw(0, "quintic"), Stretch(2.0)))
    assert [after / before for _, _, before, after, _ in rows] == pytest.approx([2.0, 1 / 2, 1 / 4, 1 / 8])
    assert [power for *_, power in rows] == ["k", "1/k", "1/k²", "1/k³"]
    plain = stretch_rows(bench(ChooseLaw(0, "quintic")))
    assert all(before == after for _, _, before, after, _ in plain)


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
    assert remarks(part, 1) == ()
    assert part.laws[1].remarks != ()


def test_a_speed_at_an_end_that_is_meant_is_no_jump():
    part = example("end_speeds")
    assert [each.order for each in excesses(part.entries[0], part.timing)] == [3]
    assert excesses(part.entries[1], part.timing) == ()
    assert [gain(law) for law in part.laws] == pytest.approx([0.3, 0.3])


def test_as_fast_as_allowed_meets_a_limit_with_every_law():
    state = after(SetQuantity("jerk", 8.0), AsFastAsAllowed(True))
    for key in law_types():
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


# -- the state ---------------------------------------------------------------------------------------------------------


def test_laws_are_added_chosen_and_taken_away():
    state = after(AddLaw())
    part = state[Laws]
    assert [entry.colour for entry in part.entries] == [0, 1, 2]
    assert len({entry.chosen.key for entry in part.entries}) == 3
    with pytest.raises(InputError, match="at most 3 laws"):
        apply(state, AddLaw())
    part = after(StretchLaw(2), RemoveLaw(1), state=state)[Laws]
    assert [entry.colour for entry in part.entries] == [0, 2]
    assert part.scaled == 1
    one = after(StretchLaw(2), RemoveLaw(1), RemoveLaw(0), state=state)
    with pytest.raises(InputError, match="the last law stays"):
        apply(one, RemoveLaw(0))
    assert apply(one, AddLaw())[Laws].entries[1].colour == 0
    assert apply(one, ChooseLaw(0, one[Laws].entries[0].chosen.key)) is one


def test_a_law_that_needs_a_limit_is_not_the_one_that_is_added():
    """Without V, A and J only bang-bang and the like could be as fast as allowed."""
    state = after(SetQuantity("speed", None), AsFastAsAllowed(True), AddLaw())
    assert state[Laws].entries[2].chosen.key not in ("constant", "double_s")


def test_a_table_is_left_as_typed_or_stretched():
    state = after(ChooseLawExample("bang_coast_bang"), LeaveAsTyped(1, False), SetQuantity("speed", 0.5))
    assert state[Laws].laws[1].peak_speed == pytest.approx(0.5)
    typed = apply(state, LeaveAsTyped(1, True))[Laws]
    assert typed.laws[1].duration == 3.0
    assert [each.order for each in excesses(typed.entries[1], typed.timing)] == [1]
    with pytest.raises(InputError, match="it cannot be scaled to end at 1"):
        apply(after(ChooseLawExample("plus_minus_one")), LeaveAsTyped(0, False))


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_examples_are_put_in_place_written_and_read_back(key):
    state = after(OpenClip("laws"), Seek(1.0), ChooseLawExample(key))
    part = state[Laws]
    assert part.example == key
    assert part.bounds_shown == EXAMPLES[key].bounds_shown
    assert state[Timeline].time == 0.0
    read = Laws.from_json(json.loads(json.dumps(part.to_json())), state[RobotPart].robot)
    assert read == part
    assert apply(state, SetQuantity("distance", 7.0))[Laws].example == ""
    assert apply(state, ShowBounds(not part.bounds_shown))[Laws].example == key
    assert apply(state, ChooseRobot("puma560"))[Laws] == part


def test_the_sentences_of_examples_are_true():
    same = example("same_limits")
    assert min(law.duration for law in same.laws) == same.laws[0].duration
    double, trapezoid = example("double_s").laws
    assert double.duration > trapezoid.duration
    assert (double.continuity_from_rest, trapezoid.continuity_from_rest) == (2.0, 1.0)
    jumps = np.diff(np.concatenate([[0.0], trapezoid.at(trapezoid.edges[:-1], 2), [0.0]]))
    assert np.count_nonzero(np.abs(jumps) > 1e-9) == 4
    assert [law.continuity_from_rest for law in example("smoothness").laws] == [1.0, 2.0, 3.0]
    assert [float(law.at(0.0, 3)) == 0.0 for law in example("smoothness").laws] == [False, False, True]
    ends = example("end_speeds")
    for law in ends.laws:
        np.testing.assert_allclose(law.at([0.0, law.duration], 1), [0.3, 0.6], rtol=0, atol=1e-9)
    one, other = example("bang_coast_bang").laws
    t = np.linspace(0.0, 3.0, 50)
    np.testing.assert_allclose(one.at(t), other.at(t), rtol=0, atol=1e-12)
    assert PLUS_MINUS_ONE[-1][1] == 8


def test_the_film_lasts_as_long_as_the_slowest_and_stops_where_formulas_change():
    state = after(ChooseLawExample("bang_coast_bang"), Stretch(2.0), OpenClip("laws"))
    assert duration(state) == pytest.approx(6.0)
    assert CLIP.stops(state) == pytest.approx((1.0, 2.0, 3.0, 4.0))
    stepped = after(Step(True), Step(True), state=state)
    assert present_time(stepped) == pytest.approx(2.0)
    assert present_time(opened()) == 0.0
    assert after(Seek(6.0), Stretch(1.0), state=state)[Timeline].time == pytest.approx(3.0)


# -- bounds ------------------------------------------------------------------------------------------------------------


def test_more_or_fewer_joints_keep_limits_and_drop_the_options_of_the_path():
    part = bench(SetBound("knots", [[0, 0, 0], [1, 2, 3]]))
    assert part.bounded.v_max == (3.0, 2.0, 2.0)
    assert part.bounded.path == Chosen("polynomial")
    one = bench(SetBound("knots", [[0], [1]]), SetBound("a_max", [4.0]))
    assert (one.bounded.v_max, one.bounded.a_max) == ((3.0,), (4.0,))
    assert pytest.approx(3.0) == one.bounded.found.V


@pytest.mark.parametrize("key", list(joint_paths()))
def test_every_path_between_joints_gives_a_bound(key):
    rows = [[float(i), 0.4 * i * i] for i in range(joint_paths()[key].least)]
    # The spline takes any number of knots; from there each kind is chosen.
    state = after(ChooseBoundPath("spline"), SetBound("knots", rows), ChooseBoundPath(key))
    bounded = state[Laws].bounded
    assert bounded.path.key == key
    assert 0.0 < bounded.found.V < math.inf
    assert Bounded.from_json(json.loads(json.dumps(bounded.to_json()))) == bounded


def test_the_bound_holds_on_the_path():
    """|qdot| of the fastest trapezoid within V and A never exceeds the limits of the joints."""
    state = after(SetBound("a_max", [9.0, 8.0]), SetBound("speed", 0.4), TakeBounds(), ChooseLaw(0, "trapezoidal"))
    part = state[Laws]
    path = joint_paths()["polynomial"].path(part.bounded.knots, **part.bounded.path.options)
    law = part.laws[0]
    t = np.linspace(0.0, law.duration, 2000)
    s, speed, acceleration = law.derivatives(t, (0, 1, 2))
    q1, q2 = path.derivatives(np.clip(s, 0.0, 1.0), (1, 2))
    assert np.all(np.abs(q1 * speed[:, None]) <= np.array([3.0, 2.0]) + 1e-9)
    assert np.all(np.abs(q1 * acceleration[:, None] + q2 * speed[:, None] ** 2) <= np.array([9.0, 8.0]) + 1e-9)


# -- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (SetQuantity("duration", 0.0), "duration: expected more than 0, got 0"),
        (SetQuantity("duration", math.nan), "duration: expected finite numbers"),
        (SetQuantity("duration", None), "duration T: expected a positive number, got nothing"),
        (SetQuantity("duration", 1e9), "duration T: expected 0.0001 to 1 000 000 s"),
        (SetQuantity("distance", -1.0), "distance: expected more than 0"),
        (SetQuantity("speed", 0.0), "speed: expected more than 0"),
        (SetQuantity("acceleration", 0.0), "acceleration: expected more than 0"),
        (SetQuantity("jerk", math.inf), "jerk: expected finite numbers"),
        (SetQuantity("mood", 1.0), "unknown quantity 'mood'"),
        (ChooseLaw(0, "sine"), "sine"),
        (ChooseLaw(5, "cubic"), "law: expected 1 to 2"),
        (SetLawOption(0, "ramp", 0.2), "ramp"),
        (LeaveAsTyped(0, True), "cubic"),
        (Stretch(0.0), "k: expected 0.001 to 1000, got 0"),
        (Stretch(math.nan), "k: expected"),
        (StretchLaw(2), "law: expected 1 to 2"),
        (ChooseLawExample("nothing"), "nothing"),
        (SetBound("knots", [[1.0, 2.0]]), "waypoints"),
        (SetBound("knots", [[1.0, 2.0], [1.0, 2.0]]), "waypoint"),
        (SetBound("knots", [[0.0] * 4, [1.0] * 4]), "1 to 3 joints"),
        (SetBound("knots", [[float(i)] for i in range(41)]), "at most 40 rows"),
        (SetBound("knots", [[0.0, math.nan], [1.0, 1.0]]), "knots: expected finite numbers"),
        (SetBound("v_max", [0.0, 1.0]), "v_max: expected more than 0"),
        (SetBound("v_max", [1.0, 1.0, 1.0]), "v_max: expected 2 positive numbers"),
        (SetBound("v_max", None), "v_max: expected limits of speed, a joint each, got nothing"),
        (SetBound("speed", 0.6), "speed: expected more than 0 and at most V = 0.5"),
        (SetBound("mood", 0.6), "unknown field 'mood'"),
        (ChooseBoundPath("helix"), "helix"),
        (SetBoundOption("mood", 1.0), "mood"),
    ],
)
def test_nonsense_is_refused_and_the_field_is_named(command, says):
    with pytest.raises(InputError) as refusal:
        apply(opened(), command)
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("ramp", 0.6, "ramp: expected more than 0 and at most 0.5, got 0.6"),
        ("ramp", 0.0, "ramp: expected more than 0"),
        ("v_start", -1.0, "v_start: expected at least 0"),
        ("v_start", 50.0, "v_start and v_end"),
    ],
)
def test_ramps_and_end_speeds_of_a_trapezoid_are_checked(name, value, says):
    with pytest.raises(InputError) as refusal:
        after(ChooseLaw(0, "trapezoidal"), SetLawOption(0, name, value))
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        ([[0, 1, 1], [2, 3, -1]], "row 2: it must begin at 1 s"),
        ([[0, 1, 1], [0.5, 3, -1]], "row 2: it must begin at 1 s"),
        ([[0, 0, 1]], "row 1: it must end after 0 s"),
        ([[0, 1]], "rows"),
        ([[k, k + 1, 1] for k in range(61)], "rows: expected at most 60, got 61"),
        ([[0, 1, math.nan]], "rows: expected finite numbers"),
        ([[0, 1, 1e300], [1, 2, -1e300]], "Table of accelerations"),
    ],
)
def test_rows_with_gaps_are_refused_by_number(rows, says):
    with pytest.raises(InputError) as refusal:
        after(ChooseLawExample("plus_minus_one"), SetLawOption(0, "rows", rows))
    assert says in str(refusal.value)


def test_limits_a_law_needs_are_asked_for():
    fast = after(AsFastAsAllowed(True))
    with pytest.raises(InputError, match=r"limit of jerk: Double S \(bounded jerk\) needs one"):
        apply(fast, ChooseLaw(0, "double_s"))
    with pytest.raises(InputError, match="at least one of speed, acceleration and jerk"):
        after(SetQuantity("speed", None), SetQuantity("acceleration", None), AsFastAsAllowed(True))
    assert "V, A, J: none is given" in optimal_text(bench(ChooseLawExample("same_time")))
    with pytest.raises(InputError, match="none is given"):
        after(ChooseLawExample("same_time"), StretchOptimally())


@pytest.mark.parametrize(
    "damage",
    [
        {"laws": []},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": True, "colour": 0}]},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": False, "colour": 7}]},
        {"laws": [{"law": {"key": "cubic"}, "as_typed": False, "colour": 0}] * 2},
        {"laws": [{"law": {"key": "trapezoidal", "options": {"ramp": 2.0}}, "as_typed": False, "colour": 0}]},
        {"scaled": 3},
        {"k": -1.0},
        {"k": math.nan},
        {"timing": {**Laws().to_json()["timing"], "duration": 0.0}},
        {"bounds": {**Bounded().to_json(), "v_max": [0.0, 0.0]}},
        {"bounds": {**Bounded().to_json(), "knots": [[0.0], [1.0]]}},
    ],
)
def test_a_damaged_file_is_not_read(damage):
    with pytest.raises(InputError):
        Laws.from_json({**Laws().to_json(), **damage}, catalogue()["planar_2r"])
