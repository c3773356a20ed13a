"""The laboratory of curves: its numbers against the notes, its examples, and input that makes no sense."""

import json
import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion.law_types import law_types
from armlab.session.chosen import Chosen
from armlab.session.curves_commands import (
    AddCurve,
    AddKnot,
    ChooseLaw,
    ChoosePath,
    FindFastest,
    RemoveCurve,
    RemoveKnot,
    SetKnot,
    SetKnots,
    SetLimit,
    SetOption,
    SetUnit,
    ShowCurve,
    ShowDegree,
    TakeFastest,
)
from armlab.session.curves_examples import EXAMPLES, ChooseExample, differences
from armlab.session.curves_knots import MOST_KNOTS
from armlab.session.curves_made import Drawn, Made, form, grid, kinds, made, why_not
from armlab.session.curves_solved import lts_solved, normalised, one_polynomial, pieces, spline_solved
from armlab.session.jobs.curves import JOB, wanted, with_fastest
from armlab.session.parts.curves import MOST_CURVES, UNITS, Curves
from armlab.session.state import State, apply

ROBOT = catalogue()["puma560"]


@pytest.fixture
def state():
    return State.initial(ROBOT)


def curve(knots, path, law="constant", **options):
    return made(tuple(knots), Drawn(0, Chosen.of(kinds(), path, **options), Chosen.of(law_types(), law)))


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
    assert differences(law)[0].startswith("Notes 6.6 ")
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
        found = normalised(apply(state, ShowDegree(degree))[Curves].degree)
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
        assert each.bending == pytest.approx(np.trapezoid(each.at(t)[2] ** 2, t), rel=1e-5)
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


@pytest.mark.parametrize("law", law_types())
def test_every_law_runs_through_a_path(law):
    found = curve(((1.0, 0.0), (3.0, 1.0)), "cubic", law)
    t = np.linspace(1.0, 3.0, 2001)
    q, rate, *_ = found.at(t)
    np.testing.assert_allclose(q[[0, -1]], [0.0, 1.0], rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.gradient(q, t)[1:-1], rate[1:-1], rtol=0, atol=0.01)


def test_options_that_the_knots_give_are_not_asked_for():
    for kind in kinds().values():
        assert not {"times", "duration", "spacing"} & {field.key for field in form(kind)}


def test_exceeded_limits_are_told_with_their_times():
    quintic = curve(((1.0, 1.0), (3.0, 4.0)), "quintic")
    found = quintic.beyond(2.5, None)
    assert [v.quantity for v in found] == ["velocity"]
    rate = quintic.at(np.array([1.0 + found[0].start, 1.0 + found[0].end]))[1]
    np.testing.assert_allclose(rate, 2.5, rtol=0, atol=1e-6)
    assert quintic.beyond(3.0, 5.0) == []


# -- what a person does ----------------------------------------------------------------------------------------------


def test_knots_are_added_moved_and_removed(state):
    state = apply(state, SetKnot(1, "q", 1.5))
    assert state[Curves].knots[1] == (1.0, 1.5)
    assert state[Curves].example == ""
    state = apply(state, AddKnot(0))
    assert state[Curves].knots[1] == (0.5, 0.75)
    state = apply(state, AddKnot(len(state[Curves].knots) - 1))
    assert state[Curves].knots[-1] == (4.0, 2.0)
    state = apply(state, RemoveKnot(1))
    assert [t for t, _ in state[Curves].knots] == [0.0, 1.0, 2.0, 3.0, 4.0]
    for unit in UNITS:
        assert apply(state, SetUnit(unit))[Curves].unit == unit


def test_a_curve_that_no_longer_takes_the_knots_stays_and_says_why(state):
    state = apply(state, ChooseExample("hermite"))
    state = apply(state, AddKnot(0))
    outcomes = state[Curves].outcomes
    assert [isinstance(each, InputError) for each in outcomes] == [True, True]
    assert str(outcomes[0]) == "knots: Cubic with end velocities takes exactly 2, got 3"
    state = apply(state, ChoosePath(0, "spline"))
    assert isinstance(state[Curves].outcomes[0], Made)
    state = apply(state, RemoveKnot(1))
    assert all(isinstance(each, Made) for each in state[Curves].outcomes)


