"""The laboratory of curves: what a person does with it, and input that makes no sense."""

import json
import math

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.commands import (
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
    TakeFastest,
)
from armlab.benches.motion.curves.examples import ChooseExample
from armlab.benches.motion.curves.job import JOB, wanted, with_fastest
from armlab.benches.motion.curves.knots import MOST_KNOTS
from armlab.benches.motion.curves.made import Made
from armlab.benches.motion.curves.state import MOST_CURVES, UNITS, Curves
from armlab.benches.motion.curves.ui.listed import curves_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.state import State, apply
from support.forms import BareForm

ROBOT = catalogue()["puma560"]


@pytest.fixture
def state():
    return State.initial(ROBOT)


# -- what a person does ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "command",
    [SetKnot(1, "t", 0.4), SetKnot(2, "t", 2.6), SetKnots(((0.0, 1.0), (0.2, 2.0), (3.0, 0.0))), RemoveKnot(0)],
)
def test_virtual_times_that_do_not_fit_other_knots_are_left_out_and_the_curve_says_so(state, command):
    before = state[Curves].curves[2]
    assert before.path.options == {"ends": "both", "virtual": (0.5, 2.5)}
    part = apply(state, command)[Curves]
    assert part.curves[2].path.options == {"ends": "both"}
    assert [each.dropped for each in part.curves] == [False, False, True]
    assert all(isinstance(each, Made) for each in part.outcomes)
    assert curves_markup(BareForm(), part).count("were left out") == 1
    assert "were left out" not in curves_markup(BareForm(), state[Curves])
    # What is chosen afterwards is kept, and nothing is said of the past.
    first, last = part.knots[0][0] + 0.1, part.knots[-1][0] - 0.1
    chosen = apply(apply(state, command), SetOption(2, "path", "virtual", [first, last]))[Curves].curves[2]
    assert chosen.path.options["virtual"] == (first, last)
    assert not chosen.dropped


def test_virtual_times_that_fit_stay(state):
    part = apply(apply(state, SetKnot(1, "q", 5.0)), SetKnot(1, "t", 0.6))[Curves]
    assert part.curves == state[Curves].curves


def test_virtual_times_are_left_out_where_the_fastest_intervals_do_not_fit_them(state):
    for limit in ("v_max", "a_max"):
        state = apply(state, SetLimit(limit, 40.0))
    found = apply(with_fastest(apply(state, FindFastest())), TakeFastest())
    assert found[Curves].knots[1][0] < 0.5
    assert found[Curves].curves[2].dropped
    assert all(isinstance(each, Made) for each in found[Curves].outcomes)


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
        assert apply(state, Set(Curves, "unit", unit))[Curves].unit == unit


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
    state = apply(state, Set(Curves, "selected", 0))
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
    assert wanted(apply(state, Set(Curves, "limits", (1.0, 2.0))), frozenset()) is None
    assert wanted(apply(state, Set(Curves, "unit", "mm")), frozenset()) is not None
    assert with_fastest(moved) is moved


@pytest.mark.parametrize(
    "command", [SetOption(0, "path", "ends", "natural"), ChoosePath(0, "interpolating"), RemoveCurve(0)]
)
def test_fastest_intervals_for_other_ends_are_let_go(state, command):
    state = apply(apply(state, ChooseExample("fastest")), AddCurve())
    state = apply(apply(apply(state, ChoosePath(1, "spline")), SetOption(1, "path", "ends", "natural")), FindFastest())
    assert state[Curves].asked.ends == "clamped"
    found = with_fastest(state)
    assert apply(found, RemoveCurve(1))[Curves].fastest == found[Curves].fastest is not None
    for before in (state, found):
        part = apply(before, command)[Curves]
        assert (part.ends, part.asked, part.fastest) == ("natural", None, None)


def test_the_fastest_intervals_need_limits_and_knots_that_move(state):
    with pytest.raises(InputError, match="need both v_max and a_max"):
        apply(state, FindFastest())
    with pytest.raises(InputError, match="none have been found"):
        apply(state, TakeFastest())
    state = apply(apply(state, SetLimit("v_max", 1.0)), SetLimit("a_max", 1.0))
    with pytest.raises(InputError, match="knot 2: the same q as knot 1"):
        apply(apply(state, SetKnot(1, "q", 0.0)), FindFastest())
    many = tuple((float(k), float(k % 2)) for k in range(MOST_KNOTS))
    with pytest.raises(InputError, match=f"at most 8, there are {MOST_KNOTS}"):
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
        (SetKnot(2, "t", 1.0001), "knot 3: expected at least 1 ms after knot 2, got 0.1 ms"),
        (SetKnot(0, "t", -1e9), "knot 1, t: expected at most 10000 s either way, got -1e+09 s"),
        (SetKnot(1, "q", math.nan), "knot 2, q: expected a finite number, got nan"),
        (SetKnot(1, "q", 1e9), "knot 2, q: expected at most 1e+06 rad either way, got 1e+09 rad"),
        (SetKnot(7, "q", 1.0), "knot: expected 1 to 4, got 8"),
        (SetKnot(0, "x", 1.0), "cell: unknown name 'x'"),
        (SetKnots(((0.0, 1.0),)), "knots: expected 2 to 31, got 1 (add one)"),
        (SetKnots(((0.0, 1.0), (1.0,))), "knot 2: expected two numbers, t and q, got 1"),
        (SetKnots(tuple((float(k), 0.0) for k in range(10_000))), "knots: expected 2 to 31, got 10000"),
        (AddKnot(9), "knot: expected 1 to 4, got 10"),
        (RemoveKnot(-1), "knot: expected 1 to 4, got 0"),
        (SetOption(0, "path", "virtual", [9.0, 1.0]), "virtual: cannot be used while velocities are given at both"),
        (SetOption(2, "path", "virtual", [9.0, 1.0]), "virtual: expected one time inside the first interval"),
        (SetOption(0, "path", "speed", 1.0), "option of spline: unknown name 'speed'"),
        (SetOption(0, "path", "v_start", [1.0, 2.0]), "v_start: expected one number"),
        (SetOption(0, "path", "v_start", [1e300]), "a derivative of the curve becomes larger"),
        (SetOption(0, "path", "ends", "loose"), "ends: unknown name 'loose'"),
        (SetOption(5, "path", "ends", "natural"), "curve: expected 1 to 3, got 6"),
        (ChoosePath(0, "cubic"), "knots: Cubic with end velocities takes exactly 2, got 4"),
        (ChoosePath(0, "helix"), "kind: unknown name 'helix'"),
        (ChooseLaw(0, "sudden"), "kind: unknown name 'sudden'"),
        (SetLimit("v_max", 0.0), "v_max: expected a positive number, or nothing for no limit; got 0"),
        (SetLimit("a_max", math.inf), "a_max: expected a positive number, or nothing for no limit; got inf"),
        (SetLimit("jerk", 1.0), "limit: unknown name 'jerk'"),
        (Set(Curves, "unit", "feet"), "unit: unknown name 'feet'"),
        (Set(Curves, "degree", 4), "degree: expected one of 3, 5, 7, 9, got 4"),
        (Set(Curves, "selected", 3), "curve: expected 1 to 3, got 4"),
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
