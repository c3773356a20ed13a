"""Newton's method in one variable: iterates, why it ends, and the film of its tangents."""

import json
import math

import pytest

from armlab.benches.iterate.newton_1d.clip import STEP, place_of
from armlab.benches.iterate.newton_1d.state import ChooseEquation, Newton1D, TypeEquation, solution
from armlab.benches.iterate.runs.one_equation import solved, typed_function, typed_slope
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.ik.iterate import EXAMPLES
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import State, apply
from support.clips import another_clip


def opened():
    return State.initial(catalogue()["planar_2r"])


@pytest.mark.parametrize(
    ("text", "x0", "status", "says"),
    [
        ("x^2 - 2", 1.0, "converged", "1.414213562"),
        ("x^2 - 2", 0.0, "level", "f′(x₀) = 0"),
        ("x^2 - 1000", 1.0, "converged", "31.6227766"),
        ("x^3 - 2x + 2", 0.0, "round", "the iterates repeat in a cycle"),
        ("atan(x)", 1.5, "away", "farther"),
        ("1/x", 1.0, "away", "farther"),
        ("sqrt(x)", 1.0, "undefined", "where f has no value"),
        ("cos(x) - 2", 1.0, "most", "not converging"),
        ("x^2", 1.0, "most", "still converging"),
        ("x", 0.0, "converged", "a root already"),
        ("5", 1.0, "level", "f′(x₀) = 0"),
        ("x^3-3*x+1", 1.0, "level", "f′(x₀) = 0"),
        ("x^3-3*x+1", -1.0, "level", "f′(x₀) = 0"),
        ("x^3-12*x+3", 2.0, "level", "f′(x₀) = 0"),
        ("x^4-4*x+5", 1.0, "level", "f′(x₀) = 0"),
        ("x*exp(-x)-0.2", 1.0, "level", "f′(x₀) = 0"),
        ("x^3-0.03*x+1", 0.1, "level", "f′(x₀) = 0"),
        ("sin(x)+2", math.pi / 2, "level", "f′(x₀) = 0"),
        ("1e-14*(x-3)", 0.0, "converged", "converged to x = 3 in 1 step"),
        ("1e-8*(x^2-2)", 1.5, "converged", "1.414213562"),
        ("1e-14*sin(x)+0.5*cos(x)-3", 0.0, "away", "farther"),
    ],
)
def test_every_end_has_its_reason(text, x0, status, says):
    found = solved("", text, x0)
    assert found.status == status
    assert says in found.says
    assert all(math.isfinite(each.x) and math.isfinite(each.f) for each in found.iterates)


def test_the_examples_of_the_core_are_those_of_the_page(truth):
    case = truth["C4.4.1-newton-scalar"]
    found = solved("root_of_two", "", case["inputs"]["x0"])
    expected = case["expected"]["x"]
    assert [each.x for each in found.iterates][: len(expected)] == pytest.approx(expected, abs=1e-14)
    statuses = {example.key: solved(example.key, "", example.x0).status for example in EXAMPLES}
    assert statuses["too_far"] == "away"
    assert statuses["cycle"] == "round"


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.key)
def test_an_example_is_what_its_text_says_with_a_slope_that_is_0_where_it_is(example):
    for x in (-2.0, 0.3, 1.5, 4.0):
        assert typed_function(example.text)(x) == pytest.approx(example.f(x), rel=1e-14)
        assert typed_slope(example.text)(x) == pytest.approx(example.df(x), rel=1e-14)
    level = {"one_joint": math.pi, "near_flat": -2.0 * math.pi, "cycle": math.sqrt(2.0 / 3.0)}
    if example.key in level:
        found = solved(example.key, "", level[example.key])
        assert (found.status, found.iterates[0].tangent.slope, found.last) == ("level", 0.0, 0)


def test_a_typed_equation_makes_the_same_steps_as_the_example():
    typed, known = solved("", "x^2 - 2", 1.0), solved("root_of_two", "", 1.0)
    assert [each.x for each in typed.iterates] == [each.x for each in known.iterates]


