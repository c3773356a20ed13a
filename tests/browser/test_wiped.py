"""A page that the lab has wiped for the next test is as one that was loaded: see `support.wiped`."""

import re

import numpy as np
import pytest

from support.page import SMALL

pytestmark = pytest.mark.browser

TEXT = """() => [...document.body.querySelectorAll('.al, .al *, .al-over, .al-over *, [role=tab]')]
  .filter(each => !each.closest('style, .pages'))
  .flatMap(each => [...each.childNodes].filter(node => node.nodeType === Node.TEXT_NODE).map(node => node.data.trim()))
  .filter(Boolean).sort()"""
"""All that panels and what lies over the scene say, folded and hidden parts included.

The names of the pages of a tab stay in it, hidden, once it was opened.
"""


def seen(lab):
    """Return what a page shows: names in the scene without the number of the drawing, texts, values of the sliders."""
    names = sorted(re.sub(r"^/\d+", "", name) for name in lab.nodes())
    return names, lab.page.evaluate(TEXT), lab.slider_values(4).tolist()


def test_of_what_one_has_done_the_next_finds_nothing(desk, url):
    desk.clear()
    lab = desk.take_over(url, "robot/scara", SMALL)
    loaded, camera = seen(lab), lab.camera()
    lab.open_tab("body")
    lab.type_into("q 0", "nothing")
    lab.open_tab("solutions")
    lab.open_tab("Joints")
    lab.press("random")
    for key in ("f", "l"):
        lab.page.keyboard.press(key)
        lab.rest()
    assert all(now != before for now, before in zip(seen(lab), loaded, strict=True))
    desk.leave(lab)
    again = desk.take_over(url, "robot/scara", SMALL)
    assert again is lab, "the page was loaded again"
    assert seen(again) == loaded
    np.testing.assert_allclose(again.camera(), camera, atol=1e-6)
    desk.get_up(again, painted=False)
