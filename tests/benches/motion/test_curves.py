"""The laboratory of curves: its numbers against the notes, and its examples."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.interpolate import CubicSpline

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.examples import EXAMPLES, ChooseExample, differences
from armlab.benches.motion.curves.facts import FACTS
from armlab.benches.motion.curves.knots import MOST_KNOTS
from armlab.benches.motion.curves.made import Drawn, free_options, grid, kinds, made, why_not
from armlab.benches.motion.curves.solved import lts_solved, normalised, one_polynomial, pieces, spline_solved
from armlab.benches.motion.curves.state import Curves
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion.law_types import free_law_types
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.peaks import peaks, violations
from armlab.session.fields import Set
from armlab.session.state import State, apply

ROBOT = catalogue()["puma560"]


@pytest.fixture
def state():
    return State.initial(ROBOT)


def curve(knots, path, law="constant", **options):
    return made(tuple(knots), Drawn(0, Chosen.of(kinds(), path, **options), Chosen.of(free_law_types(), law)))


def example(state, key):
    return apply(state, ChooseExample(key))[Curves]


def expect(actual, case, key):
    np.testing.assert_allclose(np.squeeze(actual), case["expected"][key], rtol=0, atol=case["tol"])


# -- the notes -------------------------------------------------------------------------------------------------------


def test_the_cubic_path_with_quintic_timing_is_of_degree_15(truth, state):
    path, timed = truth["C6.0-cubic-path"], truth["C6.0-deg15"]
    law, plain = example(state, "degree_15").made
    cubic = plain.trajectory.path
    expect(cubic.at(path["inputs"]["s"]), path, "q")
    expect(cubic.at(path["inputs"]["s"], 1), path, "dq")
    q, rate, *_ = law.at(np.array(timed["inputs"]["t"], dtype=float))
    expect(law.trajectory.law.at(timed["inputs"]["t"]), timed, "s")
    expect(q, timed, "q")
    expect(rate, timed, "qdot")
    assert law.trajectory.degree == timed["expected"]["degree"]
    assert differences(law)[0].startswith("⟦Notes 6.6 ")
    assert not any("6.6 " in line for line in differences(plain))


def test_the_cubic_with_end_velocities(truth, state):
    case = truth["C6.2.1-cubic-hermite"]
    cubic = next(example(state, "hermite").made)
    found = one_polynomial(cubic)
    np.testing.assert_allclose(found.normalised, [case["expected"][k] for k in "abcd"], rtol=0, atol=case["tol"])
    expect(cubic.at(np.array([1.0]))[0], case, "q_mid")
    t = np.linspace(0.0, 2.0, 9)
    np.testing.assert_allclose(np.polyval(found.in_time, t), cubic.at(t)[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.polyval(found.in_tau, t / 2.0), cubic.at(t)[0], rtol=0, atol=1e-12)
    assert not found.rules.low_zero


def test_from_1_to_4_in_2_seconds(truth, state):
    case = truth["C6.3.5-cubic-example"]
    cubic, quintic = example(state, "one_to_four").made
    values = cubic.at(np.array(case["inputs"]["t"], dtype=float))
    for found, key in zip(values, ("q", "qdot", "qddot"), strict=False):
        expect(found, case, key)
    assert cubic.trajectory.continuity_from_rest == 1
    assert quintic.trajectory.continuity_from_rest == 2
    np.testing.assert_allclose(cubic.at(np.array([0.0]))[2], 4.5, rtol=0, atol=1e-12)
    np.testing.assert_allclose(quintic.at(np.array([0.0]))[2], 0.0, rtol=0, atol=1e-12)
    assert cubic.bending == pytest.approx(13.5, abs=1e-12)  # the integral of (4.5 - 4.5 t)^2 over 2 s


@pytest.mark.parametrize("name", ["C6.2.1-rest-cubic", "C6.2.1-rest-quintic"])
def test_rest_to_rest_with_its_peaks(truth, name):
    case = {"C6.2.1-rest-cubic": truth["C6.2.1-rest-cubic"], "C6.2.1-rest-quintic": truth["C6.2.1-rest-quintic"]}[name]
    expected = case["expected"]
    coefficients = expected.get("coeffs") or expected["coeffs_high_to_low"]
    found = curve(((0.0, 0.0), (1.0, 1.0)), "cubic" if len(coefficients) == 4 else "quintic")
    polynomial = one_polynomial(found)
    np.testing.assert_allclose(polynomial.normalised, coefficients, rtol=0, atol=1e-12)
    assert polynomial.rules.kept
    assert found.peaks[0] == pytest.approx(expected["v_max"], abs=1e-12)
    assert found.peaks[1] == pytest.approx(expected["a_max"], abs=1e-11)
    if "tau" in case["inputs"]:
        expect(found.at(np.array(case["inputs"]["tau"]))[0], case, "q")


def test_the_normalised_polynomials_keep_the_rules(truth, state):
    assert list(normalised(7).coefficients) == truth["C6.2.1-rest-7th"]["expected"]["coeffs_high_to_low"]
    for degree in (3, 5, 7, 9):
        found = normalised(apply(state, Set(Curves, "degree", degree))[Curves].degree)
        assert found.rules.kept
        drawn = curve(((0.0, 0.0), (1.0, 1.0)), "polynomial", degree=degree)
        np.testing.assert_allclose(one_polynomial(drawn).normalised, found.coefficients, rtol=0, atol=1e-9)
        assert drawn.peaks[0] == pytest.approx(found.peak_speed, abs=1e-12)


def test_the_harmonic_course(truth, state):
    case = truth["C6.2.1-cosine"]
    harmonic = next(example(state, "courses").made)
    for found, key in zip(
        harmonic.at(np.array(case["inputs"]["t"], dtype=float)), ("q", "qdot", "qddot"), strict=False
    ):
        expect(found, case, key)


def test_the_quintic_with_six_conditions(truth, state):
    case = truth["C6.2.1-quintic-6bc"]
    (quintic,) = example(state, "quintic").made
    expect(quintic.at(3.0 * np.array(case["inputs"]["tau"]))[0], case, "q")
    expect(one_polynomial(quintic).in_tau[::-1], case, "coeffs_low_to_high")


def test_lift_off_travel_set_down(truth, state):
    case = truth["C6.2.1-LTS-434"]
    lts, spline = example(state, "lts").made
    table = pieces(lts)
    np.testing.assert_allclose(table.edges, case["inputs"]["t"], rtol=0, atol=1e-12)
    for row, key in zip(table.coefficients, ("qL", "qT", "qS"), strict=True):
        expected = case["expected"][key]
        np.testing.assert_allclose(row[: len(expected)], expected, rtol=0, atol=case["tol"])
    solved = lts_solved(lts.trajectory.path)
    assert solved.matrix.shape == (14, 14)
    assert len(solved.names) == len(solved.right) == 14
    found = np.linalg.solve(solved.matrix, solved.right)
    expected = [*case["expected"]["qL"], *case["expected"]["qT"], *case["expected"]["qS"]]
    np.testing.assert_allclose(found, expected, rtol=0, atol=case["tol"])
    assert lts_solved(spline.trajectory.path) is None
    assert lts.trajectory.continuity_from_rest == 2
    assert spline.trajectory.continuity_from_rest == 1


def test_parabolic_blends(truth, state):
    case = truth["C6.2.1-lin-parab-blend"]
    blends = next(example(state, "blends").made)
    q, rate, bend, _ = blends.at(np.array([1.0, 3.0, 2.0, 1.8, 2.2]))
    expect(rate[:2], case, "v")
    expect(bend[2], case, "acc")
    expect(q[2], case, "q_blend_mid")
    np.testing.assert_allclose(q[[3, 2, 4]], list(case["expected"]["q_at"].values()), rtol=0, atol=case["tol"])
    # The knot is passed at a distance of the change of velocity times an eighth of the blend time.
    assert blends.missed() == pytest.approx(0.75 * 0.4 / 8.0, abs=1e-12)


def test_virtual_knots(truth, state):
    case = truth["C6.2.2-spline-virtual-knots"]
    both = list(example(state, "ends").made)[2]
    solved = spline_solved(both.trajectory.path)
    expect(solved.times, case, "knots_t")
    expect(pieces(both).coefficients, case, "coeffs")
    assert [solved.positions[k - 1] for k in solved.virtual] == pytest.approx(
        [case["expected"]["q_ta"], case["expected"]["q_tb"]], abs=case["tol"]
    )
    assert solved.unknowns == sum(count for count, _ in solved.conditions) == case["expected"]["n_equations"]


def test_the_spline_shows_the_system_it_solves(state):
    """The knots of the erratum of 6.95, with uneven intervals; SciPy is the judge."""
    t = np.array([0.0, 0.5, 1.7, 2.1, 4.0])
    q = np.array([0.0, 1.0, 0.5, 2.0, 1.0])
    for ends, kind in (("clamped", "clamped"), ("natural", "natural")):
        spline = curve(zip(t.tolist(), q.tolist(), strict=True), "spline", ends=ends)
        solved = spline_solved(spline.trajectory.path)
        judge = CubicSpline(t, q, bc_type=kind)
        np.testing.assert_allclose(solved.velocities, judge(t, 1), rtol=0, atol=1e-12)
        inner = solved.velocities[solved.first - 1 :][: len(solved.right)]
        np.testing.assert_allclose(solved.matrix @ inner, solved.right, rtol=0, atol=1e-12)
        np.testing.assert_allclose(pieces(spline).coefficients, judge.c[::-1].T, rtol=0, atol=1e-11)
        assert solved.unknowns == sum(count for count, _ in solved.conditions) == 16
    lines = " ".join(differences(spline))
    assert "6.91" in lines
    assert "6.95" in lines


def test_the_polynomial_wanders_and_the_spline_bends_least(state):
    polynomial, spline = example(state, "wandering").made
    t = np.linspace(0.0, 10.0, 20001)
    q = polynomial.at(t)[0]
    assert polynomial.overshoot == pytest.approx(q.max() - 1.0, abs=1e-6)
    assert polynomial.overshoot > 0.9
    assert spline.overshoot == 0.0
    for each in (polynomial, spline):
        assert each.bending == pytest.approx(trapezoid(each.at(t)[2] ** 2, t), rel=1e-5)
    clamped = curve(polynomial.knots, "spline")
    assert spline.bending < clamped.bending < polynomial.bending


# -- examples and kinds ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", EXAMPLES)
def test_every_example_is_drawn_through_its_knots_and_comes_back_from_a_file(key, state):
    part = example(state, key)
    assert part.example == key
    assert len(list(part.made)) == len(part.curves)
    for each in part.made:
        if each.drawn.path.key != "blends" and each.drawn.law.key == "constant":
            assert each.missed() < 1e-9
    again = Curves.from_json(json.loads(json.dumps(part.to_json())), ROBOT)
    assert again == part
    assert EXAMPLES[key].says.endswith(".")


def test_the_lab_opens_with_an_example(state):
    opened = state[Curves]
    put = example(apply(state, ChooseExample("lts")), opened.example)
    assert (put.knots, put.curves) == (opened.knots, opened.curves)


def test_every_kind_draws_or_says_why_it_takes_no_such_knots(rng):
    for count in (2, 3, 4, 5, 11, MOST_KNOTS):
        t = np.cumsum(rng.uniform(0.2, 1.0, count))
        knots = tuple(zip(t.tolist(), rng.normal(size=count).tolist(), strict=True))
        for key, kind in kinds().items():
            drawn = Drawn(0, Chosen(key))
            if why := why_not(kind, knots):
                assert "knot" in why
                with pytest.raises(InputError):
                    made(knots, drawn)
            else:
                found = made(knots, drawn)
                values = found.at(grid(knots))
                assert all(np.isfinite(each).all() for each in values)
                np.testing.assert_allclose(values[0][[0, -1]], [knots[0][1], knots[-1][1]], rtol=0, atol=1e-9)
    assert why_not(kinds()["cubic"], ((0, 1), (1, 2), (2, 3))) == "exactly 2 knots"
    assert why_not(kinds()["cubic"], ((0, 1), (1, 1))) == "knot 2 does not move"


@pytest.mark.parametrize("law", free_law_types())
def test_every_law_runs_through_a_path(law):
    found = curve(((1.0, 0.0), (3.0, 1.0)), "cubic", law)
    t = np.linspace(1.0, 3.0, 2001)
    q, rate, *_ = found.at(t)
    np.testing.assert_allclose(q[[0, -1]], [0.0, 1.0], rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.gradient(q, t)[1:-1], rate[1:-1], rtol=0, atol=0.01)


def test_options_that_the_knots_give_are_not_asked_for():
    for kind in kinds().values():
        assert not {"times", "duration", "spacing"} & {field.key for field in free_options(kind)}


def test_exceeded_limits_are_told_with_their_times():
    quintic = curve(((1.0, 1.0), (3.0, 4.0)), "quintic")
    found = quintic.beyond(2.5, None)
    assert [v.quantity for v in found] == ["velocity"]
    rate = quintic.at(np.array([1.0 + found[0].start, 1.0 + found[0].end]))[1]
    np.testing.assert_allclose(rate, 2.5, rtol=0, atol=1e-6)
    assert quintic.beyond(3.0, 5.0) == []


@pytest.mark.parametrize("law", ["cosine", "septic", "double_s"])
@pytest.mark.parametrize("path", ["spline", "blends", "interpolating"])
def test_what_is_measured_is_what_the_core_measures(path, law, rng):
    knots = tuple((float(k), q) for k, q in enumerate(rng.normal(size=6).tolist()))
    found = curve(knots, path, law)
    for order in (1, 2, 3):
        assert found.peaks[order - 1] == pytest.approx(float(peaks(found.trajectory, order).peak[0]), rel=1e-9)
    expected = violations(found.trajectory, Limits(1.0, 2.0), from_rest=False)
    mine = sorted(found.beyond(1.0, 2.0), key=lambda violation: (violation.start, violation.quantity))
    assert [v.quantity for v in mine] == [v.quantity for v in expected]
    np.testing.assert_allclose([v.start for v in mine], [v.start for v in expected], rtol=0, atol=1e-6)


def test_long_and_short_intervals_are_measured_in_few_pieces():
    """Derivatives of a short interval late in a long motion carry rounding that halving would chase for ever."""
    knots = ((0.1, 0.0), (25.1, 0.1), (100.1, 0.5), (101.1, 0.3), (102.1, -1.1), (102.2, 2.8), (102.25, 0.9))
    found = curve(knots, "spline", "cosine")
    assert all(len(each.edges) <= 48 for each in found.series)
    t = np.linspace(0.1, 102.25, 400_001)
    for order in (1, 2):
        assert found.peaks[order - 1] == pytest.approx(np.abs(found.at(t)[order]).max(), rel=1e-3)


def test_a_velocity_that_jumps_at_a_knot_exceeds_a_limit_of_acceleration():
    found = curve(((0.0, 0.0), (1.0, 1.0), (3.0, 0.0)), "polyline", "constant")
    (only,) = found.beyond(5.0, 5.0)
    assert (only.quantity, only.start, only.end) == ("acceleration", pytest.approx(1.5), pytest.approx(1.5))
    assert found.beyond(5.0, None) == []


def test_a_jump_makes_the_peaks_above_it_infinite(state):
    knots = ((0.0, 0.0), (1.0, 1.0), (3.0, 0.0))
    polyline, spline = curve(knots, "polyline"), curve(knots, "spline")
    assert [polyline.largest(order) for order in (2, 3)] == [math.inf, math.inf]
    assert [spline.largest(order) for order in (1, 2, 3)] == list(spline.peaks)
    shown = state.replace(replace(state[Curves], knots=knots, curves=(polyline.drawn,)))
    values = {name: fact.now(shown).value for name, fact in FACTS.facts.items()}
    assert (values["peak_acceleration"], values["peak_jerk"], values["bending"]) == (math.inf, math.inf, math.inf)
    assert values["peak_velocity"] == polyline.peaks[0]
