"""The page of the DC motor: profiles, units of data sheets, examples, what is shown, the twins, and what is refused."""

import math
from itertools import pairwise

import numpy as np
import pytest

from armlab.benches.drive.motor.clip import CLIP
from armlab.benches.drive.motor.examples import EXAMPLES, SHEET, ChooseMotorExample
from armlab.benches.drive.motor.facts import FACTS, balance_of, moment_of
from armlab.benches.drive.motor.profile import RAMP, Profile, pieces_of, read_rows
from armlab.benches.drive.motor.sheets import in_units, read
from armlab.benches.drive.motor.state import CLIP_KEY, Motor
from armlab.benches.drive.motor.twins import twins_of
from armlab.benches.drive.motor.ui.blocks import diagram
from armlab.benches.drive.motor.ui.form import constants_markup, inputs_markup
from armlab.benches.drive.motor.ui.plots import response_of
from armlab.benches.drive.motor.ui.poles import functions_markup, plane, poles_markup
from armlab.benches.drive.motor.ui.powers import powers_markup, units_markup
from armlab.benches.drive.motor.ui.scene import slowed, torque_marks
from armlab.benches.drive.motor.ui.twins import state_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.drive import Piece, run
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.bare_gui import BarePage
from support.done import done
from support.forms import asked


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def at(time, *commands):
    return opened(*commands, OpenClip(CLIP_KEY), Seek(time))


def value(state, name):
    return FACTS.facts[name].now(state).value


def said(*markup):
    return str(joined(*markup))


# -- voltage and load over time --------------------------------------------------------------------------------------


def test_profiles_are_made_of_jumps():
    rows = ((0.1, 3.0), (0.2, -1.0))
    assert Profile("step", 12.0, 0.0, 0.0, ()).jumps() == ((0.0, 12.0),)
    assert Profile("step", 12.0, 0.1, 0.0, ()).jumps() == ((0.0, 0.0), (0.1, 12.0))
    assert Profile("pulse", 2.0, 0.1, 0.3, ()).jumps() == ((0.0, 0.0), (0.1, 2.0), (0.3, 0.0))
    assert Profile("own", 0.0, 0.0, 0.0, rows).jumps() == ((0.0, 0.0), *rows)
    ramp = Profile("ramp", 10.0, 0.0, 1.0, ()).jumps()
    assert len(ramp) == RAMP + 1
    # The steps have the area of the ramp, and end at its height.
    area = sum(after[0] * before[1] - before[0] * before[1] for before, after in pairwise(ramp))
    assert area == pytest.approx(5.0)
    assert ramp[-1] == (1.0, 10.0)


def test_pieces_change_when_voltage_or_load_do_and_end_with_the_run():
    voltage, load = Profile("pulse", 12.0, 0.0, 0.2, ()), Profile("step", 0.1, 0.1, 0.0, ())
    pieces = pieces_of(voltage, load, 0.3)
    expected = [Piece(0.1, 12.0, 0.0), Piece(0.1, 12.0, 0.1), Piece(0.1, 0.0, 0.1)]
    for found, wanted in zip(pieces, expected, strict=True):
        assert found.duration == pytest.approx(wanted.duration)
        assert (found.voltage, found.load) == (wanted.voltage, wanted.load)
    assert pieces_of(voltage, load, 0.05) == (Piece(0.05, 12.0, 0.0),)


@pytest.mark.parametrize(
    ("rows", "told"),
    [
        ([], "expected 1 to 40 lines"),
        ([(0.0, 1.0)] * 41, "expected 1 to 40 lines"),
        ("", "expected 1 to 40 lines"),
        ("0 12; soon 3", "line 2: expected a time in s and a value, got 'soon 3'"),
        ([(0.0,)], "line 1: expected a time in s and a value"),
        ([(0.0, 1.0), (0.0, 2.0)], "line 2: expected a time after 0 s, got 0 s"),
        ([(-1.0, 1.0)], "line 1: expected a time from 0 s on"),
        ([(0.0, math.inf)], "line 1"),
        ([(0.0, True)], "line 1"),
    ],
)
def test_lines_that_are_no_profile_are_refused(rows, told):
    with pytest.raises(InputError, match=told):
        read_rows(rows)