def test_curves_are_added_chosen_and_removed(state):
    state = apply(state, RemoveCurve(0))
    assert [each.colour for each in state[Curves].curves] == [1, 2]
    state = apply(state, AddCurve())
    part = state[Curves]
    assert [each.colour for each in part.curves] == [1, 2, 0]
    assert part.selected == 2
    assert part.curves[2].path.key == "interpolating"
    with pytest.raises(InputError, match=f"at most {MOST_CURVES}"):
        apply(state, AddCurve())
    state = apply(state, ShowCurve(0))
    state = apply(apply(state, RemoveCurve(2)), RemoveCurve(1))
    with pytest.raises(InputError, match="at least one"):
        apply(state, RemoveCurve(0))
    state = apply(state, ChooseLaw(0, "quintic"))
    assert state[Curves].curves[0].law.key == "quintic"


def test_options_are_set_and_left_as_they_come(state):
    state = apply(state, SetOption(0, "path", "v_start", [0.4]))
    spline = state[Curves].outcomes[0]
    np.testing.assert_allclose(spline.at(np.array([0.0]))[1], 0.4, rtol=0, atol=1e-12)
    state = apply(state, SetOption(0, "path", "v_start", None))
    assert state[Curves].curves[0].path == Chosen("spline")
    state = apply(apply(state, ChooseLaw(0, "trapezoidal")), SetOption(0, "law", "ramp", 0.25))
    assert state[Curves].curves[0].law.options == {"ramp": 0.25}


# -- the fastest intervals -------------------------------------------------------------------------------------------


def test_the_fastest_intervals_are_faster_and_keep_the_limits(state):
    state = apply(state, ChooseExample("fastest"))
    before = state[Curves]
    assert before.outcomes[0].beyond(before.v_max, before.a_max)
    assert wanted(state, frozenset()) is None
    state = apply(state, FindFastest())
    asked = wanted(state, frozenset())
    assert asked is not None
    (found,) = JOB.run(asked.inputs)
    state = JOB.delivered(state, asked.inputs, found)
    assert wanted(state, frozenset()) is None
    assert found.duration <= found.by_distance
    assert len(found.intervals) == 4
    state = apply(state, TakeFastest())
    part = state[Curves]
    assert part.knots[-1][0] - part.knots[0][0] == pytest.approx(found.duration)
    assert [q for _, q in part.knots] == [q for _, q in before.knots]
    (spline,) = part.made
    assert spline.beyond(part.v_max * (1 + 1e-6), part.a_max * (1 + 1e-6)) == []
    assert max(spline.peaks[0] / part.v_max, spline.peaks[1] / part.a_max) == pytest.approx(1.0, abs=1e-6)


def test_an_answer_to_a_question_that_has_passed_is_let_go(state):
    state = apply(apply(state, ChooseExample("fastest")), FindFastest())
    asked = wanted(state, frozenset()).inputs
    moved = apply(state, SetKnot(1, "q", 0.9))
    assert wanted(moved, frozenset()) is None
    (found,) = JOB.run(asked)
    assert JOB.delivered(moved, asked, found) is moved
    assert with_fastest(moved) is moved


def test_the_fastest_intervals_need_limits_and_knots_that_move(state):
    with pytest.raises(InputError, match="need both v_max and a_max"):
        apply(state, FindFastest())
    with pytest.raises(InputError, match="none have been found"):
        apply(state, TakeFastest())
    state = apply(apply(state, SetLimit("v_max", 1.0)), SetLimit("a_max", 1.0))
    with pytest.raises(InputError, match="knot 2: the same q as knot 1"):
        apply(apply(state, SetKnot(1, "q", 0.0)), FindFastest())
    many = tuple((float(k), float(k % 2)) for k in range(MOST_KNOTS))
    with pytest.raises(InputError, match=f"at most 16, there are {MOST_KNOTS}"):
        apply(apply(state, SetKnots(many)), FindFastest())


def test_limits_at_the_edge_of_what_can_be_typed_are_answered_or_refused(state):
    for v, a in ((1e-9, 1e-9), (1e12, 1e12), (1e-9, 1e12), (1e12, 1e-9)):
        asked = apply(apply(apply(state, SetLimit("v_max", v)), SetLimit("a_max", a)), FindFastest())
        found = with_fastest(asked)
        assert found[Curves].fastest.duration > 0.0
        with pytest.raises(InputError, match=r"knot \d, t: expected at most|shortest would be below"):
            apply(found, TakeFastest())


