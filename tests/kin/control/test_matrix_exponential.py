"""e^(A t) by its series, by eigenvectors and by SciPy, where each is right, and where one is not."""

import math
from itertools import product

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.control.matrix_exponential import (
    as_printed,
    by_eigenvectors,
    by_scipy,
    diagonalised,
    flow,
    largest_difference,
    partial_sums,
    remainder_bound,
)

NOTES = np.array([[0.0, 1.0], [-2.0, -3.0]])
"""Of the check of 1.58: eigenvalues -1 and -2."""

SCIPY = 1e-11
"""Relative error that scipy.linalg.expm itself may have; the series and the eigenvectors agree better."""


def test_the_product_of_1_58_and_as_it_is_printed():
    """ERR-1.58: T e^(Lambda t) T^-1 is right, T^-1 e^(Lambda t) T is 0.895 away."""
    right = by_scipy(NOTES, 0.7)
    assert largest_difference(by_eigenvectors(NOTES, 0.7), right) < 1e-14
    assert largest_difference(as_printed(NOTES, 0.7), right) == pytest.approx(0.895, abs=5e-4)


def test_the_error_of_a_first_order_loop_dies_out(truth):
    """C1.3-error-decay: edot = -K e with a diagonal K; 1.56 holds entry by entry."""
    case = truth["C1.3-error-decay"]
    given = case["inputs"]
    A = -np.diag([given["kx"], given["ky"]])
    np.testing.assert_allclose(flow(A, given["e0"], given["t"]), case["expected"]["e"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(by_scipy(A, given["t"]), np.diag(np.exp(np.diag(A) * given["t"])), rtol=0, atol=1e-15)


def test_a_rotation_by_hand():
    """A = [[0, -1], [1, 0]] turns: its eigenvalues are +-j and its exponential is a rotation by t."""
    turn, t = np.array([[0.0, -1.0], [1.0, 0.0]]), 1.1
    by_hand = [[math.cos(t), -math.sin(t)], [math.sin(t), math.cos(t)]]
    for way in (by_scipy(turn, t), by_eigenvectors(turn, t), partial_sums(turn, t, 25)[-1]):
        np.testing.assert_allclose(way, by_hand, rtol=0, atol=1e-14)
    assert not diagonalised(turn).real


def random_matrices(rng, count=40):
    for _ in range(count):
        n = int(rng.integers(1, 5))
        yield rng.normal(size=(n, n)) * float(rng.uniform(0.1, 2.0))


def test_the_three_ways_agree_where_eigenvectors_are_a_good_basis(rng):
    good = 0
    for A in random_matrices(rng):
        found, whole = diagonalised(A), by_scipy(A, 0.9)
        size = 1.0 + np.abs(whole).max()
        np.testing.assert_allclose(partial_sums(A, 0.9, 60)[-1], whole, rtol=0, atol=SCIPY * size)
        if found.basis == "good":
            good += 1
            error = largest_difference(by_eigenvectors(A, 0.9), whole)
            assert error <= (SCIPY + 1e-14 * found.condition) * size
    assert good >= 30


def test_the_remainder_stays_below_its_bound(rng):
    for A in random_matrices(rng):
        whole = by_scipy(A)
        errors = np.abs(partial_sums(A, 1.0, 40) - whole).max(axis=(1, 2))
        bounds = [remainder_bound(A, 1.0, terms) for terms in range(1, 41)]
        assert all(
            error <= bound + 1e-12 * np.abs(whole).max() + 1e-13 for error, bound in zip(errors, bounds, strict=True)
        )
    assert remainder_bound(np.zeros((2, 2)), 1.0, 1) == 0.0
    assert remainder_bound(10.0 * np.eye(2), 1.0, 5) == math.inf
    # x = 3.5 is below the N + 1 = 4 of the next term, and above 3.
    assert remainder_bound(3.5 * np.eye(2), 1.0, 3) == pytest.approx(3.5**3 / 6.0 / (1.0 - 3.5 / 4.0), rel=1e-12)
    assert remainder_bound(4.0 * np.eye(2), 1.0, 3) == math.inf
    # x^3/3!/(1 - x/4) with x = 1.
    assert remainder_bound(np.eye(2), 1.0, 3) == pytest.approx(1.0 / 6.0 / 0.75, abs=1e-15)


def test_the_sums_are_those_of_the_definition():
    sums = partial_sums(NOTES, 0.5, 4)
    step = 0.5 * NOTES
    np.testing.assert_allclose(sums[0], np.eye(2), rtol=0, atol=0)
    np.testing.assert_allclose(sums[1], np.eye(2) + step, rtol=0, atol=1e-16)
    expected = np.eye(2) + step + step @ step / 2 + step @ step @ step / 6
    np.testing.assert_allclose(sums[3], expected, rtol=0, atol=1e-15)


def test_terms_of_both_signs_leave_an_error_that_no_more_terms_mend():
    """The series of e^-30: the largest term is 8e11, so that rounding leaves 1e-5 although e^-30 is 1e-13."""
    A = np.array([[-30.0, 0.0], [0.0, -1.0]])
    left = largest_difference(partial_sums(A, 1.0, 200)[-1], by_scipy(A))
    assert 1e-8 < left < 1e-3
    assert remainder_bound(A, 1.0, 200) < 1e-70


@pytest.mark.parametrize(
    "A",
    [
        [[0.0, 1.0], [0.0, 0.0]],
        [[-1.0, 1.0], [0.0, -1.0]],
        [[1.0, 1.0], [-1.0, 3.0]],
        [[2.0, 1.0, 0.0], [0.0, 2.0, 1.0], [0.0, 0.0, 2.0]],
    ],
)
def test_too_few_eigenvectors_are_said_in_words(A):
    found = diagonalised(A)
    assert found.basis == "none"
    assert "not diagonalisable" in found.says
    assert by_eigenvectors(A) is None
    assert as_printed(A) is None
    np.testing.assert_allclose(partial_sums(A, 1.0, 40)[-1], by_scipy(A), rtol=1e-13, atol=1e-13)


def test_a_double_eigenvalue_of_whole_numbers_is_real_and_has_one_eigenvector():
    """All matrices of entries up to 4: the discriminant (a - d)^2 + 4 b c tells exactly what they have."""
    doubles = 0
    for a, b, c, d in product(range(-4, 5), repeat=4):
        A, discriminant = np.array([[a, b], [c, d]], dtype=np.float64), (a - d) ** 2 + 4 * b * c
        found = diagonalised(A)
        assert found.real == (discriminant >= 0)
        assert (found.basis == "none") == (discriminant == 0 and bool(b or c))
        if found.basis == "none":
            doubles += 1
            assert found.values[0] == found.values[1]
            assert found.values[0].real == pytest.approx(0.5 * (a + d), abs=1e-14)
            np.testing.assert_allclose(A @ found.T, found.T * found.values, rtol=0, atol=1e-13)
            np.testing.assert_allclose(np.linalg.norm(found.T, axis=0), 1.0, rtol=0, atol=1e-14)
    assert doubles == 248


@pytest.mark.parametrize("size", [1e-3, 1.0, 100.0])
def test_a_double_eigenvalue_does_not_depend_on_the_unit_of_time(size):
    found = diagonalised(size * np.array([[0.0, 1.0], [-9.0, -6.0]]))
    np.testing.assert_allclose(found.values, -3.0 * size, rtol=1e-14)
    assert found.real


def test_only_what_has_no_eigenvector_of_its_own_is_put_together():
    """A double eigenvalue 1 with two eigenvectors beside a double -3 with one; and a double pair +-j."""
    A = np.zeros((4, 4))
    A[:2, :2], A[2:, 2:] = np.eye(2), [[0.0, 1.0], [-9.0, -6.0]]
    found = diagonalised(A)
    np.testing.assert_allclose(np.sort(found.values.real), [-3.0, -3.0, 1.0, 1.0], rtol=0, atol=1e-13)
    assert found.real
    assert np.linalg.matrix_rank(found.T, tol=1e-6) == 3
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    whirl = diagonalised(np.block([[turn, np.eye(2)], [np.zeros((2, 2)), turn]]))
    np.testing.assert_allclose(np.sort(whirl.values.imag), [-1.0, -1.0, 1.0, 1.0], rtol=0, atol=1e-13)


def test_almost_parallel_eigenvectors_are_said_in_words():
    found = diagonalised([[1.0, 1.0], [0.0, 1.0001]])
    assert found.basis == "poor"
    assert "about 4 of 16 digits" in found.says
    assert diagonalised(np.eye(3)).basis == "good"
    assert "good basis" in diagonalised(NOTES).says


def test_the_flow_goes_on_from_where_it_is(rng):
    for A in random_matrices(rng, 10):
        x0 = rng.normal(size=len(A))
        times = np.array([[0.0, 0.3], [0.8, -0.4]])
        x = flow(A, x0, times)
        assert x.shape == (2, 2, len(A))
        np.testing.assert_allclose(x[0, 0], x0, rtol=0, atol=1e-15)
        np.testing.assert_allclose(flow(A, x[0, 1], 0.5), x[1, 0], rtol=0, atol=1e-11 * (1 + np.abs(x).max()))
        # xdot = A x by central differences.
        h = 1e-5
        slope = (flow(A, x0, 0.3 + h) - flow(A, x0, 0.3 - h)) / (2 * h)
        np.testing.assert_allclose(slope, A @ x[0, 1], rtol=0, atol=1e-7 * (1 + np.abs(x).max()))


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: by_scipy([[1.0, 2.0]]), "square matrix"),
        (lambda: by_scipy([[math.nan]]), "finite"),
        (lambda: by_scipy([[1.0]], 1e6), "too large"),
        (lambda: by_scipy([["a"]]), "A: expected a square matrix"),
        (lambda: partial_sums(NOTES, 1.0, 0), "terms: expected a whole number"),
        (lambda: partial_sums(NOTES, 1.0, 10**6), "terms: expected at most"),
        (lambda: partial_sums(NOTES, [1.0, 2.0], 3), "t: expected one number"),
        (lambda: flow(NOTES, [1.0], 0.0), "x0: expected 2 finite numbers"),
        (lambda: by_scipy(np.eye(13)), "1 to 12 rows"),
    ],
)
def test_nonsense_is_refused(call, says):
    with pytest.raises(InputError, match=says):
        call()