@pytest.mark.parametrize(
    ("text", "x0", "root"),
    [
        ("", 1e4, math.sqrt(2.0)),
        ("", 3e4, math.sqrt(2.0)),
        ("", 2e5, math.sqrt(2.0)),
        ("x^2 - 2", 5e5, math.sqrt(2.0)),
        ("x^5-x-1", 50.0, 1.1673039782614187),
    ],
)
def test_what_is_called_converged_is_the_root_however_far_the_start(text, x0, root):
    found = solved("root_of_two", text, x0)
    assert found.status == "most" or abs(found.iterates[-1].x - root) < 1e-9
    assert found.status == "converged" or "still converging" in found.says


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (TypeEquation("x +"), "breaks off"),
        (TypeEquation(""), "got nothing"),
        (TypeEquation("y^2"), "unknown name 'y'"),
        (TypeEquation("x q"), "unknown name 'q'"),
        (TypeEquation("sqrt(x - 5)"), "x₀ = 1"),
        (Set(Newton1D, "x0", math.nan), "x0: expected finite numbers, got nan"),
        (Set(Newton1D, "x0", 1e9), "x0: expected at least"),
        (ChooseEquation("nothing"), "unknown name"),
    ],
)
def test_nonsense_is_refused_and_the_old_equation_stays(command, says):
    with pytest.raises(InputError, match=says.replace("^", r"\^")):
        apply(opened(), command)


def test_the_film_stops_at_each_iterate_with_its_tangent_still_to_come():
    state = apply(opened(), OpenClip("newton_1d"))
    last = solution(state).last
    assert duration(state) == pytest.approx(STEP * last)
    for k in range(1, last + 1):
        state = apply(state, Step(True))
        place = place_of(state)
        assert (place.k, place.root, place.climb) == (k, 0.0, 0.0)
    middle = place_of(apply(state, Seek(0.5 * STEP)))
    assert middle.k == 0
    assert middle.tangent == 1.0
    assert 0.0 < middle.root < 1.0
    assert middle.climb == 0.0
    climbing = place_of(apply(state, Seek(0.9 * STEP)))
    assert climbing.root == 1.0
    assert 0.0 < climbing.climb < 1.0


def test_another_equation_rewinds_its_film_and_leaves_other_clips_alone():
    state = apply(apply(opened(), OpenClip("newton_1d")), Seek(3.0))
    assert apply(state, Set(Newton1D, "x0", 2.0))[Timeline].time == 0.0
    other = apply(apply(opened(), OpenClip(another_clip(state, "newton_1d"))), Seek(3.0))
    assert apply(other, Set(Newton1D, "x0", 2.0))[Timeline].time == 3.0


def test_it_is_written_read_back_and_kept_with_another_arm():
    state = apply(apply(opened(), TypeEquation("cos(x) - x")), Set(Newton1D, "x0", 0.3))
    part = state[Newton1D]
    read = Newton1D.from_json(json.loads(json.dumps(part.to_json())), state[RobotPart].robot)
    assert read == part
    assert apply(state, ChooseRobot("puma560"))[Newton1D] == part
    for damage in ({"text": "x +"}, {"x0": math.inf}, {"example": "nothing"}):
        with pytest.raises(InputError):
            Newton1D.from_json({**part.to_json(), "text": "", **damage}, state[RobotPart].robot)


@pytest.mark.parametrize(
    ("text", "x0", "root"), [("cos(q) - 0,5", 0.5, math.pi / 3.0), ("e^x - 2", 1.0, math.log(2.0)), ("x e^x", 1.0, 0.0)]
)
def test_the_unknown_may_be_a_joint_and_e_is_a_number(text, x0, root):
    state = apply(apply(opened(), TypeEquation(text)), Set(Newton1D, "x0", x0))
    found = solution(state)
    assert found.status == "converged"
    assert found.iterates[-1].x == pytest.approx(root, abs=1e-9)


def test_a_typed_function_without_a_value_is_not_a_number():
    assert math.isnan(typed_function("sqrt(x)")(-1.0))
    assert typed_function("2 x^2 + 1")(3.0) == 19.0
