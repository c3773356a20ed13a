"""Formulas of lessons in reports that are plain text."""

import pytest

from armlab.content.markdown import formula
from armlab.content.typed_formula import typed_formula


@pytest.mark.parametrize(
    ("latex", "typed"),
    [
        (r"\sqrt{3}", "√3"),
        (r"\sqrt{90^2 + 90^2}", "√(90^2+90^2)"),
        (r"\frac{1}{\sqrt{3}}", "1/√3"),
        (r"\frac{a + b}{2}", "(a+b)/2"),
        (r"l_2^2", "l2^2"),
        (r"1\,\text{m}^2", "1 m^2"),
        (r"{}^wT_0\,{}^0T_2", "^wT0 ^0T2"),
        (r"l_1 \,\cos\, q_1", "l1 cos q1"),
        (r"{}^Ap_{EA}", "^Ap_EA"),
        (r"\dot q_1+\ddot r_x", "q\u03071+r\u0308_x"),
        (r"x < 1", "x<1"),
        (r"\begin{bmatrix} 1 & 0 \\ 0 & -1 \end{bmatrix}", "[1 0; 0 −1]"),
        (r"\sqrt[3]{8}", "8^(1/3)"),
    ],
)
def test_a_formula_is_written_as_one_would_type_it(latex, typed):
    assert typed_formula(formula(latex)) == typed