# -- units -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("R", "0.299", 0.299),
        ("R", "299 mΩ", 0.299),
        ("R", "299 m\u2126", 0.299),
        ("L", "0.082 mH", 8.2e-5),
        ("L", "82 uH", 8.2e-5),
        ("J", "142 gcm²", 1.42e-5),
        ("J", "142 g cm^2", 1.42e-5),
        ("J", "1,42e-5 kg m2", 1.42e-5),
        ("k", "30.2 mNm/A", 0.0302),
        ("k", "3.1625 V/krpm", 0.0302),
        ("k", "316.2 rpm/V", 0.0302),
        ("k", "1/20 V s/rad", 0.05),
        ("F", "−1e-6", -1e-6),
    ],
)
def test_constants_are_read_in_the_units_of_data_sheets(name, text, expected):
    assert read(name, "x", text) == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize(("name", "text"), [("R", "abc"), ("J", "5 kg"), ("k", "0 rpm/V"), ("L", ""), ("k", "5 V/rad")])
def test_other_units_are_refused_with_those_there_are(name, text):
    with pytest.raises(InputError, match="x: expected a number in"):
        read(name, "x", text)


def test_fields_take_units_of_data_sheets_and_refuse_in_the_range_of_the_constant():
    part = opened()[Motor]

    def typed(cell, text):
        return asked(lambda form: constants_markup(form, part), cell, text)

    assert typed("L", "0.5 mH") == (Set(Motor, "L", 0.0005),)
    assert typed("L", "0") == (Set(Motor, "L", 0.0),)
    with pytest.raises(InputError, match=r"R_a \(resistance of the winding\): expected a number in Ω greater than 0"):
        typed("R", "-1")
    with pytest.raises(InputError, match=r"I_m \(moment of inertia\): .*greater than 0"):
        typed("J", "0 g cm²")


def test_a_profile_is_typed_in_lines():
    part = opened(Set(Motor, "v_kind", "own"))[Motor]

    def typed(text):
        return asked(lambda form: inputs_markup(form, part), "v_rows", text)

    (command,) = typed("0 12\n0,1  −6; 0.2 0")
    assert apply(opened(), command)[Motor].v_rows == ((0.0, 12.0), (0.1, -6.0), (0.2, 0.0))
    (wrong,) = typed("0 12\n0.1")
    with pytest.raises(InputError, match="line 2: expected a time in s and a value"):
        apply(opened(), wrong)


@pytest.mark.parametrize("kind", ["ramp", "pulse"])
@pytest.mark.parametrize("name", ["v", "load"])
def test_a_ramp_or_pulse_that_is_chosen_ends_after_the_start_that_was_typed_for_a_step(name, kind):
    state = opened(Set(Motor, f"{name}_start", 0.15))

    def chosen(state, kind):
        (command,) = asked(lambda form: inputs_markup(form, state[Motor]), f"{name}_kind", kind)
        return apply(state, command)

    assert getattr(chosen(state, kind)[Motor], f"{name}_stop") == pytest.approx(0.25)
    typed = opened(Set(Motor, f"{name}_start", 0.02))
    assert getattr(chosen(typed, kind)[Motor], f"{name}_stop") == getattr(Motor(), f"{name}_stop")
    assert chosen(state, "step") is state


def test_one_constant_in_the_units_of_data_sheets():
    found = in_units(0.05)
    assert found["V/krpm"] == pytest.approx(0.05 * 1000.0 * 2.0 * math.pi / 60.0)
    assert found["rpm/V"] == pytest.approx(1000.0 / found["V/krpm"])
    text = said(units_markup(at(0.05)))
    assert "5.236 V/krpm" in text
    assert "104.7 times as large" in text


# -- examples --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_typed(key):
    state = opened(ChooseMotorExample(key))
    assert state[Motor].example == key
    assert apply(state, Set(Motor, "shown", "power"))[Motor].example == key
    assert apply(state, Set(Motor, "R", 1.25))[Motor].example == ""
    assert np.isfinite(state[Motor].run.states).all()


def test_the_data_sheet_comes_out():
    motor = opened(ChooseMotorExample("maxon"))[Motor].motor
    current, speed = motor.steady(24.0)
    assert float(speed) == pytest.approx(SHEET["speed"], rel=2e-3)
    assert float(current) == pytest.approx(SHEET["current"], rel=5e-3)
    assert motor.stalled(24.0) == pytest.approx((SHEET["stall_current"], SHEET["stall_torque"]), rel=2e-3)
    rated = opened(ChooseMotorExample("rated"))
    assert value(rated, "steady_current") == pytest.approx(6.0, rel=5e-3)


