"""The four subspaces of a Jacobian, the answers to J qdot = v, and the pseudo-inverse."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.joint_scale import joint_scale
from armlab.kin.velocity.answer import REACHED, answer, answer_in, full_rank_inverse, penrose
from armlab.kin.velocity.subspaces import (
    subspaces,
    task_axes,
    task_lengths,
    task_matrix,
    task_subspaces,
)
from support.arms import random_q

SHAPES = [(1, 1), (2, 2), (2, 3), (3, 2), (3, 3), (6, 6), (6, 7), (6, 4), (3, 9)]


def planar(*lengths, task="xy"):
    return Arm.from_dh([("R", length, 0, 0, 0) for length in lengths], task=task)


def of_rank(m, n, rank, rng):
    return rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))


def line_angle(a, b):
    """Return the angle between two lines, rad."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    return float(np.arctan2(np.linalg.norm(a - (a @ b) * b), abs(a @ b)))


# -- the notes -------------------------------------------------------------------------------------------------------


def test_the_3r_of_the_notes_has_rank_two_and_one_null_vector(truth):
    case = truth["C5.1.3-subspaces"]
    expected, tol = case["expected"], case["tol"]
    J = task_matrix(planar(1.0, 1.0, 1.0), case["inputs"]["q"])
    np.testing.assert_allclose(J, expected["J"], rtol=0, atol=tol)
    found = subspaces(J)
    assert found.rank == expected["rank"]
    null = found.null[:, 0]
    np.testing.assert_allclose(null * np.sign(null @ expected["nullspace_unit"]), expected["nullspace_unit"], atol=tol)
    whole = np.column_stack([found.row, found.null])
    assert np.linalg.matrix_rank(whole) == expected["dim_range_JT_plus_null"]


def test_the_singular_3r_of_the_notes_moves_along_x_only(truth):
    case = truth["C5.1.3-3R-J-b"]
    J = task_matrix(planar(1.0, 1.0, 1.0), case["inputs"]["q"])
    np.testing.assert_allclose(J, case["expected"]["J"], rtol=0, atol=case["tol"])
    found = subspaces(J)
    assert found.rank == case["expected"]["rank"]
    assert line_angle(found.range[:, 0], np.ravel(case["expected"]["range"])) <= case["tol"]
    assert line_angle(found.lost[:, 0], np.array([0.0, 1.0])) <= case["tol"]
    assert found.null.shape == (3, 2)


@pytest.mark.parametrize("name", ["C5.1.4-rrp-q3=0", "C5.1.4-rrp-q2=+90", "C5.1.4-rrp-q2=-90"])
def test_the_rrp_of_the_notes_loses_its_rank(truth, name):
    case = truth[name]
    arm = catalogue()["polar_rrp"].arm
    J = task_matrix(arm, case["inputs"]["q"])
    np.testing.assert_allclose(J, case["expected"]["J"], rtol=0, atol=case["tol"])
    assert task_subspaces(arm, case["inputs"]["q"]).rank == case["expected"]["rank"]
    assert np.linalg.det(J) == pytest.approx(case["expected"]["det"], abs=case["tol"])


def test_the_pseudo_inverse_of_the_notes(truth):
    case = truth["C5.2.2-pinv-3R"]
    J, v, expected, tol = case["inputs"]["J"], case["inputs"]["v"], case["expected"], case["tol"]
    found = answer(J, v)
    np.testing.assert_allclose(found.spaces.inverse, expected["Jpinv"], rtol=0, atol=tol)
    np.testing.assert_allclose(found.qdot, expected["qdot"], rtol=0, atol=tol)
    assert np.linalg.norm(found.qdot) == pytest.approx(expected["norm"], abs=tol)
    assert found.verdict == "many"


