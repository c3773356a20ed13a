"""The film in a real page: scrubbing, the keys, and the timeline."""

import numpy as np
import pytest

from armlab.benches.robot.film.clip import end_of, ends_of, place_at, start_of
from armlab.content.robots import catalogue
from armlab.kin.moves import partial_product

pytestmark = pytest.mark.browser
PUMA = catalogue()["puma560"]
END = ends_of(PUMA.arm)[-1]


def open_film(lab):
    lab.open_tab("Robot")
    lab.press("film")
    lab.page.locator(".al-time").wait_for()
    lab.rest()


def clock(lab):
    """Return what the lab last told of the timeline."""
    return lab.page.evaluate("() => JSON.parse(document.getElementById('al-clock').dataset.clock)")


def scrub(lab, time):
    """Drag the thumb's value, as the range input does under a hand."""
    lab.page.locator(".al-time input[type=range]").evaluate(
        "(thumb, part) => { thumb.value = part; thumb.dispatchEvent(new Event('input', { bubbles: true })); }",
        time / END,
    )
    lab.until(lambda: abs(clock(lab)["time"] - time) < 1e-3)
    lab.rest()


def moving_frame(lab):
    """Return where the page draws the moving frame: its origin and its axes, 4 x 4."""
    elements = lab.page.evaluate(
        """name => {
          const node = window.__viserMutable.nodeRefFromName[name];
          node.updateWorldMatrix(true, false);
          return node.matrixWorld.elements;
        }""",
        lab.node("/film/moving"),
    )
    T = np.array(elements).reshape(4, 4).T
    T[:3, :3] /= np.linalg.norm(T[:3, :3], axis=0)
    # The page's own up is y; viser turns the whole scene.
    world = np.array(
        lab.page.evaluate(
            """() => {
              const root = window.__viserMutable.nodeRefFromName[''];
              root.updateWorldMatrix(true, false);
              return root.matrixWorld.elements;
            }"""
        )
    )
    return np.linalg.inv(world.reshape(4, 4).T) @ T


def key(lab, name):
    lab.page.keyboard.press(name)


def playing(lab):
    return lab.page.locator('.al-time button[data-cell="play"]').get_attribute("title").startswith("Pause")


def visible(lab):
    return lab.page.evaluate("name => window.__viserMutable.nodeRefFromName[name].visible", lab.node("/film"))


def test_the_film_is_scrubbed_played_stepped_repeated_and_put_away(visit):
    lab = visit()
    open_film(lab)
    assert visible(lab)
    _steps_by_keys_while_the_bar_changes(lab)
    _scrubs_from_factor_to_factor_up_to_the_tool(lab)
    scrub(lab, 0.0)
    _plays_by_the_space_bar_to_the_end(lab)
    _plays_on_in_a_loop_at_the_speed_chosen(lab)
    _is_put_away_and_shown_again(lab)


def _steps_by_keys_while_the_bar_changes(lab):
    for expected in ends_of(PUMA.arm)[:2]:
        key(lab, "Period")
        lab.until(lambda expected=expected: clock(lab)["time"] == expected)
    key(lab, "Comma")
    lab.until(lambda: clock(lab)["time"] == 1.5)
    lab.press("loop")
    assert lab.page.locator(".al-time .now").inner_text() == f"1.5 / {END:.1f} s"
    thumb = lab.page.locator(".al-time input[type=range]")
    assert float(thumb.input_value()) == pytest.approx(1.5 / END, abs=1e-3)
    assert lab.page.locator(".film .now").inner_text() == "Rz(θ₁)"
    lab.press("loop")


def _scrubs_from_factor_to_factor_up_to_the_tool(lab):
    for time in (0.9, end_of(PUMA.arm, 0, 1), end_of(PUMA.arm, 0, 3), 0.3 * END, 0.8 * END, END):
        scrub(lab, time)
        place = place_at(PUMA.arm, clock(lab)["time"])
        expected = partial_product(PUMA.arm, PUMA.home, place.row, place.progress)
        np.testing.assert_allclose(moving_frame(lab), expected, rtol=0, atol=1e-4)
    np.testing.assert_allclose(moving_frame(lab), PUMA.arm.fk(PUMA.home), rtol=0, atol=1e-4)


def _plays_by_the_space_bar_to_the_end(lab):
    before = moving_frame(lab)
    key(lab, "Space")
    lab.until(lambda: playing(lab) and clock(lab)["time"] > 0.3)
    key(lab, "Space")
    lab.until(lambda: not playing(lab))
    lab.rest()
    held = clock(lab)["time"]
    lab.rest()
    assert clock(lab) == {"clip": "film", "time": held, "end": END, "rate": 0.0}
    assert 0.3 < held < END
    assert np.abs(moving_frame(lab) - before).max() > 1e-3
    # After a click on a row the space bar plays, and does not press the row again.
    lab.page.locator('.chip[data-cell="6"]').click()
    lab.until(lambda: abs(clock(lab)["time"] - start_of(PUMA.arm, 6)) < 0.01)
    key(lab, "Space")
    lab.until(lambda: clock(lab)["time"] == END and not playing(lab))
    lab.rest()
    np.testing.assert_allclose(moving_frame(lab), PUMA.arm.fk(PUMA.home), rtol=0, atol=1e-4)


def _plays_on_in_a_loop_at_the_speed_chosen(lab):
    lab.page.locator(".al-time select").select_option("4")
    lab.rest()
    assert lab.page.locator(".al-time select").input_value() == "4"
    lab.press("loop")
    scrub(lab, END - 1.0)
    key(lab, "Space")
    lab.until(lambda: clock(lab)["rate"] == 4.0)
    lab.until(lambda: 0.5 < clock(lab)["time"] < 0.8 * END)
    assert playing(lab)
    key(lab, "Space")
    lab.until(lambda: not playing(lab))


def _is_put_away_and_shown_again(lab):
    lab.press("close")
    assert lab.page.locator(".al-time").count() == 0
    assert not visible(lab)
    lab.press("show")
    assert lab.page.locator(".al-time").count() == 1
    assert visible(lab)
    # It goes with its page, and comes back where it was.
    scrub(lab, 9.6)
    lab.open_tab("Joints")
    lab.rest()
    assert lab.page.locator(".al-time").count() == 0
    assert not visible(lab)
    lab.open_tab("Robot")
    lab.until(lambda: lab.page.locator(".al-time").count() == 1 and abs(clock(lab)["time"] - 9.6) < 1e-3)
    assert visible(lab)
