"""Power along a chain, and a load that is held still."""

import math

import pytest

from armlab.errors import InputError
from armlab.kin.drive import DOMAINS, holding, power_needed, powers_along, sinking
from armlab.kin.drive.power import COPPER, MELTING


def test_efficiencies_multiply_and_the_way_back_divides():
    powers = powers_along(200.0, [0.9, 0.8, 0.5])
    assert powers.tolist() == pytest.approx([200.0, 180.0, 144.0, 72.0])
    assert power_needed(float(powers[-1]), [0.9, 0.8, 0.5]) == pytest.approx(200.0)


def test_the_four_products_are_watts():
    units = {(each.effort_unit, each.flow_unit) for each in DOMAINS.values()}
    assert units == {("V", "A"), ("Pa", "m³/s"), ("N", "m/s"), ("N m", "rad/s")}


def test_holding_costs_the_square_of_the_torque():
    one, two = holding(10.0, 50.0, 0.03, 0.3), holding(20.0, 50.0, 0.03, 0.3)
    assert one.torque == pytest.approx(0.2)
    assert one.current == pytest.approx(0.2 / 0.03)
    assert one.heat == pytest.approx(0.3 * one.current**2)
    assert two.heat == pytest.approx(4.0 * one.heat)
    assert holding(10.0, 100.0, 0.03, 0.3).heat == pytest.approx(one.heat / 4.0)


def test_the_winding_ends_where_the_grown_resistance_makes_the_heat_that_leaves():
    found = holding(10.0, 50.0, 0.03, 0.3, 4.0)
    grown = 0.3 * (1.0 + COPPER * found.rise)
    assert found.rise == pytest.approx(4.0 * grown * found.current**2)
    assert math.isinf(holding(30.0, 50.0, 0.03, 0.3, 4.0).rise)


@pytest.mark.parametrize("share", [0.99, 1.0, 1.01])
def test_no_winding_ends_hotter_than_copper_melts(share):
    """Near the load at which the temperature has no end the formula alone would give any number of kelvins."""
    runaway = 50.0 * 0.03 / math.sqrt(COPPER * 4.0 * 0.3)
    assert math.isinf(holding(share * runaway, 50.0, 0.03, 0.3, 4.0).rise)
    assert 500.0 < holding(0.85 * runaway, 50.0, 0.03, 0.3, 4.0).rise < MELTING


def test_a_leaking_valve_lets_the_load_pay():
    assert sinking(10.0, 1e7, 2e-8) * 10.0 == pytest.approx(1e7 * 2e-8)
    assert sinking(10.0, 1e7, 0.0) == 0.0


@pytest.mark.parametrize("bad", [0.0, -0.1, 1.1, math.nan])
def test_no_efficiency_makes_power_from_nothing(bad):
    with pytest.raises(InputError, match="efficiency of converter 2: expected more than 0 and at most 1"):
        powers_along(1.0, [0.5, bad])


def test_powers_are_positive():
    with pytest.raises(InputError, match="power: expected a positive number"):
        powers_along(0.0, [0.5])
    with pytest.raises(InputError, match="k: expected a positive number"):
        holding(1.0, 1.0, 0.0, 1.0)
