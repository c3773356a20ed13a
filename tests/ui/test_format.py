"""Numbers and markup on screen."""

import numpy as np

from armlab.ui import format as fmt


def test_numbers_have_fixed_decimals_and_a_true_minus():
    assert fmt.number(1.25, 1) == "1.2"
    assert fmt.number(-1.26, 1) == "−1.3"
    assert fmt.number(-0.001, 2) == "0.00"


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