@pytest.mark.parametrize("A", [[[-1000.0]], [[-1000.0, 0.0], [5.0, -2000.0]], [[0.0, 1.0], [-1e6, -2001.0]]])
def test_a_system_that_decays_fast_is_not_too_large(A):
    """Against the sum over eigenvectors; the condition of the last, 1e3, costs as many digits."""
    values, T = np.linalg.eig(np.array(A))
    for t in (0.0, 1e-4, 1e-3, 0.01, 1.0, 100.0):
        expected = (T * np.exp(values * t)) @ np.linalg.inv(T)
        np.testing.assert_allclose(by_scipy(A, t), expected, rtol=0, atol=1e-9 * max(1.0, np.abs(A).max() * 1e-3))
        np.testing.assert_allclose(by_eigenvectors(A, t), expected, rtol=0, atol=1e-9 * np.abs(A).max())
    assert np.abs(flow(A, np.ones(len(A)), 1.0)).max() < 1e-100


def test_what_decays_forwards_grows_backwards():
    with pytest.raises(InputError, match=r"real parts of eigenvalues up to 300, got 1000: e\^\(A t\) is too large"):
        by_scipy([[-1000.0]], -1.0)
    with pytest.raises(InputError, match=r"column sums of moduli up to 1e\+09"):
        by_scipy([[-1e10]], 1.0)


def test_the_series_of_a_system_that_decays_fast_has_numbers_or_says_why_not():
    sums = partial_sums([[-1000.0]], 1.0, 120)
    assert np.isfinite(sums).all()
    assert remainder_bound([[-1000.0]], 1.0, 400) == np.inf
    assert remainder_bound([[-1000.0]], 1.0, 1000) == np.inf
    with pytest.raises(InputError, match="terms of the series are too large for 400 of them"):
        partial_sums([[-1e4]], 1.0, 400)
