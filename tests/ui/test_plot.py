"""Plots: what is sent, what is exported, where the cursor is."""

import asyncio
import csv
import io
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.ui.html import joined
from armlab.ui.plot import MOST_POINTS, TIME, Curve, Plot
from support.forms import BareForm
from support.student import run, student


class Markup:
    """Stands for an element of the page."""

    def __init__(self):
        self.shown, self.channel_id = "", "channel"

    def show(self, *inside):
        self.shown = joined(inside)


class FakeGui:
    """Records what a plot asks for."""

    def __init__(self):
        self.saved, self.head, self.handle, self.marks = {}, None, None, []

    def form(self, post):
        self.head = BareForm()
        return self.head

    def html(self):
        self.marks.append(Markup())
        return self.marks[-1]

    def save(self, name, text):
        self.saved[name] = text

    def enlarges(self, plot):
        return lambda: None

    def uplot(self, data, series, x, height):
        axes = ({"label": x, "size": 26}, {"size": 46})
        self.handle = SimpleNamespace(data=data, series=series, axes=axes, scales={"x": {"time": False}}, height=height)
        return self.handle


def plot_of(curves=1, **options):
    gui = FakeGui()
    return gui, Plot(gui, "speed, rad/s", "t, s", [Curve(f"q{i}", (0, 0, 0)) for i in range(curves)], "run", **options)


def test_no_more_points_are_sent_than_can_be_seen_and_all_are_exported():
    gui, plot = plot_of(2)
    x = np.linspace(0.0, 9.0, 4001)
    plot.show(x, [x**2, -x])
    sent = gui.handle.data
    assert len(sent) == 3
    assert all(len(column) == MOST_POINTS and column.flags.c_contiguous for column in sent)
    assert (sent[0][0], sent[0][-1]) == (0.0, 9.0)
    gui.head.press("csv")
    rows = list(csv.reader(io.StringIO(gui.saved["run.csv"])))
    assert rows[0] == ["t, s", "q0", "q1"]
    np.testing.assert_array_equal(np.array(rows[1:], dtype=float), np.column_stack([x, x**2, -x]))


def test_gaps_stay_gaps_and_limits_are_lines_across():
    gui, plot = plot_of(limits=2)
    plot.show(np.array([0.0, 1.0, 2.0]), [np.array([1.0, np.nan, 3.0])], limits=[2.5])
    _, curve, limit, unused = gui.handle.data
    # Across what is not a number the page would draw a line.
    assert curve == [1.0, None, 3.0]
    np.testing.assert_array_equal(limit, [2.5, 2.5, 2.5])
    assert np.isnan(unused).all()
    # Of what begins with NaN the page would find no range.
    plot.show(np.array([0.0, 1.0, 2.0]), [np.array([np.nan, 1.0, 3.0])])
    assert gui.handle.data[1] == [None, 1.0, 3.0]


def test_the_cursor_is_at_its_part_of_the_width_and_gone_outside():
    gui, plot = plot_of()
    cursor = gui.marks[-1]
    plot.cursor(0.0)
    assert 'data-cursor=""' in cursor.shown  # nothing is shown yet
    plot.show(np.array([-2.0, 0.0, 6.0]), [np.zeros(3)])
    for at, mark in ((-2.0, "0.00000"), (0.0, "0.25000"), (6, "1.00000"), (6.1, ""), (np.nan, ""), (None, "")):
        plot.cursor(at)
        assert f'data-cursor="{mark}"' in cursor.shown
    plot.cursor(TIME)
    assert 'data-cursor="time"' in cursor.shown


def test_an_ordinate_from_zero_and_another_name_of_the_abscissa():
    gui, plot = plot_of(from_zero=True, height=90)
    assert gui.handle.height == 90
    plot.show(np.array([0.0, 1.0]), [np.array([0.5, 2.0])])
    assert gui.handle.scales["y"]["range"] == (0.0, pytest.approx(2.16))
    plot.show(np.array([0.0, 1.0]), [np.array([0.0, 1e-17])])
    assert gui.handle.scales["y"]["range"] == (0.0, 1.0)
    plot.name_x("q₂, °")
    assert gui.handle.axes == ({"label": "q₂, °", "size": 26}, {"size": 46})
    assert plot.csv().splitlines()[0].startswith('"q₂, °"')


def test_what_does_not_fit_is_refused():
    _, plot = plot_of(2, limits=1)
    x = np.array([0.0, 1.0])
    with pytest.raises(ValueError, match="expected 2 curves"):
        plot.show(x, [x])
    with pytest.raises(ValueError, match="at most 1 limits"):
        plot.show(x, [x, x], [1.0, 2.0])


def test_names_with_markup_stay_text():
    gui, _ = plot_of()
    gui = FakeGui()
    Plot(gui, "title", "x", [Curve("<b>", (0, 0, 0)), Curve("b", (1, 1, 1))], "run")
    assert "&lt;b&gt;" in gui.head.fields.content


def test_the_curves_of_the_ellipsoid_are_shown_when_its_page_is_open(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        assert not [c for c in browser.controls.values() if c["type"] == "GuiUplotMessage"]
        await browser.open("ellipsoid")
        await browser.until(lambda: "Well conditioned" in browser.html())
        assert len([c for c in browser.controls.values() if c["type"] == "GuiUplotMessage"]) == 5
        assert "singular at −180.0°, 0.0°, 180.0°" in browser.html()
        await browser.set_value(browser.slider(2), 0.0)
        await browser.until(lambda: "✕ Singular" in browser.html())
        assert 'data-cursor="0.50000"' in browser.html()
        await asyncio.sleep(0.1)
        await browser.close()

    run(main())
