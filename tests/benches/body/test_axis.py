"""Axis and angle: the film of the three steps, what each view says, and what is refused."""

import math

import numpy as np
import pytest

from armlab.benches.body.axis.clip import CLIP
from armlab.benches.body.axis.examples import EXAMPLES, ChooseAxisExample, example_of
from armlab.benches.body.axis.facts import FACTS
from armlab.benches.body.axis.film import Steps, film_time, steps_of
from armlab.benches.body.axis.inverse import errors, inverse_of
from armlab.benches.body.axis.state import CLIP_KEY, Axis, ShowStep
from armlab.benches.body.axis.ui.direct import steps_markup
from armlab.benches.body.axis.ui.eigen import circle, eigen_markup
from armlab.benches.body.axis.ui.inverse import inverse_markup, radians
from armlab.benches.body.axis.ui.scene import shown
from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.timing import DURATION, ENDS, REST
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.axis_angle import frame_about
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done

AXES = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 2.0, -2.0), (-1.0, 0.5, 0.2), (1.0, 0.0, 0.0)]


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def turned(axis, angle, *commands):
    return opened(SetWholeAxis(axis), SetBodyTurn(angle), *commands)


def said(markup, state):
    return str(joined(markup(state)))


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("angle", [0.0, 1.1, -2.0, math.pi, 5.0])
def test_both_bodies_end_as_the_body_of_the_tab_stands(axis, angle):
    state = turned(axis, angle, OpenClip(CLIP_KEY), Seek(DURATION))
    steps, R = steps_of(state), forms_of(state).R
    np.testing.assert_allclose(steps.at(film_time(state)), R, rtol=0, atol=1e-12)
    np.testing.assert_allclose(steps.direct(film_time(state)), R, rtol=0, atol=1e-12)
    assert CLIP.duration(state) == DURATION
    assert CLIP.stops(state) == ENDS[:2]


