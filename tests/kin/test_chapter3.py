"""Chapter 3 of the notes: the rest of its numbers, its errata and its cleared suspects, with the functions we have."""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from armlab.kin.arm import Arm
from armlab.kin.coordinates import cylindrical
from armlab.kin.euler import euler_angles
from armlab.kin.graph.expression import Graph, live_nodes
from armlab.kin.graph.vector import dot
from armlab.kin.rotations import (
    axis_angle,
    quaternion_from_rotation,
    rotation_about,
    rotation_from_axis_angle,
    rotation_from_quaternion,
    rotation_from_sequence,
    skew,
)
from armlab.kin.transforms import inverse, transform
from support.arms import random_pose

HERE = Path(__file__).parent

COVERED = {
    "C3.1-opcount": "test_chapter3.py",
    "C3.1-cyl": "test_coordinates.py",
    "C3.1-atan2": "test_coordinates.py",
    "C3.1-R": "test_rotations.py",
    "C3.2-rodrigues": "test_rotations.py",
    "C3.2-charpoly": "test_chapter3.py",
    "C3.2-inverse-axis-angle": "test_chapter3.py",
    "C3.2-inverse-near-": "test_chapter3.py",
    "C3.2-quaternion": "test_rotations.py",
    "C3.3-euler-zxz-inverse": "test_euler.py",
    "C3.3-euler-zxz-singpi": "test_euler.py",
    "C3.3-rpy-xyz": "test_euler.py",
    "C3.3-rpy-sing-neg": "test_euler.py",
    "C3.3-fixed-vs-moving": "test_euler.py",
}
"""Beginnings of identifiers of sections 3.1 to 3.3, and the file whose tests use them."""


def test_every_number_of_sections_3_1_to_3_3_is_used(truth):
    for name in truth:
        if name.startswith(("C3.1", "C3.2", "C3.3")):
            assert any(name.startswith(beginning) for beginning in COVERED), name
    for beginning, file in COVERED.items():
        lines = (HERE / file).read_text(encoding="utf-8").splitlines()
        assert any('truth[f"' + beginning in line or 'truth["' + beginning in line for line in lines), beginning


def symbols(graph, count, first):
    return [[graph.variable(first + count * i + j) for j in range(count)] for i in range(count)]


def product(A, B):
    return [[dot(row, column) for column in zip(*B, strict=True)] for row in A]


def operations(graph, outputs):
    kinds = [graph.nodes[index][0] for index in live_nodes(graph, outputs)]
    return {"mul": kinds.count("mul"), "add": kinds.count("add") + kinds.count("sub")}


def test_a_chain_of_vectors_takes_fewer_operations_than_the_matrix_first(truth):
    expected = truth["C3.1-opcount"]["expected"]
    graph = Graph()
    first, second, third = (symbols(graph, 3, 9 * k) for k in range(3))
    p = [[graph.variable(27 + k)] for k in range(3)]
    whole = product(product(product(first, second), third), p)
    assert operations(graph, [row[0] for row in whole]) == expected["matrix_first"]
    chain = product(first, product(second, product(third, p)))
    assert operations(graph, [row[0] for row in chain]) == expected["vector_chain"]


def test_the_eigenvalues_of_a_rotation(truth):
    """1 and the roots of lambda^2 - 2 cos(theta) lambda + 1 (3.60 has the other sign)."""
    case, rodrigues = truth["C3.2-charpoly"], truth["C3.2-rodrigues"]
    R = rotation_from_axis_angle(rodrigues["inputs"]["r"], case["inputs"]["theta"])
    expected = np.convolve(case["expected"]["quadratic"], [1.0, -1.0])
    np.testing.assert_allclose(np.poly(R), expected, rtol=0, atol=case["tol"])
    roots = np.sort_complex([complex(*root) for root in case["expected"]["roots"]] + [1.0])
    np.testing.assert_allclose(np.sort_complex(np.linalg.eigvals(R)), roots, rtol=0, atol=case["tol"])
    listed = np.array(rodrigues["expected"]["eig_real"]) + 1j * np.array(rodrigues["expected"]["eig_imag"])
    np.testing.assert_allclose(np.sort_complex(listed), roots, rtol=0, atol=case["tol"])


