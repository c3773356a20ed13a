"""The names of functions in formulas have room as TeX gives them."""

import re
from html import unescape

import pytest

from armlab.content.markdown import formula
from armlab.ui.format import mathml

CASES = [
    (r"\sin\varphi\sin\theta", "sin_φ_sin_θ"),
    (r"q_3\cos q_2", "q3_cos_q2"),
    (r"2\sin^2\theta", "2_sin2_θ"),
    (r"(a+b)\tan\frac{x}{2}", "(a+b)_tan_x2"),
    (r"\sin\,q-\cos\,q", "sin_q−cos_q"),
    (r"\cos(q)\sin\left(q\right)", "cos(q)_sin(q)"),
    (r"\frac{1}{-\cos q}", "1−cos_q"),
    (r"\begin{bmatrix}\cos q&-\sin q\end{bmatrix}", "[cos_q−sin_q]"),
    (r"x\,y=z", "x_y=z"),
]


@pytest.mark.parametrize("typeset", [formula, mathml])
@pytest.mark.parametrize(("latex", "read"), CASES)
def test_a_function_stands_apart_from_factors_and_arguments_but_not_from_brackets(typeset, latex, read):
    with_spaces = re.sub(r"<mspace[^>]*>", "_", str(typeset(latex)))
    assert unescape(re.sub(r"<[^>]*>", "", with_spaces)) == read
