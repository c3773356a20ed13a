"""Power: chains with their products, a load that is held, the tables of numbers, and what is refused."""

import math

import pytest

from armlab.benches.drive.power.chains import CHAINS
from armlab.benches.drive.power.compared import COMPARISONS, COMPUTED, SOURCES, TYPICAL
from armlab.benches.drive.power.examples import EXAMPLES, ChoosePowerExample
from armlab.benches.drive.power.facts import FACTS
from armlab.benches.drive.power.state import SHOWN, Power
from armlab.benches.drive.power.ui.chain import table_markup
from armlab.benches.drive.power.ui.comparison import comparison_markup
from armlab.benches.drive.power.ui.holding import holding_markup, why_markup
from armlab.benches.drive.power.ui.sankey import sankey
from armlab.benches.drive.power.ui.system import robot_system
from armlab.benches.drive.quantities import prefixed, rpm
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.drive import DOMAINS, ripple
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.teaching.play import Player
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done
from support.forms import BareForm, asked


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def value(state, name):
    return FACTS.facts[name].now(state).value


@pytest.mark.parametrize("given", ["supply", "load"])
@pytest.mark.parametrize("kind", CHAINS)
def test_the_factors_of_every_place_make_its_power(kind, given):
    part = opened(Set(Power, "kind", kind), Set(Power, "given", given))[Power]
    chain = part.chain
    for passed in chain.passed:
        assert passed.effort * passed.flow == pytest.approx(passed.power)
    for before, after, eta in zip(chain.passed, chain.passed[1:], chain.efficiencies, strict=False):
        assert after.power == pytest.approx(eta * before.power)
    assert chain.efficiency == pytest.approx(math.prod(chain.efficiencies))
    assert sum(chain.losses) + chain.useful == pytest.approx(chain.supplied)
    if given == "load":
        last = chain.passed[-1]
        assert last.effort == pytest.approx(part.joint_torque if kind == "rotary" else part.force)


def test_the_hydraulic_chain_has_all_four_products():
    places = CHAINS["hydraulic"].places
    assert {place.domain for place in places} == set(DOMAINS)
    part = opened(ChoosePowerExample("hydraulic"))[Power]
    line = part.chain.passed[2]
    assert line.effort == pytest.approx(16e6)  # typed in MPa
    assert line.flow == pytest.approx(line.power / 16e6)


def test_the_picture_is_to_scale():
    chain = opened()[Power].chain
    text = str(sankey(chain))
    heights = [float(part.split('"')[0]) for part in text.split('height="')[1:]][-4:]
    full = heights[0]
    for height, passed in zip(heights, chain.passed, strict=True):
        assert height / full == pytest.approx(passed.power / chain.supplied, abs=0.002)
    assert "168 W from the supply, 101.7 W at the load, 66.26 W of heat" in text


def test_the_table_says_what_the_speeds_mean():
    text = str(joined(table_markup(BareForm(), opened()[Power])))
    assert "From these speeds follows a gear ratio of 100." in text
    assert "60.56 %" in text
    assert "advances" in str(joined(table_markup(BareForm(), opened(Set(Power, "kind", "linear"))[Power])))
    assert "a piston of" in str(joined(table_markup(BareForm(), opened(Set(Power, "kind", "hydraulic"))[Power])))


def test_a_factor_is_typed_at_its_place():
    part = opened()[Power]
    assert asked(lambda form: table_markup(form, part), "voltage", "24") == (Set(Power, "voltage", 24.0),)
    assert asked(lambda form: table_markup(form, part), "joint_torque", "3") == ()  # it follows from the supply
    with pytest.raises(InputError, match="efficiency of the motor"):
        asked(lambda form: table_markup(form, part), "eta_motor", "1.2")


