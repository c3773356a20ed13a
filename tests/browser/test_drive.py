"""Drives in a browser: power to scale, a coil that turns, and a motor that is typed, played and looked at large."""

import pytest

pytestmark = pytest.mark.browser

SEEN_COILS = """() => {
  const nodes = Object.entries(window.__viserMutable.nodeRefFromName);
  const coils = nodes.filter(([name, node]) => /\\/coils\\/rotor\\/coil\\d+$/.test(name) && node?.parent);
  return coils.filter(([, node]) => node.visible && node.parent.visible).length;
}"""
"""Number of coils that are in the picture."""


def test_power_is_typed_a_coil_turns_and_a_motor_runs(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("drive")
    lab.waits_for("60.56 %")
    lab.type_into("eta_gear", "0.5")
    lab.until(lambda: "67.83 W" in lab.page.locator(".pw-sankey").inner_html())
    lab.type_into("eta_gear", "1.5")
    lab.waits_for("efficiency of the gear): expected a number greater than 0 and at most 1")
    lab.press("shown hold")
    lab.waits_for("12.61 W, all of it heat")
    lab.page.keyboard.press("Control+z")
    _the_coil_turns(lab)
    _the_motor_runs(lab)


def _the_coil_turns(lab):
    lab.press("torque")
    lab.until(lambda: any(name.endswith("/coils/rotor/coil0/wire") for name in lab.nodes()))
    before = lab.on_screen(lab.node("/coils/rotor"), [0.0, 0.0, 0.3])
    lab.type_into("time", "2")
    lab.waits_for("86.6 mN m")
    assert abs(lab.on_screen(lab.node("/coils/rotor"), [0.0, 0.0, 0.3]) - before).max() > 10.0
    lab.press("switched without")
    lab.waits_for("Mean torque of a turn: 0 N m")
    lab.type_into("coils", "3")
    lab.press("switched with")
    lab.waits_for("Ripple 14.03 %")
    lab.until(lambda: lab.page.evaluate(SEEN_COILS) == 3)


def _the_motor_runs(lab):
    lab.press("motor")
    lab.waits_for("187.6 rad/s")
    lab.type_into("time", "0.005")
    lab.waits_for("11.87 rad/s")
    lab.type_into("k", "5.236 V/krpm")
    lab.until(lambda: lab.page.locator('input[data-cell="k"]').first.input_value() == "0.05")
    lab.type_into("J", "0")
    lab.waits_for("I_m (moment of inertia): expected a number in kg m² greater than 0")
    lab.type_into("time", "0.005")
    lab.press("shown poles")
    lab.until(lambda: lab.page.locator(".mo-plane .mo-pole").count() == 2)
    lab.press("shown blocks")
    lab.until(lambda: "9.214 A" in lab.page.locator(".mo-diagram").inner_html())
    lab.page.locator('select[data-cell="example"]:visible').select_option("twins")
    lab.waits_for("The state is (i, ω, θ)")
    lab.until(lambda: sum(name.endswith("/housing") for name in lab.nodes()) == 2)
    lab.press("shown run")
    lab.press("large")
    lab.until(lambda: lab.page.locator(".tray-plot .curve").count() >= 2)
