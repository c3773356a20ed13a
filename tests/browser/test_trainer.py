"""An exercise of the assignment trainer, wrongly and then rightly, as a student does it."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser

CELLS = ("a", "alpha", "d", "theta")


def open_trainer(lab):
    lab.open_tab("Robot")
    lab.press("trainer")


def choose(lab, axis, frame, direction):
    lab.page.locator(f'select[data-cell="trainer-{axis}-{frame}"]').select_option(direction)
    lab.rest()


def fill(lab, values):
    """Type into cells one after the other with the Tab key, as fast as the page goes."""
    for (row, field), text in values.items():
        lab.page.locator(f'input[data-cell="trainer-cell-{row}-{field}"]').focus()
        lab.page.keyboard.type(text)
        lab.page.keyboard.press("Tab")
    lab.rest()


def value(lab, cell):
    return lab.page.locator(f'input[data-cell="{cell}"]').input_value()


def words(lab):
    return lab.page.locator("body").inner_text()


def sticks(lab):
    """Return the places of the balls of the translucent arm that are seen."""
    return lab.page.evaluate(
        """() => Object.entries(window.__viserMutable.nodeRefFromName)
          .filter(([name, node]) => /trainer_arm.ball/.test(name) && node?.parent && node.visible)
          .map(([name]) => window.__viserMutable.nodePoseData[name].position)"""
    )


def test_an_exercise_wrongly_then_rightly(visit):
    """First an arm that is no exercise offers others."""
    lab = visit("robot/panda", size=(1024, 700))
    open_trainer(lab)
    lab.waits_for("Not for this arm")
    lab.press("trainer-robot-planar_2r")
    lab.until(lambda: "Exercise: Planar 2R" in words(lab))
    lab.press("trainer-start")
    lab.until(lambda: "1 Axes: Planar 2R" in words(lab))
    for frame in range(3):
        choose(lab, "z", frame, "+x" if frame == 1 else "+z")
        choose(lab, "x", frame, "+y" if frame == 1 else "+x")
    lab.press("trainer-check")
    assert "z₁ must lie along the axis of joint 2: it is 90° away" in words(lab)
    assert "Check 1: 2 of 3 right" in words(lab)
    choose(lab, "z", 1, "+z")
    choose(lab, "x", 1, "+x")
    lab.press("trainer-check")
    lab.until(lambda: "2 Table: Planar 2R" in words(lab))

    wrong = {(1, "a"): "1", (1, "alpha"): "180", (1, "d"): "0", (1, "theta"): "0"}
    fill(lab, wrong | {(2, "a"): "1000", (2, "alpha"): "0", (2, "d"): "0", (2, "theta"): "0"})
    lab.until(lambda: [value(lab, f"trainer-cell-2-{field}") for field in CELLS] == ["1000", "0", "0", "0"])
    drawn = np.array(sticks(lab))
    np.testing.assert_allclose(drawn[-1], [1.001, 0.0, 0.0], atol=1e-6)
    lab.press("trainer-check")
    assert "Check 1: 6 of 8 right, 0 empty" in words(lab)
    assert "the value in metres where millimetres are expected" in words(lab)
    lab.press("trainer-ask-1-alpha")
    assert "α₁: half a turn off" in words(lab)
    lab.press("trainer-rule")
    assert "α₁ is the angle from z₀ to z₁ about x₁" in words(lab)

    lab.page.reload()
    lab.ready()
    assert lab.tab("Robot").get_attribute("aria-selected") == "true"
    assert lab.page.locator("td.no").count() == 2
    lab.type_into("trainer-cell-1-a", "1000")
    lab.type_into("trainer-cell-1-alpha", "0")
    lab.press("trainer-check")
    lab.until(lambda: "All 8 cells right" in words(lab))
    assert "2 checks of the axes, 2 of the table, no solution shown" in words(lab)
    np.testing.assert_allclose(sticks(lab)[-1], [2.0, 0.0, 0.0], atol=1e-6)
