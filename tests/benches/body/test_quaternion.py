"""Quaternions: two whole turns until q is back, the product in both orders, and what is refused."""

import math

import numpy as np
import pytest

from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.quaternion.clip import CLIP
from armlab.benches.body.quaternion.facts import FACTS
from armlab.benches.body.quaternion.film import DURATION, angle_at, film_time, present, products, second, turned
from armlab.benches.body.quaternion.state import CLIP_KEY, Quaternions, SetSecond
from armlab.benches.body.quaternion.ui.page import cover_markup, product_markup
from armlab.benches.body.quaternion.ui.scene import shown
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import rotation_from_axis_angle, rotation_from_quaternion
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def at(time, *commands):
    return opened(*commands, OpenClip(CLIP_KEY), Seek(time))


def test_after_one_turn_q_is_minus_one_and_after_two_it_is_back():
    np.testing.assert_allclose(present(at(0.0)), [1, 0, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(present(at(DURATION / 2)), [-1, 0, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(present(at(DURATION)), [1, 0, 0, 0], rtol=0, atol=1e-15)
    assert "The body is back, q is not" in str(cover_markup(at(DURATION / 2)))
    assert "q = 1 after two whole turns" in str(cover_markup(at(DURATION)))
    assert "two factors of q" in str(cover_markup(opened()))
    assert CLIP.duration(opened()) == DURATION
    assert film_time(opened()) < DURATION


@pytest.mark.parametrize("angle", [0.4, 3.5, 7.0, 12.0])
def test_the_quaternion_turns_by_half_the_angle(angle):
    r = np.array([1.0, 2.0, 2.0]) / 3.0
    q = turned(r, angle)
    for each in (q, -q):
        R = rotation_from_axis_angle(r, angle)
        np.testing.assert_allclose(rotation_from_quaternion(each), R, rtol=0, atol=1e-14)
    assert q[0] == pytest.approx(math.cos(angle / 2))


def test_the_product_is_that_of_the_matrices_and_has_an_order():
    state = at(1.5, SetSecond(2, -0.5), SetWholeAxis((1.0, -2.0, 0.5)))
    (one, other), p, q = products(state), second(state), present(state)
    R_p, R_q = rotation_from_quaternion(p), rotation_from_quaternion(q)
    np.testing.assert_allclose(rotation_from_quaternion(one), R_p @ R_q, rtol=0, atol=1e-14)
    np.testing.assert_allclose(rotation_from_quaternion(other), R_q @ R_p, rtol=0, atol=1e-14)
    assert np.abs(one - other).max() > 0.1
    assert "The order matters" in str(joined(product_markup(state)))
    same = at(1.5, SetWholeAxis((1.0, 0.0, 0.0)))
    assert "both orders are the same" in str(joined(product_markup(same)))


def test_the_picture_shows_q_and_the_product():
    state = at(1.0, SetSecond(3, 0.7))
    one, other = shown(state, units_of(state))
    np.testing.assert_allclose(other.R @ one.R.T, rotation_from_quaternion(second(state)), rtol=0, atol=1e-14)
    np.testing.assert_allclose(rotation_from_axis_angle(one.axis, angle_at(1.0)), one.R, rtol=0, atol=1e-14)


def test_facts_are_of_the_quaternion_of_the_body():
    state = opened(SetWholeAxis((0.0, 0.0, 1.0)), SetBodyTurn(math.pi / 2))
    value = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    # By hand: a quarter about x and a quarter about z.
    np.testing.assert_allclose(value["product"], [0.5, 0.5, -0.5, 0.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(value["reversed"], [0.5, 0.5, 0.5, 0.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(value["second"], [math.sqrt(0.5), math.sqrt(0.5), 0, 0], rtol=0, atol=1e-15)
    assert forms_of(state).q[0] == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetSecond(4, 0.0), r"p \(counted from 0\): expected 0 to 3, got 4"),
        (Set(Quaternions, "p", [0.0, 0.0, 0.0, 0.0]), "zero is no rotation"),
        (SetSecond(0, float("nan")), "p: expected finite numbers"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
