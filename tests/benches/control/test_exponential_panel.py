"""The page of the matrix exponential: what it says of eigenvalues, and which lines it draws."""

import pytest

from armlab.benches.control.exponential.state import Exponential
from armlab.benches.control.exponential.ui.page import _eigen, results_markup
from armlab.benches.control.exponential.ui.plane import plane


@pytest.mark.parametrize(("A", "value"), [(((0.0, 1.0), (-9.0, -6.0)), "−3"), (((-4.0, -3.0), (3.0, 2.0)), "−1")])
def test_a_double_eigenvalue_is_real_and_its_eigenvector_is_drawn_once(A, value):
    part = Exponential(A=A)
    said = _eigen(part.found)
    assert f"λ₁ = λ₂ = {value}" in said
    assert "a double eigenvalue with one eigenvector" in said
    assert "complex" not in said
    assert plane(part).count("stroke-dasharray") == 1
    words = results_markup(part)
    assert "A is not diagonalisable" in words
    assert "the series and SciPy do not need it" in words


def test_two_eigenvalues_and_complex_ones_are_told_apart():
    assert "λ₂ = −2" in _eigen(Exponential().found)
    assert plane(Exponential()).count("stroke-dasharray") == 2
    turn = Exponential(A=((0.0, -1.0), (1.0, 0.0)))
    assert "± 1" in _eigen(turn.found)
    assert "complex eigenvectors" in _eigen(turn.found)
    assert "stroke-dasharray" not in plane(turn)
    same = Exponential(A=((-1.0, 0.0), (0.0, -1.0)))
    assert "double" not in _eigen(same.found)
    assert plane(same).count("stroke-dasharray") == 2
