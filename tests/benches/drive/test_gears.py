"""The page of gears: its wheels turn as it says, powers and the best ratio, and what is refused."""

import math
import re
from functools import partial

import numpy as np
import pytest

from armlab.benches.drive.gears.clip import CLIP
from armlab.benches.drive.gears.examples import EXAMPLES, ChooseGearExample
from armlab.benches.drive.gears.facts import FACTS
from armlab.benches.drive.gears.film import DURATION, TURN, angles_at, slowed
from armlab.benches.drive.gears.kinds import KINDS
from armlab.benches.drive.gears.stage import around, stage_of
from armlab.benches.drive.gears.state import (
    AddWheel,
    ArrangeWheels,
    Gears,
    RemoveWheel,
    SetTeeth,
    SetWheels,
    TakeRatio,
)
from armlab.benches.drive.gears.ui.best import TorqueChart, best_markup, chart, heights, span
from armlab.benches.drive.gears.ui.kinds import kinds_markup
from armlab.benches.drive.gears.ui.scene import drawn_places, end_of, level_of
from armlab.benches.drive.gears.ui.solids import circle_beside, ring
from armlab.benches.drive.gears.ui.train import train_markup
from armlab.benches.drive.gears.ui.wheel import wheel_glb
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.drive.best_ratio import motor_torque
from armlab.kin.drive.tooth import ADDENDUM, outline
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.session import Asked
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.bare_gui import BareGui
from support.done import done
from support.forms import BareForm


def opened(*commands, arm="planar_2r"):
    return done(State.initial(catalogue()[arm]), *commands)


def value(name, state):
    return FACTS.facts[name].now(state).value


def train_of(form, state):
    return joined(train_markup(form, state, units_of(state)))


def best_of(form, state):
    return joined(best_markup(form, state[Gears], TorqueChart(BareGui())))


def said(markup, state):
    return str(markup(BareForm(), state))


def filled(markup, cell, text, state):
    """Return the state after a control was filled or pressed."""
    form = BareForm()
    form.show(markup(form, state))
    form.press(cell, text)
    (asked,) = form.posted
    for command in asked.commands if isinstance(asked, Asked) else (asked,):
        state = apply(state, command)
    return state


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_changed(key):
    state = opened(ChooseGearExample(key))
    assert state[Gears].example == key
    assert state[Gears] == EXAMPLES[key].part
    assert apply(state, Set(Gears, "torque", 0.321))[Gears].example == ""
    # What is looked at is no change.
    assert apply(state, Set(Gears, "shown", "kinds"))[Gears].example == key


def test_the_first_page_shows_its_example():
    assert opened()[Gears].example == "pair"
    assert opened()[Gears] == EXAMPLES["pair"].part


def test_sentences_of_examples_are_true():
    assert value("train_ratio", opened(ChooseGearExample("idler"))) == pytest.approx(2.0)
    assert value("train_ratio", opened(ChooseGearExample("four"))) == pytest.approx(-3.0)
    assert value("train_ratio", opened(ChooseGearExample("stages"))) == pytest.approx(16.0)
    assert value("best_ratio", opened(ChooseGearExample("best"))) == pytest.approx(20.0)
    assert value("best_ratio", opened(ChooseGearExample("weight"))) == pytest.approx(40.0)
    falling = opened(ChooseGearExample("falling"))
    assert value("best_ratio", falling) == pytest.approx(17.3, abs=0.05)
    assert motor_torque(falling[Gears].load, 10.0) < 0.0 < motor_torque(falling[Gears].load, 30.0)
    assert "Wheel 1: undercut" in said(train_of, opened(ChooseGearExample("few")))


def test_the_ideal_gear_has_the_numbers_of_the_notes(truth):
    expected = truth["C2.2-ideal-gear"]["expected"]
    state = opened(ChooseGearExample("ideal"))
    assert value("load_speed", state) == pytest.approx(expected["theta_dot_u"])
    assert value("torque_on_load", state) == pytest.approx(expected["tau_u"])
    assert value("load_power", state) == pytest.approx(expected["P"])
    assert value("lost", state) == 0.0


def test_a_mesh_costs_two_per_cent_and_the_card_says_so():
    state = opened(ChooseGearExample("stages"))
    assert value("efficiency", state) == pytest.approx(0.98**2)
    assert value("lost", state) == pytest.approx((1.0 - 0.98**2) * value("motor_power", state))
    assert "2 meshes: η = 96.04 %" in said(train_of, state)
    braking = apply(state, Set(Gears, "torque", -0.2))
    assert value("lost", braking) > 0.0
    assert "the load drives the motor" in said(train_of, braking).lower()


