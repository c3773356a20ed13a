"""The tray of large plots: what is sent and when, and that what a curve shows survives the thinning of its points."""

import base64
import json
import re
from html import unescape

import numpy as np
import pytest

from armlab.benches.motion.laws.ui.plots import TITLES
from armlab.ui.colours import BLUE
from armlab.ui.html import tag
from armlab.ui.plot import Curve
from armlab.ui.tray import MOST_POINTS, _by_key, _plain
from armlab.ui.tray_picture import Drawn, Level, Picture, thinned
from support.student import run, student


def marks(browser):
    """Return what the page is told of each plot in the tray."""
    found = re.findall(r'data-tray-plot="([^"]*)" data-picture="([^"]*)" data-numbers="([^"]*)"', browser.html())
    return {
        key: (json.loads(unescape(picture)), np.frombuffer(base64.b64decode(code), "<f4"))
        for key, picture, code in found
    }


def head(browser):
    found = re.search(r'data-tray="([^"]*)"', browser.html())
    return json.loads(unescape(found[1])) if found else None


@pytest.mark.parametrize("count", [5, 999, 1000, 1001, 7919])
def test_thinning_keeps_ends_extremes_and_gaps(count):
    x = np.linspace(-1.0, 3.0, count)
    y = np.sin(40.0 * x)
    y[count // 3], y[2 * count // 3] = 7.0, -7.0
    y[count // 2] = np.nan
    few, values = thinned(x, y, 200)
    assert len(few) == len(values) <= min(count, 260)
    assert (few[0], few[-1]) == (x[0], x[-1])
    assert (np.nanmax(values), np.nanmin(values)) == (7.0, -7.0)
    assert x[count // 2] in few[np.isnan(values)]
    assert np.all(np.diff(few) > 0.0)


def test_a_picture_is_described_with_its_points_apart():
    x, y = np.array([0.0, 0.5, 1.0]), np.array([1.0, np.nan, 3.0])
    picture = Picture("v < w, m/s", "t, s", [Drawn(Curve("v, m/s", BLUE, dash=(3, 2)), x, y)], [Level("limit", 2.0)])
    looks, code = picture.described(100)
    assert looks["title"] == "v &lt; w, m/s"
    assert looks["curves"] == [{"name": "v, m/s", "colour": list(BLUE), "width": 1.6, "dash": [3, 2], "count": 3}]
    assert [level["name"] for level in looks["levels"]] == ["limit"]
    np.testing.assert_array_equal(np.frombuffer(base64.b64decode(code), "<f4"), np.float32([*x, *y]))


def test_a_chip_has_its_dots_over_the_letter():
    assert [_plain(tag("span", title, ", 1/s")) for title, *_ in TITLES[1:3]] == ["s\u0307, 1/s", "s\u0308, 1/s"]


def test_two_plots_with_one_file_have_two_keys():
    class Seen:
        def __init__(self, file, on=True):
            self.file, self.on = file, on

    plots = [Seen("speeds"), Seen("away", False), Seen("speeds"), Seen("q")]
    assert list(_by_key(plots)) == ["speeds", "speeds 2", "q"]


def test_only_what_the_page_shows_is_sent_and_only_when_it_has_changed(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("motion_plots")
        await browser.until(lambda: "Velocity q" in browser.html())
        assert head(browser) is None
        await browser.press("large")
        await browser.until(lambda: head(browser) and head(browser)["plots"])
        assert [plot["key"] for plot in head(browser)["plots"]] == ["q", "q_dot", "q_ddot"]
        assert marks(browser) == {}
        channel = head(browser)["chan"]
        await browser.press_on(channel, "look", json.dumps({"keys": ["q_dot", "none"], "points": 10**9}))
        await browser.until(lambda: marks(browser))
        ((key, (picture, numbers)),) = marks(browser).items()
        assert (key, picture["x"]) == ("q_dot", "t, s")
        counts = [curve["count"] for curve in picture["curves"]]
        assert [curve["name"] for curve in picture["curves"]] == ["q̇₁, °/s", "q̇₂, °/s"]
        assert len(numbers) == 2 * sum(counts)
        assert max(counts) <= 2 * MOST_POINTS
        # Nothing of the plots is sent again for a change that is none of theirs.
        before = browser.html().count("data-numbers")
        seen = []
        browser.on_message = lambda message, at: seen.append(str(message.get("updates", "")))
        await browser.set_value(browser.slider(1), 0.3)
        await browser.until(lambda: seen)
        assert not any("data-numbers" in each for each in seen)
        assert browser.html().count("data-numbers") == before
        browser.on_message = lambda message, at: None
        await browser.press_on(channel, "look", "no plots")
        await browser.press_on(channel, "csv", "no plot")
        for text in ("no plot", "[]", '{"key": "q"}', '{"key": "none", "time": 0.3}', '{"key": "q", "time": NaN}'):
            await browser.press_on(channel, "clip", text)
        # A page asks for a clip together with the time at which a hand points.
        await browser.press_on(channel, "clip", json.dumps({"key": "q", "time": 0.25}))
        await browser.until(lambda: '"time": 0.25' in unescape(browser.html()))
        await browser.open("motion")
        await browser.until(lambda: head(browser) is None)
        assert marks(browser) == {}
        await browser.close()

    run(main())
