"""Symmetric and skew parts, quadratic forms and dyads, against NumPy and by hand; and what is refused."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.axis_angle import frame_about
from armlab.kin.matrix_parts import dyads, expansion, quadratic_form, skew_part, skew_vector, symmetric_part
from armlab.kin.rotations import rotation_about, skew


def test_a_matrix_is_the_sum_of_its_parts(rng):
    for A in rng.normal(size=(50, 3, 3)):
        np.testing.assert_allclose(symmetric_part(A) + skew_part(A), A, rtol=0, atol=1e-15)
        np.testing.assert_array_equal(symmetric_part(A), symmetric_part(A).T)
        np.testing.assert_array_equal(skew_part(A), -skew_part(A).T)
        np.testing.assert_array_equal(skew(skew_vector(A)), skew_part(A))


def test_only_the_symmetric_part_counts_in_a_quadratic_form(rng):
    """3.39-3.41: of a skew matrix the form is the number 0."""
    for A, x in zip(rng.normal(size=(50, 3, 3)), rng.normal(size=(50, 3)), strict=True):
        assert quadratic_form(A, x) == pytest.approx(quadratic_form(symmetric_part(A), x), abs=1e-13)
        assert quadratic_form(skew_part(A), x) == pytest.approx(0.0, abs=1e-14)


def test_a_skew_matrix_is_a_cross_product(rng, truth):
    for v, u in rng.normal(size=(50, 2, 3)):
        np.testing.assert_allclose(skew(v) @ u, np.cross(v, u), rtol=0, atol=1e-14)
        np.testing.assert_allclose(skew(v) @ u, skew(u).T @ v, rtol=0, atol=1e-14)  # 3.45
    assert truth["ERR-3.41"]["expected"]["corrected_residual"] == 0.0


def test_a_product_is_the_sum_of_its_dyads_with_the_columns_and_not_the_rows(rng, truth):
    """ERR-3.35: of a matrix that is no rotation B^T B is far from the sum."""
    for A, B in rng.normal(size=(30, 2, 3, 3)):
        np.testing.assert_allclose(expansion(A, B), B @ A @ B.T, rtol=0, atol=1e-13)
        total = np.trace(dyads(B), axis1=0, axis2=1)
        np.testing.assert_allclose(total, B @ B.T, rtol=0, atol=1e-13)
        assert np.abs(total - B.T @ B).max() > 1e-3
    assert truth["ERR-3.35"]["expected"]["corrected_residual"] < 1e-14


def test_dyads_of_unit_vectors_and_of_a_frame():
    A = np.arange(9.0).reshape(3, 3)
    np.testing.assert_array_equal(expansion(A, np.eye(3)), A)  # 3.32
    C = frame_about([1.0, 2.0, -2.0])
    each = dyads(C)
    np.testing.assert_allclose(each[0, 0] + each[1, 1] + each[2, 2], np.eye(3), rtol=0, atol=1e-15)  # 3.36
    np.testing.assert_allclose(each[1, 0] - each[0, 1], skew(C[:, 2]), rtol=0, atol=1e-15)  # 3.52
    assert np.abs(each[0, 1]).max() > 0.1
    np.testing.assert_allclose(expansion(rotation_about("z", 1.1), C), C @ rotation_about("z", 1.1) @ C.T, atol=1e-15)


@pytest.mark.parametrize("call", [lambda: dyads(np.eye(2)), lambda: skew_vector([[1, 2, np.nan]] * 3)])
def test_what_is_no_matrix_is_refused(call):
    with pytest.raises(InputError, match="A: expected 3 rows of 3 finite numbers"):
        call()