def test_axis_and_angle_of_the_notes(truth):
    """The function gives the solution with a positive angle; the other is its opposite."""
    case = truth["C3.2-inverse-axis-angle"]
    axis, angle = axis_angle(case["inputs"]["R"])
    for sign, name in ((1.0, "sol1"), (-1.0, "sol2")):
        expected = case["expected"][name]
        assert sign * angle == pytest.approx(expected["theta"], abs=case["tol"])
        np.testing.assert_allclose(sign * axis, expected["r"], rtol=0, atol=case["tol"])
        R = rotation_from_axis_angle(expected["r"], expected["theta"])
        np.testing.assert_allclose(R, case["inputs"]["R"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("near", ["1e-8-theta", "1e-4-theta", "1e-8-r", "1e-4-r", "pi-1e-7-r"])
def test_axis_and_angle_near_no_turn_and_near_a_half_turn(truth, near):
    case = truth[f"C3.2-inverse-near-{near}"]
    axis, angle = axis_angle(case["inputs"]["R"])
    if near.endswith("theta"):
        assert angle == pytest.approx(case["expected"]["theta"], rel=0, abs=case["tol"])
    else:
        np.testing.assert_allclose(axis, case["expected"]["r"], rtol=0, atol=case["tol"])


def largest(difference):
    return float(np.max(np.abs(difference)))


def rotation_of_a_vector():
    """ERR-3.15b: alpha = 0.4, theta = 0.9, |v| = 2."""
    a, t = 0.4, 0.9
    x, y = 2 * np.cos(a), 2 * np.sin(a)
    right = np.array([2 * np.cos(a + t), 2 * np.sin(a + t), 0.0])
    printed = [x * np.cos(t) - y * np.sin(a), x * np.sin(t) + y * np.cos(a), 0.0]
    ours = rotation_about("z", t) @ [x, y, 0.0]
    return np.linalg.norm(printed - right), largest(ours - right)


def cosine_of_the_angle():
    """ERR-3.5: R11 of Rz(60 degrees) is the cosine of the angle between the x axes."""
    angle = np.pi / 3
    R11 = rotation_about("z", angle)[0, 0]
    return angle - R11, abs(np.cos(angle) - R11)


def characteristic_polynomial():
    """ERR-3.60: lambda = exp(i theta), theta = 1.1."""
    R = rotation_from_axis_angle([1, 2, -2], 1.1)
    eigenvalues = np.linalg.eigvals(R)
    value = eigenvalues[np.argmax(eigenvalues.imag)]
    c = (np.trace(R) - 1) / 2
    return abs(value**2 + 2 * c * value + 1), abs(value**2 - 2 * c * value + 1)


def angle_from_the_skew_part():
    """ERR-3.66."""
    R = rotation_from_axis_angle([1, 2, -2], 1.1)
    root = np.sqrt((R[0, 1] - R[1, 0]) ** 2 + (R[0, 2] - R[2, 0]) ** 2 + (R[1, 2] - R[2, 1]) ** 2)
    return abs(np.arctan2(root / 2, np.trace(R) - 1) - 1.1), abs(axis_angle(R)[1] - 1.1)


def zxz_entry():
    """ERR-3.82: entry (2,1)."""
    phi, theta, psi = 0.3, 0.8, -0.5
    R21 = rotation_from_sequence("zxz", [phi, theta, psi])[1, 0]
    second = np.cos(phi) * np.cos(theta) * np.sin(psi)
    return (
        abs(np.sin(phi) * np.sin(psi) + second - R21),
        abs(np.sin(phi) * np.cos(psi) + second - R21),
    )


def zxz_at_pi():
    """ERR-3.94: phi = 0.3, psi = 0.5, theta = pi."""
    R = rotation_from_sequence("zxz", [0.3, np.pi, 0.5])
    solution = euler_angles(R, "zxz").solutions[0]
    ours = rotation_about("z", solution[0]) @ rotation_about("x", np.pi)
    assert solution[0] == pytest.approx(0.3 - 0.5, abs=1e-15)
    return largest(rotation_about("z", 0.8) - R), largest(ours - R)


def rpy_entry_12():
    """ERR-3.103a."""
    psi, theta, phi = 0.3, 0.8, -0.5
    R12 = rotation_from_sequence("xyz", [psi, theta, phi], fixed=True)[0, 1]
    second = np.sin(phi) * np.cos(psi)
    return (
        abs(np.cos(phi) * np.sin(psi) - second - R12),
        abs(np.cos(phi) * np.sin(theta) * np.sin(psi) - second - R12),
    )


def rpy_entry_23():
    """ERR-3.103b."""
    psi, theta, phi = 0.3, 0.8, -0.5
    R23 = rotation_from_sequence("xyz", [psi, theta, phi], fixed=True)[1, 2]
    second = np.cos(phi) * np.sin(psi)
    first = np.sin(phi) * np.sin(theta)
    return abs(first * np.cos(phi) - second - R23), abs(first * np.cos(psi) - second - R23)


def change_of_coordinates():
    """ERR-3.109: the x axis of B, (1, 0, 0) in B, seen from A."""
    T_ab = transform(rotation_about("z", 0.5))
    right = np.array([np.cos(0.5), np.sin(0.5), 0.0, 1.0])
    e = np.array([1.0, 0.0, 0.0, 1.0])
    return largest(inverse(T_ab) @ e - right), largest(T_ab @ e - right)


def signs_at_a_half_turn():
    """ERR-3.77: all signs are zero at pi."""
    r = np.array([1.0, 2.0, 2.0]) / 3.0
    R = 2.0 * np.outer(r, r) - np.eye(3)
    ours = rotation_from_quaternion(quaternion_from_rotation(R))
    return largest(rotation_of_the_printed_quaternion(R, 2, 0) - R), largest(ours - R)


ERRATA = {
    "ERR-3.5": cosine_of_the_angle,
    "ERR-3.15b": rotation_of_a_vector,
    "ERR-3.60": characteristic_polynomial,
    "ERR-3.66": angle_from_the_skew_part,
    "ERR-3.82": zxz_entry,
    "ERR-3.94": zxz_at_pi,
    "ERR-3.103a": rpy_entry_12,
    "ERR-3.103b": rpy_entry_23,
    "ERR-3.109": change_of_coordinates,
}


@pytest.mark.parametrize("name", list(ERRATA))
def test_what_is_printed_is_wrong_by_this_much_and_ours_is_right(truth, name):
    printed, ours = ERRATA[name]()
    assert printed == pytest.approx(truth[name]["printed_value_if_wrong"]["printed_residual"], rel=1e-3)
    assert ours < 1e-14


def rotation_of_the_printed_quaternion(R, i, j):
    """Return R(q) (3.73) of 3.76-3.79, with entry (i, j) taken from R13 for the sign of the second component."""
    d = np.diag(R)
    eta = np.sqrt(max(1 + d.sum(), 0.0)) / 2
    signs = np.sign([R[2, 1] - R[1, 2], R[0, 2] - R[i, j], R[1, 0] - R[0, 1]])
    eps = signs * np.sqrt(np.maximum(1 + 2 * d - d.sum(), 0.0)) / 2
    return (2 * eta**2 - 1) * np.eye(3) + 2 * np.outer(eps, eps) + 2 * eta * skew(eps)


def test_signs_of_quaternions(truth, rng):
    """ERR-3.78: the printed R32 fails for many rotations, R31 holds; so does ours, also at pi (ERR-3.77)."""
    R = Rotation.random(200, random_state=np.random.RandomState(rng.integers(2**31))).as_matrix()
    assert max(largest(rotation_of_the_printed_quaternion(one, 2, 1) - one) for one in R) > 1.0
    assert max(largest(rotation_of_the_printed_quaternion(one, 2, 0) - one) for one in R) < 1e-10
    assert largest(rotation_from_quaternion(quaternion_from_rotation(R)) - R) < 1e-14
    printed, ours = signs_at_a_half_turn()
    assert printed > 0.5
    assert truth["ERR-3.77"]["printed_value_if_wrong"]["printed_residual"] > 0.5
    assert ours < 1e-15


def test_at_no_turn_every_axis_is_right(truth, rng):
    """ERR-3.67: the axis is not defined, which is not the same as no solution."""
    assert "undefined" in truth["ERR-3.67"]["expected"]["correct"]
    for r in rng.normal(size=(3, 3)):
        np.testing.assert_array_equal(rotation_from_axis_angle(r, 0.0), np.eye(3))
    axis, angle = axis_angle(np.eye(3))
    assert angle == 0.0
    assert np.linalg.norm(axis) == 1.0


def test_skew_matrices_give_the_cross_product_and_no_quadratic_form(rng):
    """ERR-3.41: x^T S x is the number 0, and S(v) u is the cross product."""
    v, x = rng.normal(size=(2, 3))
    np.testing.assert_allclose(skew(v) @ x, np.cross(v, x), rtol=0, atol=1e-15)
    assert float(x @ skew(v) @ x) == pytest.approx(0.0, abs=1e-15)


def test_the_columns_of_a_rotation_expand_the_identity(rng):
    """ERR-3.35: C C^T is the sum of outer products of columns; for other matrices C^T C is not."""
    C = rotation_from_axis_angle(rng.normal(size=3), 0.7)
    np.testing.assert_allclose(sum(np.outer(c, c) for c in C.T), np.eye(3), rtol=0, atol=1e-15)
    B = rng.normal(size=(3, 3))
    outer = sum(np.outer(b, b) for b in B.T)
    assert largest(B @ B.T - outer) < 1e-14
    assert largest(B.T @ B - outer) > 0.1


def test_the_azimuth_is_the_six_branches_of_3_15(rng):
    """CLR-3.15; the range is (-pi, pi] (ERR-3.15t)."""
    points = np.concatenate([rng.normal(size=(500, 3)), np.eye(3)[:2], -np.eye(3)[:2]])
    theta = cylindrical(points)[1]
    for (x, y, _), found in zip(points, theta, strict=True):
        if x == 0.0:
            expected = np.pi / 2 * np.sign(y)
        else:
            expected = np.arctan(y / x) + (0.0 if x > 0 else np.pi if y >= 0 else -np.pi)
        assert found == pytest.approx(expected, abs=1e-15)
    assert theta.max() == np.pi
    assert theta.min() > -np.pi


def test_a_homogeneous_point_keeps_its_four_components(rng):
    """ERR-3.112: (A_p_AB + A_R_B B_p; 1)."""
    T, p = random_pose(rng), rng.normal(size=3)
    np.testing.assert_allclose(T @ [*p, 1.0], [*(T[:3, 3] + T[:3, :3] @ p), 1.0], rtol=0, atol=1e-15)


def test_rodrigues_is_the_exponential_and_has_the_symmetries_of_3_54(rng):
    """CLR-3.54."""
    for r, theta in zip(rng.normal(size=(20, 3)), rng.uniform(-3, 3, 20), strict=True):
        r /= np.linalg.norm(r)
        R = rotation_from_axis_angle(r, theta)
        np.testing.assert_allclose(R, expm(skew(r) * theta), rtol=0, atol=1e-14)
        np.testing.assert_allclose(R, rotation_from_axis_angle(-r, -theta), rtol=0, atol=1e-15)
        np.testing.assert_allclose(R, rotation_from_axis_angle(r, -theta).T, rtol=0, atol=1e-15)
        assert np.trace(R) == pytest.approx(1 + 2 * np.cos(theta), abs=1e-15)
        # CLR-3.63: the skew part, and the arccos away from its ends.
        np.testing.assert_allclose(R - R.T, 2 * np.sin(theta) * skew(r), rtol=0, atol=1e-15)
        assert axis_angle(R)[1] == pytest.approx(np.arccos((np.trace(R) - 1) / 2), abs=1e-12)


def test_products_of_quaternions_are_products_of_rotations(rng):
    """CLR-3.73: (eta1 eta2 - e1.e2, eta1 e2 + eta2 e1 + e1 x e2); the inverse has -eps."""
    for q1, q2 in rng.normal(size=(20, 2, 4)):
        eta = q1[0] * q2[0] - q1[1:] @ q2[1:]
        eps = q1[0] * q2[1:] + q2[0] * q1[1:] + np.cross(q1[1:], q2[1:])
        R = rotation_from_quaternion(q1) @ rotation_from_quaternion(q2)
        np.testing.assert_allclose(rotation_from_quaternion([eta, *eps]), R, rtol=0, atol=1e-14)
        back = rotation_from_quaternion(q1 * [1, -1, -1, -1])
        np.testing.assert_allclose(back, rotation_from_quaternion(q1).T, rtol=0, atol=1e-15)


def test_fixed_axes_are_the_reversed_moving_ones(rng):
    """CLR-3.95: from the definition 3.95, each turn about an axis that stayed where it was."""
    phi, theta, psi = rng.uniform(-3, 3, 3)
    step1 = rotation_about("z", phi)
    step2 = step1 @ (step1.T @ rotation_about("x", theta) @ step1)
    step3 = step2 @ (step2.T @ rotation_about("z", psi) @ step2)
    fixed = rotation_from_sequence("zxz", [phi, theta, psi], fixed=True)
    np.testing.assert_allclose(fixed, step3, rtol=0, atol=1e-15)
    reverse = rotation_from_sequence("zxz", [psi, theta, phi])
    np.testing.assert_allclose(reverse, step3, rtol=0, atol=1e-15)


@pytest.mark.parametrize("branch", [1.0, -1.0])
def test_the_inverse_formulas_of_the_notes_are_our_triples(branch, rng):
    """CLR-3.89: 3.89-3.93 and 3.106-3.108, both signs of the root."""
    for angles in rng.uniform(-3, 3, (20, 3)):
        R = rotation_from_sequence("zxz", angles)
        s = branch * np.hypot(R[0, 2], R[1, 2])
        printed = [np.arctan2(R[0, 2] / s, -R[1, 2] / s), np.arctan2(s, R[2, 2]), np.arctan2(R[2, 0] / s, R[2, 1] / s)]
        ours = euler_angles(R, "zxz").solutions[0 if branch > 0 else 1]
        np.testing.assert_allclose(ours, printed, rtol=0, atol=1e-12)
        R = rotation_from_sequence("xyz", angles, fixed=True)
        c = branch * np.hypot(R[2, 1], R[2, 2])
        printed = [np.arctan2(R[2, 1] / c, R[2, 2] / c), np.arctan2(-R[2, 0], c), np.arctan2(R[1, 0] / c, R[0, 0] / c)]
        ours = euler_angles(R, "xyz", fixed=True).solutions[0 if branch > 0 else 1]
        np.testing.assert_allclose(ours, printed, rtol=0, atol=1e-12)


def test_the_task_of_the_table(truth):
    """CLR-3.115, 3.116-3.121: the tool above the table, pointing down."""
    case = truth["C3.4.1-table-task"]
    px, py, h = (case["inputs"][name] for name in ("px", "py", "h"))
    T_te = transform(rotation_about("x", np.pi), [px, py, h])
    np.testing.assert_allclose(T_te[:3, :3], case["expected"]["R_TE"], rtol=0, atol=1e-15)
    np.testing.assert_allclose(T_te[:3, 3], case["expected"]["p_TE"], rtol=0, atol=case["tol"])
    T_wt = transform(rotation_about("z", 0.4), [1.0, 2.0, 0.7])
    np.testing.assert_allclose(inverse(T_wt) @ (T_wt @ T_te), T_te, rtol=0, atol=1e-15)


def test_the_two_robots_of_the_notes(truth):
    """ERR-3.132: two unit links do not reach; three do, in two ways."""
    arms = [Arm.from_dh([("R", 1, 0, 0, 0)] * n) for n in (2, 3)]
    hand, other = truth["C3.4.2-ATEA"], truth["C3.4.2-BTEB"]
    A_T_EA = arms[0].fk(hand["inputs"]["q_A"])
    np.testing.assert_allclose(A_T_EA, hand["expected"]["A_T_EA"], rtol=0, atol=hand["tol"])
    B_T_EB = np.array(other["expected"]["B_T_EB"])
    seen = inverse(other["inputs"]["w_T_B"]) @ np.array(other["expected"]["w_T_EB"])
    np.testing.assert_allclose(seen, B_T_EB, rtol=0, atol=other["tol"])
    distance = np.linalg.norm(B_T_EB[:3, 3])
    assert distance == pytest.approx(other["expected"]["dist"], abs=other["tol"])
    beyond = truth["ERR-3.132"]["printed_value_if_wrong"]["printed_residual"]
    assert distance - arms[0].reach == pytest.approx(beyond, abs=1e-6)
    solutions = truth["C3.4.2-qB-3R"]
    for q in solutions["expected"]["q_B"]:
        np.testing.assert_allclose(arms[1].fk(q), B_T_EB, rtol=0, atol=solutions["tol"])
