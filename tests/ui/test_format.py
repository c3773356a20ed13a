"""Numbers and markup on screen."""

import math

import numpy as np
import pytest

from armlab.ui import format as fmt


def test_numbers_have_fixed_decimals_and_a_true_minus():
    assert fmt.number(1.25, 1) == "1.2"
    assert fmt.number(-1.26, 1) == "−1.3"
    assert fmt.number(-0.001, 2) == "0.00"


def test_angles_do_not_flip_between_plus_and_minus_half_a_turn():
    assert fmt.turn(math.pi) == fmt.turn(-math.pi) == "180.0"
    assert fmt.turn(-math.pi + 0.01) == "−179.4"


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0.0 mm"), (2e-6, "2.0 µm"), (0.0123, "12.3 mm"), (0.43, "430 mm"), (1e-9, "0.0 mm")],
)
def test_lengths_have_a_unit_that_fits(value, text):
    assert fmt.length(value) == text


def test_zeros_of_a_matrix_are_grey():
    html = fmt.matrix(np.array([[1.0, 0.0004], [-0.5, 2.0]]), 3, rule=1)
    assert html.count('class="zero') == 1
    assert "−0.500" in html
    assert html.count("ruled") == 2


def test_text_cannot_become_markup():
    assert fmt.escaped('<img src=x onerror="x">') == "&lt;img src=x onerror=&quot;x&quot;&gt;"


def test_formulas_are_kept_but_not_for_ever():
    assert fmt.mathml("q_1") is fmt.mathml("q_1")
    assert fmt.mathml.cache_info().maxsize == 4096


def test_formulas_become_mathml():
    assert fmt.mathml("q_1").startswith("<math")
    assert 'display="block"' in fmt.mathml("q_1", block=True)
