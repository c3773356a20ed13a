"""The bench of the matrix exponential: examples, what is refused, sliders, and what is kept."""

import json
import math

import numpy as np
import pytest

from armlab.benches.control.exponential.examples import EXAMPLES, ChooseExponentialExample
from armlab.benches.control.exponential.facts import FACTS
from armlab.benches.control.exponential.state import MOST_TERMS, Exponential, MoveTime, SetEntry, SumTerms, bounds
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.bench import choosing
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State, apply
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def part(*commands):
    return opened(*commands)[Exponential]


def test_the_examples_read_what_their_sentences_say(truth):
    found = {key: example.part.found for key, example in EXAMPLES.items()}
    assert found["notes"].printed == pytest.approx(0.895, abs=5e-4)
    assert float(np.abs(found["notes"].product - found["notes"].whole).max()) < 1e-14
    assert int(np.argmax(found["notes"].errors < 1e-10)) + 1 == 16
    case = truth["C1.3-error-decay"]
    decay = EXAMPLES["decay"].part
    assert (decay.x0, decay.t) == (tuple(case["inputs"]["e0"]), case["inputs"]["t"])
    np.testing.assert_allclose(found["decay"].whole @ decay.x0, case["expected"]["e"], rtol=0, atol=1e-13)
    turn = [[math.cos(1.0), -math.sin(1.0)], [math.sin(1.0), math.cos(1.0)]]
    np.testing.assert_allclose(found["turn"].whole, turn, rtol=0, atol=1e-13)
    assert (found["defective"].product, found["defective"].printed) == (None, None)
    assert found["defective"].whole[0, 1] == pytest.approx(math.exp(-1.0), abs=1e-13)
    assert found["almost_defective"].basis.basis == "poor"
    assert 1e-6 < found["hump"].errors[EXAMPLES["hump"].part.terms - 1] < 1e-4


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_an_example_is_put_in_place_and_left_by_another_matrix(key):
    state = opened(choosing(f"exponential/{key}"))
    assert state[Exponential].example == key
    assert apply(state, SumTerms(3))[Exponential].example == key
    other = apply(state, SetEntry("a12", 0.5))[Exponential]
    assert (other.example, other.A[0][1]) == ("", 0.5)
    assert np.isfinite(other.curve.x).all()


def test_the_curve_goes_through_the_place_at_t_and_is_kept_while_t_moves():
    before = part(MoveTime(1.5))
    np.testing.assert_allclose(before.curve.x[80], before.found.whole @ before.x0, rtol=0, atol=1e-12)
    assert part(MoveTime(1.6)).curve.x is before.curve.x
    assert part(MoveTime(1e9)).t == 3.0
    assert part(MoveTime(-1.0)).t == 0.0
    assert part(SetEntry("end", 0.5)).t == 0.5


@pytest.mark.parametrize(
    ("rows", "values"),
    [
        ("0 1 -9 -6", [-3.0, -3.0]),
        ("1 -1 4 -3", [-1.0, -1.0]),
        ("0 1 -2 -3", [-1.0, -2.0]),
        ("0 -1 1 0", None),
    ],
)
def test_the_eigenvalues_a_lesson_checks_are_those_of_the_page(rows, values):
    a11, a12, a21, a22 = map(float, rows.split())
    state = State.initial(catalogue()["planar_2r"]).replace(Exponential(((a11, a12), (a21, a22)), end=2.0))
    found = FACTS.facts["eigenvalues"].value(state)
    if values is None:
        assert found is None
    else:
        np.testing.assert_allclose(found, values, rtol=0, atol=1e-12)


def test_the_bounds_hold():
    for example in EXAMPLES.values():
        found, bound = example.part.found, bounds(example.part)
        rounding = 1e-16 * float(np.abs(found.sums).max()) * MOST_TERMS
        assert np.all(found.errors <= bound + 1e-11 * np.abs(found.whole).max() + rounding)


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (SetEntry("a33", 1.0), "unknown name 'a33'"),
        (SetEntry("a11", math.inf), "matrix A: expected 2 rows of 2 finite numbers"),
        (SetEntry("x1", 1e9), "x0: expected at least -1000 and at most 1000"),
        (SetEntry("a21", 1e9), "matrix A: expected numbers from -1000 to 1000"),
        (SetEntry("a11", 500.0), "an eigenvalue .* of 1500, expected at most 30; take an end up to 0.06 s"),
        (SetEntry("end", 0.0), "end: expected at least 0.001 s and at most 100 s"),
        (SumTerms(0), "terms: expected a whole number, at least 1"),
        (SumTerms(1000), "terms: expected a whole number, at most 120"),
        (MoveTime(math.nan), "t: expected finite numbers"),
        (ChooseExponentialExample("nothing"), "unknown name 'nothing'"),
    ],
)
def test_nonsense_is_refused(command, says):
    with pytest.raises(InputError, match=says):
        opened(command)


def test_it_is_written_read_back_and_kept_with_another_arm():
    state = opened(ChooseExponentialExample("spiral"), SetEntry("x2", -0.5), MoveTime(2.0), SumTerms(7))
    kept, robot = state[Exponential], state[RobotPart].robot
    assert Exponential.from_json(json.loads(json.dumps(kept.to_json())), robot) == kept
    assert apply(state, ChooseRobot("puma560"))[Exponential] == kept
    for damage in ({"A": [[1.0, 2.0]]}, {"t": 99.0}, {"x0": [1.0, math.nan]}, {"terms": 0}, {"end": 0.0}):
        with pytest.raises((InputError, ValueError)):
            Exponential.from_json({**kept.to_json(), **damage}, robot)
