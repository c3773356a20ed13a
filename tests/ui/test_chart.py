"""The axes of pictures that are drawn by hand."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.ui.chart import Chart, value_text
from armlab.ui.ticks import ticks

CHART = Chart("made-up", (-1.0, 3.0), (0.0, 50.0), 320, 200, 30, 16)


def numbers(text, y):
    """Return the numbers that stand at a height, and where."""
    return {words: float(x) for x, words in re.findall(rf'<text class="tick" x="([\d.]+)" y="{y}"[^>]*>([^<]*)<', text)}


def test_corners_of_the_ranges_are_those_of_the_rectangle():
    assert (CHART.px(-1.0), CHART.py(0.0)) == (30.0, 184.0)
    assert (CHART.px(3.0), CHART.py(50.0)) == (320.0, 0.0)
    assert CHART.px(1.0) == 175.0
    assert 'd="M30 184.0H320"' in CHART.zero()


def test_round_values_stand_where_they_are():
    text = "".join(CHART.grid())
    assert numbers(text, 196.0) == {"−1": 30.0, "0": 102.5, "1": 175.0, "2": 247.5, "3": 320.0}
    assert '<text class="tick" x="320.0" y="196.0" text-anchor="end">3<' in text  # else it would lie half outside
    levels = re.findall(r'text-anchor="end">(\d+)</text>', text)
    assert levels == ["3", "0", "10", "20", "30", "40", "50"]


def test_names_take_the_place_of_the_numbers_beside_them():
    named = replace(CHART, names=("x, long", "y"))
    text = "".join(named.grid())
    assert numbers(text, 196.0) == {"0": 102.5, "1": 175.0, "2": 247.5, "3": 320.0}  # -1 at 30 is covered
    assert re.findall(r'text-anchor="end">(\d+)</text>', text)[-1] == "40"
    assert '<text x="2.0" y="11.0">y</text>' in text
    assert '<text x="2.0" y="196.0">x, long</text>' in text
    assert "−1" in numbers("".join(replace(CHART, names=("x", "")).grid()), 196.0)


def test_decades_of_a_logarithmic_axis_are_equally_wide():
    chart = replace(CHART, x=(0.1, 100.0), left=20.0, log=True)
    assert [round(chart.px(10.0**power), 9) for power in (-1, 0, 1, 2)] == [20.0, 120.0, 220.0, 320.0]
    assert chart.px(math.sqrt(10.0)) == pytest.approx(170.0)
    assert numbers("".join(chart.grid()), 196.0) == {"0.1": 20.0, "1": 120.0, "10": 220.0, "100": 320.0}
    assert 'd="M120.0 0V184"' in chart.upright(1.0, "here")
    wide = numbers("".join(replace(chart, x=(1e-7, 1e9)).grid()), 196.0)
    assert list(wide) == ["1e−7", "0.0001", "0.1", "100", "1e5", "1e8"]
    gaps = np.diff(list(wide.values()))
    assert gaps == pytest.approx([3 * 300.0 / 16] * 5, abs=0.1)  # pixels are rounded to tenths


def test_an_ordinate_may_be_logarithmic_too():
    chart = replace(CHART, y=(0.01, 10.0), height=196, bottom=16, log_y=True)
    assert [round(chart.py(10.0**power), 9) for power in (-2, -1, 0, 1)] == [180.0, 120.0, 60.0, 0.0]
    levels = re.findall(r'y="([\d.]+)" text-anchor="end">([\d.]+)<', "".join(chart.grid()))
    assert levels[1:] == [("184.0", "0.01"), ("124.0", "0.1"), ("64.0", "1"), ("4.0", "10")]
    with pytest.raises(ValueError, match="y of chart made-up: expected a range above zero, got 0 to 1"):
        replace(CHART, y=(0.0, 1.0), log_y=True)


def test_round_values_of_a_given_distance():
    chart = replace(CHART, y=(-90.0, 30.0), steps=(0.0, 45.0))
    assert re.findall(r'text-anchor="end">([^<]+)</text>', "".join(chart.grid()))[1:] == ["−90", "−45", "0"]


def test_a_line_is_broken_where_it_has_no_value():
    made = CHART.line([(-1.0, 0.0), (0.0, math.nan), (1.0, 50.0), (3.0, 25.0), (3.0, math.inf)])
    assert 'd="M30.0 184.0M175.0 0.0L320.0 92.0"' in made


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"x": (1.0, 1.0)}, "x of chart made-up: expected a range of finite numbers, got 1 to 1"),
        ({"y": (2.0, 1.0)}, "y of chart made-up: expected a range of finite numbers, got 2 to 1"),
        ({"y": (0.0, math.inf)}, "y of chart made-up"),
        ({"y": (math.nan, 1.0)}, "y of chart made-up"),
        ({"y": (-1e308, 1e308)}, "y of chart made-up"),
        ({"x": (0.0, 1.0), "log": True}, "x of chart made-up: expected a range above zero, got 0 to 1"),
    ],
)
def test_a_range_without_extent_is_refused(changes, words):
    with pytest.raises(ValueError, match=words):
        replace(CHART, **changes)


def test_nearly_equal_and_huge_ranges_have_numbers():
    for y in ((1.0, 1.0 + 1e-12), (-1e300, 1e300), (0.0, 1e-300)):
        made = "".join(replace(CHART, y=y).grid())
        assert "nan" not in made
        assert made.count('text-anchor="end">') >= 3


def test_lines_are_cut_at_the_rectangle_of_their_own_chart():
    other = Chart("other", (0.0, 1.0), (0.0, 1.0), 100, 100, 0, 0)
    for chart in (CHART, other):
        made = chart.picture("A curve", chart.line([(0.0, 0.0), (9.0, 99.0)], stroke="red", stroke_dasharray=None))
        assert f'<svg class="chart {chart.key}"' in made
        assert f'<clipPath id="{chart.key}-clip"><rect x="' in made
        assert f'<path clip-path="url(#{chart.key}-clip)" d="M' in made
        assert "dasharray" not in made
        assert 'aria-label="A curve"' in made


@pytest.mark.parametrize(
    ("value", "span", "text"),
    [
        (0.25, (0.0, 1.0), "0.25"),
        (-1575.0, (-1600.0, 30.0), "−1575"),
        (2e5, (0.0, 1e6), "2e5"),
        (1.00001, (1.0, 1.00002), "1e0"),
        (0.0, (0.0, 1e-6), "0"),
    ],
)
def test_values_are_as_exact_as_their_range_needs(value, span, text):
    assert value_text(value, span) == text


@pytest.mark.parametrize("y", [(-2.2e5, 2.6e5), (0.0, 6e-5), (9.7e5, 1.1e6), (-3e300, 1e300), (0.0, 1e-300)])
def test_values_with_a_power_of_ten_read_back_as_what_they_are(y):
    said = [value_text(value, y) for value in ticks(*y)]
    assert [float(text.replace("−", "-")) for text in said] == pytest.approx(ticks(*y), rel=1e-12)