def test_the_residual_of_the_printed_derivative_is_seen(truth):
    """Erratum 2.38: at the minimum the printed formula gives 0.06, the corrected one and the differences nothing."""
    state = opened(ChooseGearExample("best"), TakeRatio("best"))
    assert value("ratio", state) == 20.0
    assert value("motor_torque", state) == pytest.approx(truth["C2.2-opt-ratio"]["expected"]["tau_min"])
    assert value("slope", state) == pytest.approx(0.0, abs=1e-15)
    assert value("slope_measured", state) == pytest.approx(0.0, abs=1e-9)
    assert value("slope_with_plus", state) == pytest.approx(0.06)
    text = said(best_of, state)
    assert "n* = 20 with τₘ = 1.2 N m" in text
    assert "⟦(2.38) prints a plus: Jₘ a + (Jᵤ a + τ<sub>L</sub>)/n² would be 0.06 N m, and zero nowhere." in text
    assert "Jₘ + Jᵤ/n² = 20 g m²" in text


@pytest.mark.parametrize(
    ("commands", "number", "nowhere"),
    [
        ((ChooseGearExample("weight"),), "0.51 N m", True),  # 0.01 · 3 + (4 · 3 + 36)/10²
        ((ChooseGearExample("falling"), TakeRatio("best")), "N m", False),
        ((ChooseGearExample("best"), Set(Gears, "acceleration", 0.0)), "0 N m", False),
    ],
)
def test_the_derivative_with_a_plus_is_that_of_the_formula_beside_it(commands, number, nowhere):
    text = said(best_of, opened(*commands))
    (wrong,) = re.findall(r"\+ τ<sub>L</sub>\)/n² would be ([^⟧]*)⟧", text)
    assert wrong.split(". The sign")[0].endswith(f"{number}{', and zero nowhere' if nowhere else ''}")


def test_the_card_says_when_there_is_no_best_ratio():
    steady = opened(Set(Gears, "load_torque", 5.0), Set(Gears, "acceleration", 0.0))
    assert "at rest or at constant speed: the larger n, the smaller" in said(best_of, steady)
    # 0.7 kg m² times 0.1 rad/s² are 0.07 N m, but for rounding.
    load = (Set(Gears, "load_inertia", 0.7), Set(Gears, "acceleration", 0.1), Set(Gears, "load_torque", -0.07))
    assert value("best_ratio", opened(*load)) == 0.0
    assert "alone gives it this acceleration: the smaller n, the smaller" in said(best_of, opened(*load))
    assert "Nothing is accelerated" in said(best_of, opened(Set(Gears, "acceleration", 0.0)))
    assert "n* = 17.32: no torque at all" in said(best_of, opened(ChooseGearExample("falling")))
    with pytest.raises(InputError, match="ratio"):
        opened(Set(Gears, "load_torque", 5.0), Set(Gears, "acceleration", 0.0), TakeRatio("best"))


@pytest.mark.parametrize("key", ["best", "weight", "falling"])
def test_the_chart_marks_the_least_torque(key):
    part = opened(ChooseGearExample(key))[Gears]
    low, high = span(part)
    assert low < min(part.ratio, part.best.ratio) < max(part.ratio, part.best.ratio) < high
    ratios = np.geomspace(low, high, 2001)
    torque = motor_torque(part.load, ratios)
    assert ratios[np.argmin(np.abs(torque))] == pytest.approx(part.best.ratio, rel=0.01)
    least, most = heights(part, torque)
    assert least <= part.best.torque <= most
    picture = str(chart(part))
    assert 'class="gr-best"' in picture
    assert 'class="gr-at"' in picture


def test_a_click_in_the_chart_chooses_the_ratio():
    state = opened(ChooseGearExample("best"))
    low, high = span(state[Gears])
    left = filled(best_of, "chart", "0.125,0.5", state)[Gears].ratio
    right = filled(best_of, "chart", "1,0.5", state)[Gears].ratio
    assert left == pytest.approx(low, rel=0.01)
    assert right == pytest.approx(high, rel=0.01)
    assert filled(best_of, "take train", "", state)[Gears].ratio == 2.0


def test_a_chart_of_nothing_can_be_drawn():
    for changes in ({"acceleration": 0.0}, {"acceleration": 0.0, "load_torque": 5.0}, {"load_torque": -12.0}):
        state = opened(*(Set(Gears, name, value) for name, value in changes.items()))
        assert "nan" not in str(chart(state[Gears]))