def test_the_examples_show_what_they_say():
    assert value(opened(ChooseMotorExample("swinging")), "damping") < 0.2
    assert value(opened(ChooseMotorExample("swinging")), "poles_real") == pytest.approx((-5.1, -5.1))
    stalled = opened(ChooseMotorExample("stalled"))
    assert value(stalled, "steady_speed") == pytest.approx(0.0, abs=1e-9)
    assert value(stalled, "copper") == pytest.approx(120.0, rel=2e-3)
    assert value(opened(ChooseMotorExample("generator")), "supplied") < -50.0
    assert value(opened(ChooseMotorExample("no_inductance")), "order") == 1
    assert value(opened(ChooseMotorExample("no_inductance")), "damping") is None
    heavy = value(opened(ChooseMotorExample("heavy")), "mechanical_constant")
    assert heavy == pytest.approx(100.0 * value(opened(), "mechanical_constant"))
    ramp, step = (opened(ChooseMotorExample(key)) for key in ("ramp", "twins"))
    assert value(ramp, "peak_current") < 0.3 * value(step, "peak_current")


# -- what is shown ---------------------------------------------------------------------------------------------------


def test_without_its_film_the_page_shows_the_end_and_with_it_the_time():
    assert value(opened(), "time") == 0.2
    state = at(0.005)
    assert value(state, "speed") == pytest.approx(11.873038510584683, abs=1e-7)
    assert moment_of(state).i == pytest.approx(9.214362602804805, abs=1e-7)


def test_the_film_stops_where_something_changes_and_after_time_constants():
    state = opened(ChooseMotorExample("own"))
    stops = CLIP.stops(state)
    assert stops[:4] == pytest.approx((0.1, 0.15, 0.2, 0.4))
    assert CLIP.duration(state) == 0.6
    assert all(0.0 < stop < 0.6 for stop in stops)


def test_the_diagram_has_the_values_of_the_moment_and_the_loop_inside():
    state = at(0.005)
    text = said(diagram(state[Motor].motor, moment_of(state), units_of(state)))
    for shown in ("12 V", "9.214 A", "460.7 mN m", "11.87 rad/s", "593.7 mV", "100 mN m", "1.2°"):
        assert shown in text
    assert "inside of the motor" in text
    assert "1/R" in said(
        diagram(opened(ChooseMotorExample("no_inductance"))[Motor].motor, moment_of(state), units_of(state))
    )


def test_the_poles_are_told_with_their_approximations():
    text = said(poles_markup(opened()[Motor]))
    assert "−578.4" in text
    assert "3.74 %" in text
    assert "105.2 times as fast" in said(functions_markup(opened()[Motor]))
    swinging = said(poles_markup(opened(ChooseMotorExample("swinging"))[Motor]))
    assert "−5.1 + 49.76 j" in swinging
    assert "oscillating: damping ratio 0.102" in swinging
    assert "One pole" in said(poles_markup(opened(ChooseMotorExample("no_inductance"))[Motor]))
    assert said(plane(opened()[Motor].motor)).count("mo-pole") == 2


@pytest.mark.parametrize(
    ("constants", "settled"),
    [
        ({"J": 142.0}, True),
        ({"F": 0.0, "k": 1e-4}, True),
        ({"R": 1e-3, "L": 1e3, "J": 1e-9, "F": 1e3}, False),
        ({"R": 1e-9, "F": 0.0, "k": 1.0}, False),
        ({}, True),
    ],
)
def test_responses_are_drawn_however_far_apart_the_poles_are(constants, settled):
    page = BarePage("motor", catalogue()["planar_2r"])
    for name, each in {**constants, "shown": "poles"}.items():
        page.session.apply(Set(Motor, name, each), 0.0)
    page.show()
    motor = page.session.state[Motor].motor
    drawn, duration = response_of(motor)
    assert not motor.reduced
    for piece, gain in ((Piece(duration, 1.0, 0.0), motor.voltage_gain), (Piece(duration, 0.0, 1.0), motor.load_gain)):
        found = run(drawn, [piece])
        assert np.isfinite(found.omega).all()
        if settled:
            assert found.omega[-1] == pytest.approx(gain, rel=5e-3)


