"""Coils in a field: numbers in two ways, the film, what the scene draws, and what is refused."""

import math

import numpy as np
import pytest

from armlab.benches.drive.stage import around, placed_at, stage_of, turned
from armlab.benches.drive.torque.clip import CLIP
from armlab.benches.drive.torque.examples import EXAMPLES, ChooseTorqueExample
from armlab.benches.drive.torque.facts import FACTS
from armlab.benches.drive.torque.sampled import curve, sampled_of
from armlab.benches.drive.torque.state import CLIP_KEY, TURN, Torque, present_angle
from armlab.benches.drive.torque.ui.model import brushes_glb, coil_glb, shaft_glb
from armlab.benches.drive.torque.ui.numbers import check_markup, now_markup, turn_markup
from armlab.benches.drive.torque.ui.scene import marks_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.drive.coils import AXIS, MOST_COILS, UP
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done

FREE = Set(Torque, "motion", "free")


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def value(state, name):
    return FACTS.facts[name].now(state).value


@pytest.mark.parametrize("switched", [True, False])
@pytest.mark.parametrize("coils", range(1, MOST_COILS + 1))
def test_the_closed_form_and_the_sampled_turn_agree(coils, switched):
    state = opened(Set(Torque, "coils", coils), Set(Torque, "switched", switched))
    found, (least, largest, mean) = state.derived(sampled_of), state[Torque].torques
    # 7200 angles miss an extreme by half of one of them at most.
    most = 1e-6 * coils * state[Torque].coil.peak
    assert (found.least, found.largest) == pytest.approx((least, largest), abs=most)
    assert found.mean == pytest.approx(mean, abs=most)
    assert found.zeros == (2 if coils == 1 or not switched else 0)
    assert (value(state, "ripple") is None) == (not switched)


def test_the_torque_of_the_vectors_is_that_of_the_formula_along_the_film():
    for time in np.linspace(0.0, TURN, 23):
        state = opened(OpenClip(CLIP_KEY), Seek(float(time)))
        found = state.derived(sampled_of)
        assert found.along == pytest.approx(float(found.single[0]), abs=1e-12)
        assert present_angle(state) == pytest.approx(math.pi / 6.0 + 2.0 * math.pi * time / TURN)


def test_the_film_stops_where_the_torque_is_zero_or_largest():
    state = opened()
    stops = CLIP.stops(state)
    angles = [state[Torque].angle(time) / (0.5 * math.pi) for time in stops]
    assert angles == pytest.approx([1.0, 2.0, 3.0, 4.0])
    assert CLIP.duration(state) == TURN
    assert CLIP.stops(opened(ChooseTorqueExample("runs"))) == ()


def test_a_rotor_that_is_let_go_swings_or_runs():
    swings, runs = opened(ChooseTorqueExample("swings")), opened(ChooseTorqueExample("runs"))
    assert value(swings, "turned") == pytest.approx(math.pi, abs=0.2)
    assert value(runs, "turned") > 100.0
    assert value(opened(ChooseTorqueExample("dead")), "turned") == pytest.approx(0.0, abs=1e-12)
    half = opened(ChooseTorqueExample("runs"), OpenClip(CLIP_KEY), Seek(5.0))
    assert 0.5 < present_angle(half) < value(runs, "turned")


def test_a_current_the_other_way_round_turns_it_back():
    state = opened(ChooseTorqueExample("runs"), Set(Torque, "current", -2.0))
    assert value(state, "turned") < -100.0
    assert value(state, "torque") < 0.0
    assert value(state, "mean") < 0.0
    theta, every, one = curve(state[Torque], 91)
    assert len(theta) == 91
    assert (every <= 0.0).all()
    np.testing.assert_array_equal(every, one)


@pytest.mark.parametrize("switched", [True, False])
@pytest.mark.parametrize("coils", [1, 2, 3])
def test_facts_of_a_turn_have_the_sign_of_the_current(coils, switched):
    ahead = opened(Set(Torque, "coils", coils), Set(Torque, "switched", switched))
    back = apply(ahead, Set(Torque, "current", -2.0))
    found = back.derived(sampled_of)
    for name in ("least", "largest", "mean"):
        assert value(back, name) == pytest.approx(getattr(found, name), abs=1e-6)
    assert value(back, "least") == pytest.approx(-value(ahead, "largest"))
    assert value(back, "least") <= value(back, "torque") <= value(back, "largest")
    for name in ("ripple", "constant"):
        assert value(back, name) == value(ahead, name)