def test_the_curves_are_saved_with_their_units():
    gui, form = BareGui(), BareForm()
    saved = {}
    gui.save = saved.__setitem__
    part = opened(ChooseGearExample("best"))[Gears]
    form.show(joined(best_markup(form, part, TorqueChart(gui))))
    form.press("csv")
    head, *rows = saved["best_ratio.csv"].splitlines()
    assert head == 'n,"of the motor itself, N m",n,"of the load, N m",n,"torque of the motor, N m"'
    n, own, _, other, _, both = (float(each) for each in rows[50].split(","))
    assert both == pytest.approx(own + other)
    assert own == pytest.approx(0.03 * n)


def test_what_is_drawn_turns_with_the_ratio_and_the_sense_that_the_page_says():
    for key in ("pair", "idler", "four", "stages"):
        part = EXAMPLES[key].part
        moved = angles_at(part, TURN) - angles_at(part, 0.0)
        np.testing.assert_allclose(moved, 2.0 * math.pi * part.train.turns, rtol=0, atol=1e-12)
        assert moved[0] / moved[-1] == pytest.approx(part.train.ratio)
    backwards = apply(opened(), Set(Gears, "speed", -10.0))[Gears]
    assert angles_at(backwards, 1.0)[0] < 0.0
    still = apply(opened(), Set(Gears, "speed", 0.0))[Gears]
    assert (angles_at(still, 1.0) == angles_at(still, 0.0)).all()
    assert slowed(EXAMPLES["pair"].part) == pytest.approx(200.0)


def test_a_motor_slower_than_its_film_is_sped_up():
    """The first wheel of the film turns at 90°/s = 1.57 rad/s."""
    for speed, words in ((1.0, "sped up 1.6 times"), (-1.0, "sped up 1.6 times"), (0.0, "the motor stands still")):
        assert f"times as large, and {words}." in said(train_of, opened(Set(Gears, "speed", speed)))
    assert "slowed down 200 times" in said(train_of, opened(ChooseGearExample("pair")))


def test_the_film_stops_after_each_turn_and_starts_again_when_a_wheel_is_changed():
    state = opened(OpenClip("gears"), Seek(5.0))
    assert CLIP.duration(state) == DURATION
    assert CLIP.stops(state) == (4.0, 8.0)
    assert apply(state, SetTeeth(0, 20))[Timeline].time == 0.0


@pytest.mark.parametrize("arm", ["planar_2r", "puma560", "scara", "ur3e"])
@pytest.mark.parametrize("key", ["pair", "four", "stages", "few"])
def test_the_train_fits_into_what_the_camera_is_asked_to_show(key, arm):
    state = opened(ChooseGearExample(key), arm=arm)
    part, stage = state[Gears], stage_of(state)
    places, modules, scale = drawn_places(part, stage.radius)
    tips = (0.5 * np.array(part.teeth) + ADDENDUM) * modules
    corners = (around(state) - stage.centre) @ stage.axes
    assert (places - tips).min() > corners[:, 0].min()
    assert (places + tips).max() < corners[:, 0].max()
    assert tips.max() < corners[:, 1].max()
    for i, j in part.train.meshes:
        apart = 0.5 * modules[i] * (part.teeth[i] + part.teeth[j])
        assert places[j] - places[i] == pytest.approx(apart)
        assert level_of(part, i) == level_of(part, j)
    assert scale > 0.0
    np.testing.assert_allclose(stage.axes.T @ stage.axes, np.eye(3), rtol=0, atol=1e-12)


def test_names_tell_the_ends_of_the_train():
    part = EXAMPLES["idler"].part
    assert [end_of(part, k) for k in range(3)] == ["motor: ", "", "load: "]


def test_a_wheel_is_a_closed_solid_with_its_teeth():
    edge = outline(20)
    solid = ring(edge, circle_beside(edge, 4.0), 1.0)
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    volume = float(np.einsum("ki,ki->k", a, np.cross(b, c)).sum()) / 6.0
    area = 0.5 * float(np.sum(edge[:, 0] * np.roll(edge[:, 1], -1) - edge[:, 1] * np.roll(edge[:, 0], -1)))
    inner = circle_beside(edge, 4.0)
    hole = 0.5 * float(np.sum(inner[:, 0] * np.roll(inner[:, 1], -1) - inner[:, 1] * np.roll(inner[:, 0], -1)))
    assert volume == pytest.approx(area - hole, rel=1e-9)
    # Every face looks outwards, as its vertices say.
    normals = np.cross(b - a, c - a)
    assert (np.einsum("ki,ki->k", normals, solid.normals[solid.faces[:, 0]]) >= -1e-12).all()
    assert wheel_glb(12, 0)[:4] == b"glTF"
    assert len(wheel_glb(200, 1)) < 900_000