def test_time_constants_are_paired_with_the_poles_of_their_size():
    """With F = 1 the rotor alone settles in J/F = 0.1 ms, faster than the current: R F = 1.2 is far above k²."""
    state = opened(Set(Motor, "F", 1.0))
    fast, slow = state[Motor].motor.poles.real.tolist()
    worst = max(abs(10020.83 / -fast - 1.0), abs(600.0 / -slow - 1.0))
    assert value(state, "approximation") == pytest.approx(worst, rel=1e-3)
    assert worst < 0.01
    rows = said(poles_markup(state[Motor])).split("<tr")
    (electrical,) = (row for row in rows if "electrical, L/R" in row)
    assert "−601.3" in electrical


def test_powers_are_told_and_balance():
    state = at(0.05)
    assert "Generator: " in said(powers_markup(opened(ChooseMotorExample("generator"))))
    found = balance_of(state)
    assert abs(found.electrical_rest) < 1e-12
    assert "of v i reach the load now" in said(powers_markup(state))
    held = at(0.0, Set(Motor, "i0", 10.0), Set(Motor, "load", 0.5))
    assert "The rotor stands: all of v i is heat" in said(powers_markup(held))
    filling = at(0.0, Set(Motor, "i0", 5.0), Set(Motor, "load", 0.5))
    assert balance_of(filling).magnetic == pytest.approx(0.5 * balance_of(filling).supplied)
    assert "The rotor stands: v i becomes heat and fills the field" in said(powers_markup(filling))
    assert "The powers balance" in said(powers_markup(at(0.0)))


def test_the_twins_tell_which_vector_is_the_state():
    state = opened(ChooseMotorExample("twins"))
    found = twins_of(state)
    assert found.printed == 0.0
    assert found.right == pytest.approx(1.0)
    assert found.position == pytest.approx(1.0)
    # With the printed vector B u stays, v/L = 12/0.002; with the right one what a difference quotient leaves.
    assert found.printed_rest == pytest.approx(6000.0, rel=1e-6)
    assert found.right_rest < 1e-4
    assert "The state is (i, ω, θ)" in said(state_markup(state))
    assert "Both motors are one" in said(state_markup(apply(state, Set(Motor, "twin", 0.0))))
    reduced = twins_of(opened(Set(Motor, "L", 0.0)))
    assert reduced.printed == 0.0
    assert reduced.right_rest < 1e-4 * reduced.printed_rest


def test_a_fast_motor_is_drawn_slower_and_its_torques_as_arcs():
    part = opened()[Motor]
    assert slowed(part) == 100.0
    assert slowed(opened(Set(Motor, "v", 0.1), Set(Motor, "load", 0.0))[Motor]) == 1.0
    marks = torque_marks(part, part.run.at(0.005), np.zeros(3))
    assert marks["motor"].label == "motor: 460.7 mN m"
    assert marks["load"].label == "load: 100 mN m"
    (_, tip, _), (_, against, _) = marks["motor"].arrows[0], marks["load"].arrows[0]
    assert tip[0] > 0.0 > against[0]  # the load pulls the other way round
    assert torque_marks(part, part.run.at(0.0), np.zeros(3))["motor"].arrows == []


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"R": -1.0}, "R: expected more than 0"),
        ({"R": 0.0}, "R: expected more than 0"),
        ({"J": 0.0}, "J: expected more than 0"),
        ({"J": 1e-18}, "without any of them it is no motor"),
        ({"L": -1.0}, "L: expected at least 0"),
        ({"end": math.inf}, "end: expected finite numbers"),
        ({"end": 1e5}, "end: expected at least 1e-05 s and at most 600 s"),
        ({"L": 1e-8, "end": 100.0}, "take L = 0, the model without inductance, or a shorter time"),
        ({"v_start": 0.2, "v_kind": "pulse"}, "voltage: expected an end after the start 0.2 s, got 0.1 s"),
        ({"load_start": 0.2, "load_kind": "ramp"}, "load: expected an end after"),
        ({"v_rows": ((0.0, 1.0), (0.0, 2.0))}, "line 2"),
        ({"v_kind": "sine"}, "sine"),
    ],
)
def test_what_cannot_be_is_refused_and_the_old_state_stays(changes, told):
    *before, last = [Set(Motor, name, each) for name, each in changes.items()]
    state = opened(*before)
    with pytest.raises(InputError, match=told):
        apply(state, last)


def test_a_saved_motor_comes_back():
    state = opened(ChooseMotorExample("own"))
    again = Motor.from_json(state[Motor].to_json(), catalogue()["planar_2r"])
    assert again == state[Motor]