def test_what_is_said_of_a_turn():
    back = str(joined(turn_markup(opened(Set(Torque, "current", -2.0)))))
    assert "mean −63.66 mN m" in back
    assert "between −100 mN m and 0 N m" in back
    assert "Ripple 157.1 %, mean 63.66 mN m" in str(joined(turn_markup(opened())))
    assert "at every multiple of π" in str(joined(turn_markup(opened())))
    assert "Mean torque of a turn: 0 N m" in str(joined(turn_markup(opened(ChooseTorqueExample("unswitched")))))
    assert "No current, no torque" in str(joined(turn_markup(opened(Set(Torque, "current", 0.0)))))
    assert "157.1 %" in str(check_markup(opened()))
    assert check_markup(opened(ChooseTorqueExample("unswitched"))) is None
    assert check_markup(opened(Set(Torque, "current", 0.0))) is None
    assert value(opened(Set(Torque, "current", 0.0)), "constant") is None
    text = str(joined(now_markup(opened(ChooseTorqueExample("two")))))
    assert "all other coils" in text
    assert value(opened(ChooseTorqueExample("three")), "ripple") == pytest.approx(0.1403, abs=1e-4)


def test_the_scene_draws_force_and_torque_as_they_are():
    state = opened(ChooseTorqueExample("level"))
    part, found = state[Torque], state.derived(sampled_of)
    marks = marks_of(part, found, units_of(state), dark=False)
    (start, end, _), *_ = marks["force1"].arrows
    np.testing.assert_allclose((end - start) / np.linalg.norm(end - start), found.forces[0] / 2.5, atol=1e-12)
    assert marks["force1"].label == "F₁ = 2.5 N"
    ((start, end, _),) = marks["torque"].arrows
    assert (end - start) @ AXIS > 0.0
    assert marks["torque"].label == "τ = 100 mN m"
    assert len(marks["wire"].arrows) == 2
    # Where there is no torque there is no arrow, only the number.
    flat = opened(Set(Torque, "start", 0.0))
    none = marks_of(flat[Torque], flat.derived(sampled_of), units_of(flat), dark=True)
    assert none["torque"].arrows == []
    assert none["torque"].label == "τ = 0 N m"
    dark = opened(Set(Torque, "current", 0.0))
    assert marks_of(dark[Torque], dark.derived(sampled_of), units_of(dark), dark=True)["force1"].arrows == []


def test_the_rotor_turns_as_the_lever_arm_does():
    state = opened(Set(Torque, "start", 1.2))
    arm = state.derived(sampled_of).arms[0]
    np.testing.assert_allclose(turned(1.2) @ UP, arm / np.linalg.norm(arm), atol=1e-12)


def test_the_model_has_two_segments_for_each_coil():
    sizes = [len(shaft_glb(coils, True)) for coils in (1, 3, 12)]
    assert sizes == sorted(sizes)
    assert shaft_glb(1, False) != shaft_glb(1, True)
    assert brushes_glb(True) != brushes_glb(False)
    assert coil_glb(True) != coil_glb(False)


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "youbot"])
def test_the_model_stands_where_the_home_view_shows_the_arm(key):
    state = State.initial(catalogue()[key])
    pose, unit = stage_of(state)
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
    box = around(state, (1.0, 2.0, 0.5))
    assert box.shape == (8, 3)
    np.testing.assert_allclose(box.mean(axis=0), pose[:3, 3], atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(placed_at(pose, unit, AXIS) - pose[:3, 3]), unit)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_typed(key):
    state = opened(ChooseTorqueExample(key))
    assert state[Torque].example == key
    assert apply(state, Set(Torque, "B", 0.123))[Torque].example == ""


@pytest.mark.parametrize(
    ("commands", "told"),
    [
        ([Set(Torque, "coils", 0)], "coils"),
        ([Set(Torque, "coils", 13)], "coils: expected a whole number, at most 12"),
        ([Set(Torque, "B", 0.0)], "B"),
        ([Set(Torque, "motion", "free"), Set(Torque, "duration", 60.0)], "expected at most 40; take a shorter time"),
        ([Set(Torque, "friction", 1.0), Set(Torque, "inertia", 1e-5), FREE], r"about 1\.25e\+07 steps"),
        ([FREE, Set(Torque, "switched", False), Set(Torque, "inertia", 1e-7)], "shorter time, or more inertia$"),
        ([FREE, Set(Torque, "current", 0.0), Set(Torque, "friction", 1e3)], "expected at most 20000"),
        ([Set(Torque, "start", math.nan)], "start"),
    ],
)
def test_what_cannot_be_is_refused_in_words(commands, told):
    *before, last = commands
    state = opened(*before)
    with pytest.raises(InputError, match=told):
        apply(state, last)