def test_wheels_are_added_removed_and_arranged():
    state = opened(AddWheel())
    assert state[Gears].teeth == (18, 36, 30)
    stages = apply(state, ArrangeWheels("compound"))
    assert (stages[Gears].teeth, stages[Gears].layout) == ((18, 36, 30, 18), "compound")
    fewer = apply(stages, RemoveWheel())
    assert (fewer[Gears].teeth, fewer[Gears].layout) == ((18, 36, 30), "row")
    assert value("wheels", fewer) == 3
    assert apply(state, SetWheels((20, 60, 15, 45), "compound"))[Gears].train.ratio == pytest.approx(9.0)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetTeeth(1, 0), "teeth of wheel 2: expected a whole number from 6 to 200, got 0"),
        (SetTeeth(0, 1), "teeth of wheel 1: expected a whole number from 6 to 200, got 1"),
        (SetTeeth(0, 20.5), "teeth of wheel 1: expected a whole number from 6 to 200, got 20.5"),
        (SetTeeth(5, 20), "wheel: expected 1 to 2, got 6"),
        (SetWheels((20,) * 30), "a train has 2 to 4 wheels, got 30"),
        (SetWheels((20, 40), "compound"), "two stages have 4 wheels, got 2"),
        (RemoveWheel(), "a train has 2 to 4 wheels, got 1"),
        (ArrangeWheels("pile"), "pile"),
        (Set(Gears, "ratio", 0.0), "ratio"),
        (Set(Gears, "load_inertia", -1.0), "load_inertia"),
        (Set(Gears, "efficiency", 0.0), "efficiency"),
        (TakeRatio("nothing"), "expected train or best"),
    ],
)
def test_what_cannot_be_is_refused_and_the_old_state_stays(command, told):
    state = opened()
    with pytest.raises(InputError, match=told):
        apply(state, command)
    assert state[Gears] == EXAMPLES["pair"].part


@pytest.mark.parametrize(
    ("markup", "cell", "text", "told"),
    [
        (train_of, "teeth 1", "0", r"z₂ \(teeth of wheel 2\): expected a whole number from 6 to 200, got '0'"),
        (train_of, "teeth 0", "17.5", r"z₁ \(teeth of wheel 1\): expected a whole number from 6 to 200, got '17.5'"),
        (train_of, "distance", "-3", r"a₁₂ \(centre distance of the first pair\): expected a number in mm from 1 to"),
        (train_of, "efficiency", "1.2", "expected a number greater than 0 and at most 1, got '1.2'"),
        (best_of, "load_inertia", "-4", "moment of inertia of the load"),
        (best_of, "ratio", "0", r"n \(ratio that is looked at\): expected a number from 0.01 to 100000, got '0'"),
    ],
)
def test_a_field_says_what_it_expects(markup, cell, text, told):
    with pytest.raises(InputError, match=told):
        filled(markup, cell, text, opened())


def test_lengths_are_read_in_the_unit_on_screen():
    assert filled(train_of, "distance", "60", opened())[Gears].distance == pytest.approx(0.06)
    metres = opened(Set(Notation, "length", "m"))
    assert filled(train_of, "distance", "0.06", metres)[Gears].distance == pytest.approx(0.06)
    assert filled(train_of, "teeth 1", "40", opened())[Gears].teeth == (18, 40)


def test_every_kind_of_transmission_has_typical_numbers_and_its_trouble():
    assert {"spur", "bevel", "screw", "worm", "belt", "chain", "harmonic", "shaft"} <= set(KINDS)
    state = opened()
    for key, kind in KINDS.items():
        assert all((kind.ratio, kind.efficiency, kind.play, kind.drives_back, kind.use, kind.trouble))
        shown = filled(lambda form, state: joined(kinds_markup(form, state[Gears])), f"kind {key}", "", state)
        assert kind.trouble in str(joined(kinds_markup(BareForm(), shown[Gears])))
    # A key from a link that is none is no reason to fail.
    assert "Spur gears" in str(joined(kinds_markup(BareForm(), Gears(kind="magic"))))


def test_facts_have_their_units():
    state = opened()
    value_of = partial(value, state=state)
    assert value_of("module") == pytest.approx(0.002)
    assert value_of("teeth") == (18.0, 36.0)
    assert value_of("turns") == (1.0, -0.5)
    assert value_of("inertia_at_motor") == pytest.approx(0.01 + 4.0 / 100.0)