# -- bad input -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (SetKnot(2, "t", 1.0), "knot 3: its time 1 s must be later than the 1 s of knot 2"),
        (SetKnot(2, "t", 0.5), "knot 3: its time 0.5 s must be later than the 1 s of knot 2"),
        (SetKnot(2, "t", 1.0001), "knot 3: expected at least 1 ms after knot 2, got 0.1"),
        (SetKnot(1, "q", math.nan), "knot 2, q: expected a finite number, got nan"),
        (SetKnot(1, "q", 1e9), "knot 2, q: expected at most 1e+06, got 1e+09"),
        (SetKnot(7, "q", 1.0), "knot: expected 1 to 4, got 8"),
        (SetKnot(0, "x", 1.0), "cell: unknown name 'x'"),
        (SetKnots(((0.0, 1.0),)), "knots: expected 2 to 31, got 1 (add one)"),
        (SetKnots(((0.0, 1.0), (1.0,))), "knot 2: expected two numbers, t and q, got 1"),
        (SetKnots(tuple((float(k), 0.0) for k in range(10_000))), "knots: expected 2 to 31, got 10000"),
        (AddKnot(9), "knot: expected 1 to 4, got 10"),
        (RemoveKnot(-1), "knot: expected 1 to 4, got 0"),
        (SetOption(0, "path", "virtual", [9.0, 1.0]), "virtual: cannot be given with ends='clamped'"),
        (SetOption(2, "path", "virtual", [9.0, 1.0]), "virtual: expected one time inside the first interval"),
        (SetOption(0, "path", "speed", 1.0), "option of spline: unknown name 'speed'"),
        (SetOption(0, "path", "v_start", [1.0, 2.0]), "v_start: expected 1 numbers"),
        (SetOption(0, "path", "v_start", [1e300]), "a derivative of the curve becomes larger"),
        (SetOption(0, "path", "ends", "loose"), "ends: unknown name 'loose'"),
        (SetOption(5, "path", "ends", "natural"), "curve: expected 1 to 3, got 6"),
        (ChoosePath(0, "cubic"), "knots: Cubic with end velocities takes exactly 2, got 4"),
        (ChoosePath(0, "helix"), "kind: unknown name 'helix'"),
        (ChooseLaw(0, "sudden"), "kind: unknown name 'sudden'"),
        (SetLimit("v_max", 0.0), "v_max: expected a positive number, or nothing for no limit; got 0"),
        (SetLimit("a_max", math.inf), "a_max: expected a positive number, or nothing for no limit; got inf"),
        (SetLimit("jerk", 1.0), "limit: unknown name 'jerk'"),
        (SetUnit("feet"), "unit: unknown name 'feet'"),
        (ShowDegree(4), "degree: expected one of 3, 5, 7, 9, got 4"),
        (ShowCurve(3), "curve: expected 1 to 3, got 4"),
        (ChooseExample("none"), "example: unknown name 'none'"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(state, command, says):
    with pytest.raises(InputError) as refusal:
        apply(state, command)
    assert says in str(refusal.value)


def test_two_knots_stay(state):
    state = apply(state, ChooseExample("hermite"))
    with pytest.raises(InputError, match=r"knots: expected 2 to 31, got 1 \(add one\)"):
        apply(state, RemoveKnot(0))


def test_a_law_that_leaves_the_path_is_refused(state):
    state = apply(state, ChooseExample("one_to_four"))
    with pytest.raises(InputError, match="law: "):
        apply(apply(state, ChooseLaw(0, "table")), SetOption(0, "law", "rows", [[0, 1, 2], [1, 3, -1.5]]))


@pytest.mark.parametrize(
    "change",
    [
        {"knots": [[0, 0]]},
        {"knots": [[0, 0], [1, math.nan]]},
        {"knots": "many"},
        {"curves": []},
        {"curves": [[0, {"key": "spline"}, {"key": "constant"}], [0, {"key": "spline"}, {"key": "constant"}]]},
        {"curves": [[5, {"key": "spline"}, {"key": "constant"}]]},
        {"curves": [[0, {"key": "circle"}, {"key": "constant"}]]},
        {"curves": [[0, {"key": "spline", "options": {"ends": 3}}, {"key": "constant"}]]},
        {"limits": [0.0, None]},
        {"limits": ["fast", None]},
        {"unit": "feet"},
        {"selected": 3},
        {"degree": 4},
    ],
)
def test_a_damaged_file_is_refused(state, change):
    data = state[Curves].to_json() | change
    with pytest.raises((InputError, ValueError, TypeError)):
        Curves.from_json(json.loads(json.dumps(data)), ROBOT)


def test_another_arm_changes_nothing(state):
    part = apply(state, SetKnot(1, "q", 1.5))[Curves]
    assert part.for_robot(catalogue()["scara"]) is part
