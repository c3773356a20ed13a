"""Two rotations in both orders: the film, the angle between the ends, examples, fields, facts, and what is refused."""

import itertools
import json
import math

import numpy as np
import pytest

from armlab.benches.body.forms.timing import REST
from armlab.benches.body.order.clip import CLIP
from armlab.benches.body.order.examples import EXAMPLES, ChooseOrderExample, example_of
from armlab.benches.body.order.facts import FACTS
from armlab.benches.body.order.film import curves, ends_of, pairs_of
from armlab.benches.body.order.state import (
    CLIP_KEY,
    ENDS,
    Order,
    ScaleAngles,
    SetOrderAngle,
    SetOrderAxis,
    ShowRotation,
)
from armlab.benches.body.order.ui.page import ends_markup, products_markup
from armlab.benches.body.order.ui.scene import shown
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import axis_angle, rotation_about, skew
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def said(state):
    return str(joined(ends_markup(state)))


@pytest.mark.parametrize("about", ["base", "body"])
def test_the_later_rotation_stands_on_the_left_about_axes_of_the_base_and_on_the_right_about_carried_ones(about):
    state = opened(SetOrderAngle(0, 0.4), SetOrderAngle(1, -1.1), Set(Order, "about", about))
    A, B = rotation_about("x", 0.4), rotation_about("z", -1.1)
    one, other = (pair.at(ENDS[-1]) for pair in pairs_of(state))
    expected = (B @ A, A @ B) if about == "base" else (A @ B, B @ A)
    np.testing.assert_allclose(one, expected[0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(other, expected[1], rtol=0, atol=1e-15)
    for pair in pairs_of(state):
        np.testing.assert_array_equal(pair.at(0.0), np.eye(3))
        # Either rotation leaves its axis where the body has it by then.
        before, after = pair.at(ENDS[0] + REST), pair.at(ENDS[-1])
        np.testing.assert_allclose(after @ before.T @ pair.axis(1), pair.axis(1), rtol=0, atol=1e-12)
        np.testing.assert_allclose(before @ pair.axis(0), pair.axis(0), rtol=0, atol=1e-12)


def test_quarter_turns_end_a_third_of_a_turn_apart_as_in_the_notes():
    state = opened(ChooseOrderExample("quarters"))
    assert math.degrees(ends_of(state).apart) == pytest.approx(120.0, abs=1e-9)
    one, other = (pair.at(ENDS[-1]) for pair in pairs_of(state))
    assert math.degrees(axis_angle(one.T @ other)[1]) == pytest.approx(120.0, abs=1e-9)
    assert "The ends are" in said(state)
    assert "120.0°" in said(state)


def test_ten_times_a_tenth_of_a_turn_as_it_is_typed_is_a_turn():
    state = opened(SetOrderAngle(0, 0.62832), SetOrderAngle(1, -0.62832), ScaleAngles(10.0))
    assert state[Order].angles == (2.0 * math.pi, -2.0 * math.pi)


def test_a_tenth_of_the_angles_leaves_a_hundredth_between_the_ends():
    state, found = opened(SetOrderAngle(0, 0.2), SetOrderAngle(1, 0.1)), []
    for _ in range(4):
        found.append(ends_of(state))
        state = apply(state, ScaleAngles(0.1))
    for large, small in itertools.pairwise(found[1:]):
        assert large.apart / small.apart == pytest.approx(100.0, rel=1e-3)
        assert large.beyond / small.beyond == pytest.approx(100.0, rel=0.05)
    assert found[-1].apart == pytest.approx(found[-1].rule, rel=1e-6)
    assert "2.00·10⁻¹⁰ rad" in said(state)
    assert "The order counts" in said(state)


@pytest.mark.parametrize("about", ["base", "body"])
def test_what_is_beyond_the_first_order_is_that_of_a_then_b(about):
    state = opened(SetOrderAxis(0, 1, 0.7), SetOrderAxis(1, 0, -0.2), SetOrderAngle(0, 1.0), SetOrderAngle(1, 2.0))
    state = apply(state, Set(Order, "about", about))
    pair, _ = pairs_of(state)
    first_order = np.eye(3) + skew(pair.axes[0]) + 2.0 * skew(pair.axes[1])
    assert ends_of(state).beyond == pytest.approx(float(np.abs(pair.at(ENDS[-1]) - first_order).max()))


def test_a_hundredth_is_promised_only_where_a_tenth_of_the_angles_leaves_it():
    for degrees, promised in ((90.0, True), (350.0, False)):
        angle = math.radians(degrees)
        state = opened(SetOrderAngle(0, angle), SetOrderAngle(1, angle))
        left = ends_of(apply(state, ScaleAngles(0.1))).apart / ends_of(state).apart
        assert (left < 0.02) == promised
        assert ("leaves about a hundredth of this" in said(state)) == promised
        assert ("where the angles are small" in said(state)) != promised


def test_the_curve_has_slope_two_and_goes_through_the_present_angle():
    part = Order(angles=(0.3, -0.15))
    powers, apart, rule, beyond = curves(part)
    low = powers < -1.0
    for curve in (apart, rule, beyond):
        np.testing.assert_allclose(np.diff(curve[low]) / np.diff(powers[low]), 2.0, rtol=0, atol=0.02)
    here = ends_of(opened(Set(Order, "angles", part.angles)))
    assert np.interp(math.log10(here.largest), powers, apart) == pytest.approx(math.log10(here.apart), abs=1e-3)
    # About one axis nothing is left between the ends.
    assert np.isnan(curves(EXAMPLES["one_axis"].part)[1]).all()
    assert np.isnan(curves(Order(angles=(0.0, 0.0)))[1]).all()


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_an_angle_is_changed(key):
    state = opened(SetOrderAngle(0, 0.7), ChooseOrderExample(key))
    assert example_of(state) == key
    assert example_of(apply(state, SetOrderAngle(0, 0.123))) == ""


@pytest.mark.parametrize(
    ("commands", "told"),
    [
        ([ChooseOrderExample("one_axis")], "Both axes are one line"),
        ([ChooseOrderExample("half_turns")], "happen to commute"),
        ([SetOrderAngle(1, 0.0)], "One of the rotations is none"),
        ([ChooseOrderExample("tiny"), ScaleAngles(1e-4)], "too small to be told from rounding"),
    ],
)
def test_it_is_said_why_two_orders_end_alike(commands, told):
    assert told in said(opened(*commands))
    assert "Both orders end alike" in said(opened(*commands))


def test_the_film_stops_between_the_rotations_and_the_picture_names_them():
    state = opened(ShowRotation(1))
    assert CLIP.duration(state) == ENDS[1]
    assert CLIP.stops(state) == ENDS[:1]
    assert (state[Timeline].clip, state[Timeline].time, state[Timeline].playing) == (CLIP_KEY, ENDS[0], False)
    one, other = (shown(pair, ENDS[0], units_of(state)) for pair in pairs_of(state))
    assert (one.name, one.about, other.name, other.about) == ("a, then b", "a: 90.0°", "b, then a", "b: 90.0°")
    assert "a, then b" in str(products_markup(state))
    # Another angle begins the film anew.
    assert apply(apply(opened(OpenClip(CLIP_KEY)), Seek(1.0)), SetOrderAngle(0, 1.0))[Timeline].time == 0.0


def test_facts_are_those_of_the_page():
    state = opened(ChooseOrderExample("quarters"))
    value = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    assert value["apart"] == pytest.approx(math.radians(120.0))
    assert value["largest"] == pytest.approx(math.pi / 2)
    assert value["rule"] == pytest.approx(math.pi**2 / 4)
    assert not value["alike"]
    np.testing.assert_allclose(np.reshape(value["first_a"], (3, 3)), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], atol=1e-15)
    assert FACTS.facts["alike"].now(opened(ChooseOrderExample("half_turns"))).value


def test_it_is_written_down_and_read_back():
    part = opened(SetOrderAxis(1, 0, 0.5), Set(Order, "about", "body"))[Order]
    assert Order.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetOrderAxis(0, 0, 0.0), "a: expected an axis that is not zero"),
        (SetOrderAxis(2, 0, 0.0), r"rotation \(counted from 0\): expected 0 to 1, got 2"),
        (SetOrderAxis(1, 3, 0.0), r"b \(counted from 0\): expected 0 to 2, got 3"),
        (SetOrderAngle(0, 7.0), "angles"),
        (SetOrderAngle(0, float("nan")), "angles: expected finite numbers"),
        (ScaleAngles(10.0), "size: expected angles up to a whole turn, got 900°"),
        (ScaleAngles(1e-12), "size: expected an angle of at least 1e-09 rad"),
        (ScaleAngles(-1.0), "size: expected angles"),
        (ShowRotation(3), "rotations: expected 0 to 2, got 3"),
        (Set(Order, "about", "moon"), "moon"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
