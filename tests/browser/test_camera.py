"""The camera in a page: a section is looked at square and the view comes back, unless a hand has moved it meanwhile."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser
KNOWN = "() => document.body.innerText.includes('To the boundary')"
SIGHT = """() => {
  const { camera } = window.__viserMutable, e = camera.matrixWorldInverse.elements;
  camera.updateMatrixWorld();
  return [e[2], e[6], e[10], e[1], e[5], e[9]];
}"""
"""In the page's axes, where y is up: the direction from what is looked at to the eye, and what is up in the picture."""

SCHEME = "() => document.documentElement.dataset.mantineColorScheme"


def at_section(lab):
    lab.open_tab("Section")
    lab.page.wait_for_function(KNOWN)
    lab.rest()


def orbit(lab):
    """Turn the eye with the mouse, beside the arm and below the card of the first visit."""
    box = lab.page.locator("canvas").first.bounding_box()
    x, y = box["x"] + 0.06 * box["width"], box["y"] + 0.75 * box["height"]
    lab.page.mouse.move(x, y)
    lab.frames(2)
    lab.page.mouse.down()
    for k in range(1, 6):
        lab.page.mouse.move(x + 12 * k, y + 4 * k)
        lab.frames(1)
    lab.page.mouse.up()
    lab.rest()


def square(lab, level):
    """Return whether the eye is upright, and level with what it looks at or above it."""
    back, up = np.split(np.array(lab.page.evaluate(SIGHT)), 2)
    off = np.degrees(np.arccos(min(1.0, abs(up[1] if level else back[1]))))
    return off < 0.1


def test_a_hand_keeps_its_view_a_section_gives_it_back_and_a_projector_says_how_to_come_back(visit):
    lab = visit("robot/elbow_3r")
    assert lab.page.evaluate(SCHEME) == "light"
    _keeps_the_view_of_a_hand_until_home_is_asked_for(lab)
    _gives_back_the_view_before_a_section(lab)
    _says_how_to_come_back_from_the_projector(lab)


def _gives_back_the_view_before_a_section(lab):
    orbit(lab)
    before = lab.camera()
    at_section(lab)
    assert square(lab, level=True)
    lab.press("slice z")
    assert square(lab, level=False)
    lab.open_tab("Joints")
    np.testing.assert_allclose(lab.camera(), before, atol=1e-6)


def _keeps_the_view_of_a_hand_until_home_is_asked_for(lab):
    first = lab.camera()
    lab.page.keyboard.press("c")
    lab.rest()
    home = lab.camera()
    np.testing.assert_allclose(first[3:], home[3:], atol=1e-6)
    # Beside load the panels may take their part of the window when the view has settled: then it stays as it is.
    np.testing.assert_allclose(first[:3], home[:3], rtol=0.2)
    at_section(lab)
    orbit(lab)
    assert not square(lab, level=True)
    hand = lab.camera()
    lab.open_tab("Joints")
    np.testing.assert_allclose(lab.camera(), hand, atol=1e-9)
    lab.page.keyboard.press("c")
    lab.rest()
    np.testing.assert_allclose(lab.camera(), home, atol=1e-6)


def test_a_system_that_asks_for_dark_pages_gets_them_until_the_person_chooses(visit):
    lab = visit("robot/planar_2r", color_scheme="dark")
    lab.until(lambda: lab.page.evaluate(SCHEME) == "dark")
    lab.page.keyboard.press("l")
    lab.until(lambda: lab.page.evaluate(SCHEME) == "light")
    lab.page.reload()
    lab.ready()
    assert lab.page.evaluate(SCHEME) == "light"


def test_who_wants_no_moving_pictures_is_shown_a_section_at_once(visit):
    lab = visit("robot/elbow_3r", reduced_motion="reduce")
    places = """() => {
      window.__places = new Set();
      const look = () => {
        window.__places.add(window.__viserMutable.camera.position.x.toFixed(4));
        requestAnimationFrame(look);
      };
      look();
    }"""
    lab.page.evaluate(places)
    at_section(lab)
    assert square(lab, level=True)
    # The place before, the first one, and one when all of the section is known.
    assert lab.page.evaluate("() => window.__places.size") <= 4


def _says_how_to_come_back_from_the_projector(lab):
    lab.page.keyboard.press("v")
    back = lab.page.get_by_role("button", name="Back: V or Esc")
    back.wait_for()
    lab.rest()
    seams = """() => [...document.querySelectorAll('[data-dock-root] > div:empty')]
      .filter(each => each.getClientRects().length && getComputedStyle(each).boxShadow !== 'none').length"""
    assert lab.page.evaluate(seams) == 0
    back.click()
    lab.rest()
    assert back.count() == 0
    assert lab.page.evaluate(seams) > 0
