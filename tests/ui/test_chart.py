"""The axes of pictures that are drawn by hand."""

import re

import pytest

from armlab.ui.chart import Chart, value_text

CHART = Chart("made-up", (-1.0, 3.0), (0.0, 50.0), 320, 200, 30, 16)


def test_corners_of_the_ranges_are_those_of_the_rectangle():
    assert (CHART.px(-1.0), CHART.py(0.0)) == (30.0, 184.0)
    assert (CHART.px(3.0), CHART.py(50.0)) == (320.0, 0.0)
    assert CHART.px(1.0) == 175.0
    assert 'd="M30 184.0H320"' in CHART.zero()


def test_round_values_stand_where_they_are():
    text = "".join(CHART.grid())
    read = {
        words: float(x) for x, words in re.findall(r'<text class="tick" x="([\d.]+)" y="196.0"[^>]*>([^<]*)<', text)
    }
    assert read == {"−1": 30.0, "0": 102.5, "1": 175.0, "2": 247.5, "3": 320.0}
    assert '<text class="tick" x="320.0" y="196.0" text-anchor="end">3<' in text  # else it would lie half outside
    levels = re.findall(r'text-anchor="end">(\d+)</text>', text)
    assert levels == ["3", "0", "10", "20", "30", "40", "50"]
    assert re.findall(r'text-anchor="end">(\d+)</text>', "".join(CHART.grid(top=18.0)))[-1] == "40"


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