@pytest.mark.parametrize("axis", AXES)
def test_the_steps_carry_r_to_z_turn_about_z_and_carry_it_back(axis):
    r = np.array(axis) / math.hypot(*axis)
    steps = Steps(r, 1.3, frame_about(r))
    np.testing.assert_array_equal(steps.at(0.0), np.eye(3))
    for time in (ENDS[0], ENDS[0] + 0.5 * REST, ENDS[0] + REST + 0.6, ENDS[1]):
        np.testing.assert_allclose(steps.carried(time), [0, 0, 1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(steps.at(ENDS[0]), steps.C.T, rtol=0, atol=1e-12)
    np.testing.assert_allclose(steps.carried(DURATION), r, rtol=0, atol=1e-12)
    # The second body waits while the first one is carried, and turns when that one turns.
    np.testing.assert_array_equal(steps.direct(ENDS[0]), np.eye(3))
    np.testing.assert_array_equal(steps.direct(ENDS[1]), steps.direct(DURATION))


def test_the_picture_names_the_steps():
    state = turned((1.0, 2.0, -2.0), 1.1)
    names = [shown(steps_of(state), time, units_of(state))[0].name for time in (0.0, *ENDS)]
    assert names == ["in three steps", "step 1: Cᵀ", "step 2: about z", "in three steps"]
    one, other = shown(steps_of(state), ENDS[1], units_of(state))
    assert (one.about, other.about) == ("r: 63.0°", "r: 63.0°")
    np.testing.assert_allclose(one.axis, [0, 0, 1], rtol=0, atol=1e-12)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_the_angle_is_changed(key):
    state = opened(ChooseAxisExample(key))
    assert example_of(state) == key
    assert state[Axis].shown == EXAMPLES[key].shown
    assert example_of(apply(state, SetBodyTurn(0.3))) == ""


def test_arccos_loses_all_digits_of_a_tiny_angle_and_atan2_none():
    state = opened(ChooseAxisExample("tiny"))
    found = inverse_of(state)
    assert found.arccos == 0.0
    assert found.atan2 == pytest.approx(1e-8, rel=1e-7)
    assert found.lost(found.arccos) > 15.0
    assert found.lost(found.atan2) < 1.0
    np.testing.assert_allclose(found.axis, [0.0, 0.6, 0.8], rtol=0, atol=1e-7)
    state = opened(ChooseAxisExample("almost_half"))
    found = inverse_of(state)
    assert found.atan2 == pytest.approx(math.pi - 1e-8, abs=1e-15)
    assert found.lost(found.arccos) == pytest.approx(7.2, abs=0.3)
    np.testing.assert_allclose(np.abs(found.axis), [0.0, 0.6, 0.8], rtol=0, atol=1e-7)


def test_the_errors_of_arccos_grow_as_those_of_a_square_root():
    powers = np.array([2.0, 4.0, 6.0])
    for near in ("zero", "pi"):
        arccos, atan2 = errors(np.array([0.0, 0.6, 0.8]), near, powers)
        assert (atan2 < 1e-15).all()
        assert (arccos < 1e-15 * 10.0**powers).all()
        assert arccos[2] > 1e-13


def test_an_angle_beyond_half_a_turn_is_that_of_the_shorter_way():
    assert inverse_of(turned((0.0, 0.0, 1.0), 5.0)).atan2 == pytest.approx(2.0 * math.pi - 5.0)
    assert inverse_of(turned((0.0, 0.0, 1.0), 5.0)).angle == pytest.approx(2.0 * math.pi - 5.0)


def test_the_inverse_says_what_is_determined():
    text = said(inverse_markup, turned((1.0, 2.0, -2.0), 1.1))
    assert "Two solutions" in text
    assert "0.3333" in text
    assert "that would give 0.7765100043" in text
    assert "r is not determined" in said(inverse_markup, opened(ChooseAxisExample("none")))
    assert "Half a turn: sin θ = 0" in said(inverse_markup, opened(ChooseAxisExample("half")))
    assert radians(-1e-8) == "−1.000000000·10⁻⁸"


def test_the_eigenvalues_are_drawn_and_their_equation_is_right():
    text = said(eigen_markup, turned((1.0, 2.0, -2.0), 1.1))
    assert "λ² − 0.9072 λ + 1 = 0" in text
    assert "leaves 1.8144 in place of 0" in text
    assert "every vector is an eigenvector" in said(eigen_markup, opened(ChooseAxisExample("none")))
    assert "both other eigenvalues are −1" in said(eigen_markup, opened(ChooseAxisExample("half")))
    assert 'cx="105.0" cy="29.0"' in str(circle(math.pi / 2.0, ""))


def test_the_steps_have_their_matrices():
    state = turned((1.0, 2.0, -2.0), 1.1)
    assert "= R" in said(steps_markup, state)
    assert "after step 1" in said(steps_markup, apply(state, ShowStep(1)))
    assert not apply(state, ShowStep(1))[Timeline].playing


def test_facts_are_those_of_the_formulas():
    facts, state = FACTS.facts, turned((1.0, 2.0, -2.0), 1.1)
    value = {key: fact.now(state).value for key, fact in facts.items()}
    assert value["arccos"] == pytest.approx(1.1)
    assert value["atan2"] == pytest.approx(1.1)
    assert value["with_half"] == pytest.approx(0.7765100042643447)
    assert value["determined"]
    assert value["trace"] == pytest.approx(1.0 + 2.0 * math.cos(1.1))
    assert not facts["determined"].now(opened(ChooseAxisExample("none"))).value
    np.testing.assert_allclose(np.reshape(value["dyad"], (3, 3)) @ [1, 2, -2], [1, 2, -2], rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.reshape(value["skew"], (3, 3)) @ [1, 2, -2], 0.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (ShowStep(4), "steps: expected 0 to 3, got 4"),
        (ShowStep(-1), "steps: expected 0 to 3"),
        (Set(Axis, "shown", "dance"), "dance"),
        (Set(Axis, "near", "one"), "one"),
        (ChooseAxisExample("all"), "all"),
        (SetWholeAxis((0.0, 0.0, 0.0)), "zero has no direction"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