def test_a_load_that_is_held_heats_the_motor_and_costs_the_others_nothing():
    state = opened(ChoosePowerExample("hold"))
    part = state[Power]
    assert value(state, "held_torque") == pytest.approx(2.0 * 9.80665 * 0.5)
    assert value(state, "held_heat") == pytest.approx(0.299 * (part.load / 50.0 / 0.0302) ** 2)
    assert value(opened(ChoosePowerExample("hold_100")), "held_heat") == pytest.approx(part.held.heat / 4.0)
    text = str(joined(holding_markup(part, units_of(state))))
    assert "12.61 W, all of it heat" in text
    assert "It may hold for ever" in text
    burns = opened(ChoosePowerExample("overheat"))
    assert value(burns, "held_rise") is None
    assert value(burns, "endures") is False
    assert "The winding burns" in str(joined(holding_markup(burns[Power], units_of(burns))))
    hot = apply(state, Set(Power, "limit", 100.0))
    assert "The winding gets too hot" in str(joined(holding_markup(hot[Power], units_of(hot))))


def test_the_winding_of_the_lesson_burns_in_every_variant_until_something_is_changed():
    """As its text says of the page, although the least of its loads is near the one that a winding could stand."""
    begun = {}
    for number in range(6):
        player = Player(lesson("power_actuators", number), planning=False)
        place = next(i for i, step in enumerate(player.lesson.steps) if step.title == "A winding that lasts")
        assert player.go_to(place) == ""
        begun[player.lesson.values["m"]] = value(player.session.state, "held_rise")
    assert begun == {3.5: None, 4: None, 4.5: None}


def test_a_leaking_valve_lets_the_load_sink():
    part = opened(Set(Power, "leak", 0.5))[Power]
    assert part.sinks * part.load == pytest.approx(10e6 * 0.5e-6)
    # Twice the mass in the same cylinder makes twice the pressure, and sinks as fast.
    heavy = opened(Set(Power, "leak", 0.5), Set(Power, "mass", 4.0), Set(Power, "pressure", 20.0))[Power]
    assert heavy.sinks == pytest.approx(part.sinks)
    assert "a heavier load has a larger cylinder and sinks more slowly" in str(why_markup())


@pytest.mark.parametrize("key", COMPARISONS)
def test_every_number_has_a_source(key):
    shown = COMPARISONS[key]
    for what, values in shown.rows:
        assert len(values) == len(shown.kinds), what
        for each in values:
            assert each.source in SOURCES or each.source <= TYPICAL
            assert any(sign.isdigit() for sign in each.text) or each.source not in (TYPICAL, *SOURCES)
    state = opened(Set(Power, "compared", key))
    assert "typical of the trade" in str(joined(comparison_markup(BareForm(), state[Power])))


def test_computed_numbers_of_the_tables_are_computed():
    every = [each for shown in COMPARISONS.values() for _, values in shown.rows for each in values]
    texts = [each.text for each in every if each.source == COMPUTED]
    assert f"{100.0 * ripple(13):.4f} %, 13 coils" in texts
    assert "980 kPa" in texts


def test_the_robot_as_a_system_names_its_four_units():
    text = str(robot_system())
    for unit in ("Supervision", "Actuation", "Mechanics", "Inner sensors", "Outer sensors"):
        assert unit in text


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_typed(key):
    state = opened(ChoosePowerExample(key))
    assert state[Power].example == key
    assert apply(state, Set(Power, "shown", "compare"))[Power].example == key
    assert apply(state, Set(Power, "current", 0.7))[Power].example == ""


def test_what_is_shown_is_no_step_of_undo():
    assert not Set(Power, "shown", "hold").undoable
    assert Set(Power, "voltage", 12.0).undoable
    assert set(SHOWN) == {"system", "chain", "hold", "compare"}


@pytest.mark.parametrize(
    ("name", "bad", "told"),
    [
        ("eta_motor", 1.01, "expected more than 0 and at most 1"),
        ("eta_motor", 0.0, "expected more than 0 and at most 1"),
        ("voltage", -1.0, "voltage"),
        ("kind", "steam", "steam"),
        ("mass", math.inf, "mass"),
    ],
)
def test_what_cannot_be_is_refused_and_the_old_state_stays(name, bad, told):
    state = opened()
    with pytest.raises(InputError, match=told):
        apply(state, Set(Power, name, bad))
    assert state[Power] == Power()


def test_quantities_have_the_prefix_that_leaves_them_readable():
    assert prefixed(999.96, "W") == "1 kW"
    assert prefixed(-2.5e-7, "V") == "−0.25 µV"
    assert prefixed(1.4e9, "Pa") == "1.4 GPa"
    assert rpm(100.0 * math.pi) == "3000 rpm"