def test_the_null_space_term_of_the_notes(truth):
    case = truth["C5.2.3-nullspace"]
    J, expected = np.array(case["inputs"]["J"]), case["expected"]
    found = answer(J, case["inputs"]["v"])
    # In orthonormal bases (I - J# J) xi is the projection on N(J).
    qdot = found.qdot + found.free @ (found.free.T @ np.array(case["inputs"]["xi"]))
    np.testing.assert_allclose(qdot, expected["qdot"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(J @ qdot, expected["Jqdot"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize(("name", "verdict"), [("C5.2.3-sing2R-30", "none"), ("C5.2.3-sing2R-90", "many")])
def test_the_stretched_2r_of_the_notes(truth, name, verdict):
    case = truth[name]
    expected, tol, v = case["expected"], case["tol"], np.array(case["inputs"]["v"])
    J = task_matrix(planar(1.0, 1.0), case["inputs"]["q"])
    np.testing.assert_allclose(J, expected["J"], rtol=0, atol=tol)
    found = answer(J, v)
    np.testing.assert_allclose(found.spaces.inverse, expected["Jpinv"], rtol=0, atol=tol)
    np.testing.assert_allclose(found.qdot, expected["qdot"], rtol=0, atol=tol)
    np.testing.assert_allclose(found.reached, expected["v_perp"], rtol=0, atol=tol)
    assert found.verdict == verdict
    np.testing.assert_allclose(found.lost, v - expected["v_perp"], rtol=0, atol=tol)


def test_forbidden_is_what_is_outside_the_range_not_only_what_is_in_the_left_null_space(truth):
    J = np.array(truth["C5.1.3-3R-J-b"]["expected"]["J"], dtype=float)
    found = answer(J, [1.0, 1.0])
    assert np.abs(found.spaces.lost.T @ [1.0, 1.0]).max() < np.sqrt(2.0) - 0.1  # it is not in N(J^T)
    assert found.verdict == "none"
    assert np.linalg.norm(found.lost) == pytest.approx(
        float(truth["ERR-5.78"]["printed_value_if_wrong"]["printed_residual"])
    )


def test_small_singular_values_are_not_inverted(truth):
    J = np.array(truth["C5.2.3-sing2R-30"]["expected"]["J"])
    assert np.linalg.norm(subspaces(J).inverse, 2) == pytest.approx(
        truth["ERR-5.126"]["expected"]["corrected_residual"], abs=1e-6
    )


def test_shapes_of_the_decomposition_are_the_corrected_ones(rng):
    A = rng.normal(size=(2, 3))
    found = subspaces(A)
    assert found.U.shape == (2, 2)
    assert found.V.shape == (3, 3)
    Sigma = np.zeros((2, 3))
    np.fill_diagonal(Sigma, found.sigma)
    np.testing.assert_allclose(found.U @ Sigma @ found.V.T, A, rtol=0, atol=1e-14)


# -- any matrix ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("m", "n"), SHAPES)
def test_the_four_subspaces_of_any_rank_and_scale(m, n, rng):
    for rank in range(1, min(m, n) + 1):
        J = of_rank(m, n, rank, rng)
        for length, speeds in ((None, None), (rng.uniform(0.2, 3.0, m), rng.uniform(0.2, 3.0, n))):
            found = subspaces(J, length, speeds)
            assert found.rank == rank
            assert found.range.shape == (m, rank)
            np.testing.assert_allclose(found.lost.T @ J, np.zeros((m - rank, n)), rtol=0, atol=1e-12)
            np.testing.assert_allclose(J @ found.null, np.zeros((m, n - rank)), rtol=0, atol=1e-12)
            np.testing.assert_allclose(found.lost.T @ found.range, np.zeros((m - rank, rank)), rtol=0, atol=1e-12)
            np.testing.assert_allclose(found.row.T @ found.null, np.zeros((rank, n - rank)), rtol=0, atol=1e-12)
            # R(J): every column of J is a sum of its basis.
            assert np.linalg.matrix_rank(np.column_stack([found.range, J]), tol=1e-9) == rank
            assert np.linalg.matrix_rank(np.column_stack([found.row, J.T]), tol=1e-9) == rank
            scaled = J * found.speeds / found.lengths[:, None]
            inverse = found.inverse * found.lengths / found.speeds[:, None]
            assert max(penrose(scaled, inverse)) <= 1e-11


@pytest.mark.parametrize(("m", "n"), SHAPES)
def test_an_answer_is_the_shortest_and_what_it_misses_is_perpendicular(m, n, rng):
    for rank in range(1, min(m, n) + 1):
        J = of_rank(m, n, rank, rng)
        inside, outside = J @ rng.normal(size=n), rng.normal(size=m)
        found = answer(J, inside)
        assert found.verdict == ("one" if rank == n else "many")
        np.testing.assert_allclose(J @ found.qdot, inside, rtol=0, atol=1e-11)
        assert not found.lost.any()
        np.testing.assert_allclose(found.free.T @ found.qdot, 0.0, atol=1e-11)
        other = answer(J, outside)
        np.testing.assert_allclose(other.reached + other.lost, outside, rtol=0, atol=1e-14)
        np.testing.assert_allclose(J @ other.qdot, other.reached, rtol=0, atol=1e-11)
        np.testing.assert_allclose(J.T @ other.lost, np.zeros(n), rtol=0, atol=1e-11)
        if rank < m:
            assert other.verdict == "none"
            assert np.linalg.norm(other.lost) > REACHED


def test_almost_singular_and_singular_are_told_apart(rng):
    U, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    V, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    for least, rank in ((1e-6, 3), (1e-8, 3), (1e-10, 2), (0.0, 2)):
        assert subspaces(U @ np.diag([2.0, 1.0, least]) @ V.T).rank == rank
    assert subspaces(np.zeros((2, 3))).rank == 0
    assert answer(np.zeros((2, 2)), [1.0, 0.0]).verdict == "none"
    assert answer(np.zeros((2, 2)), [0.0, 0.0]).verdict == "many"


def test_the_three_formulas_for_full_rank_are_the_pseudo_inverse(rng):
    for (m, n), name in {(3, 3): "J^{-1}", (2, 4): "J^T(J J^T)^{-1}", (4, 2): "(J^T J)^{-1}J^T"}.items():
        J = rng.normal(size=(m, n))
        said, value = full_rank_inverse(J)
        assert said == name
        np.testing.assert_allclose(value, np.linalg.pinv(J), rtol=0, atol=1e-10)
    assert full_rank_inverse(of_rank(3, 3, 2, rng)) is None


def test_penrose_residuals_tell_what_is_no_pseudo_inverse(rng):
    J = rng.normal(size=(2, 3))
    left = np.linalg.pinv(J)
    assert max(penrose(J, left)) <= 1e-12
    other = left + np.linalg.svd(J)[2][2][:, None] @ np.ones((1, 2))  # a right inverse still
    one, two, three, four = penrose(J, other)
    assert max(one, two, three) <= 1e-12
    assert four > 1e-3


# -- arms ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", list(catalogue().robots))
def test_the_task_matrix_is_the_speed_of_the_task(key, rng):
    arm = catalogue()[key].arm
    for q in random_q(arm, rng, 5):
        J = task_matrix(arm, q)
        axes, p = task_axes(arm, q), len(arm.task.position)
        whole = arm.jacobian(q)
        np.testing.assert_allclose(J[:p], axes[:p] @ whole[:3], rtol=0, atol=1e-12)
        np.testing.assert_allclose(J[p:], axes[p:] @ whole[3:], rtol=0, atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(axes, axis=1), 1.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_a_jacobian_that_is_zero_but_for_rounding_has_rank_0(unit):
    """The cosine of a right angle is 6e-17; one microradian beside it the tool moves."""
    arm = planar(unit, 0.8 * unit, task="y")
    J = task_matrix(arm, [np.pi / 2, 0.0])
    assert J.any()
    assert subspaces(J).rank == 1  # A matrix by itself has no other size.
    found = task_subspaces(arm, [np.pi / 2, 0.0])
    assert found.rank == 0
    assert answer_in(found, J, [0.1 * unit]).verdict == "none"
    assert not answer_in(found, J, [0.1 * unit]).qdot.any()
    assert task_subspaces(arm, [np.pi / 2 + 1e-6, 0.0]).rank == 1


@pytest.mark.parametrize("stroke", [1e-6, 1.0, 1e6])
def test_slides_of_any_length_have_their_rank(stroke):
    rows = catalogue()["cartesian_3p"].arm.rows
    arm = Arm.from_dh(rows, limits=[[0.0, stroke]] * 3)
    assert task_subspaces(arm, [0.5 * stroke] * 3).rank == 3


def test_only_mixed_rows_and_columns_are_scaled():
    robots = catalogue()
    assert task_lengths(robots["elbow_3r"].arm).tolist() == [1.0, 1.0, 1.0]
    puma = robots["puma560"].arm
    assert task_lengths(puma).tolist() == [puma.length_scale] * 3 + [1.0] * 3
    assert joint_scale(puma).tolist() == [1.0] * 6
    assert joint_scale(robots["cartesian_3p"].arm).tolist() == [1.0] * 3
    polar = robots["polar_rrp"].arm
    np.testing.assert_allclose(joint_scale(polar), polar.speed_limits)


def test_the_rank_does_not_depend_on_the_unit_of_length(rng):
    J = of_rank(6, 6, 5, rng)
    metres = subspaces(J, 0.5)
    millimetres = subspaces(np.diag([1e3] * 3 + [1.0] * 3) @ J, 500.0)
    assert metres.rank == millimetres.rank == 5
    np.testing.assert_allclose(metres.sigma, millimetres.sigma, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        (([[1.0, np.nan]],), "J: expected finite numbers"),
        (([1.0, 2.0],), "J: expected shape"),
        (([[1.0, 2.0]], 0.5), "length: one number is for six rows"),
        (([[1.0, 2.0]], [-1.0]), "length: expected positive"),
        (([[1.0, 2.0]], None, [1.0]), "speeds: expected 2 positive"),
        (([[1.0, 2.0]], None, [1.0, 0.0]), "speeds: expected 2 positive"),
    ],
)
def test_bad_input_is_refused_in_words(arguments, match):
    with pytest.raises(InputError, match=match):
        subspaces(*arguments)


def test_a_velocity_of_another_size_is_refused():
    with pytest.raises(InputError, match="v: expected 2 finite numbers"):
        answer(np.eye(2), [1.0, 2.0, 3.0])
