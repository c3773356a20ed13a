"""Arms: forward kinematics in every form, and what a wrong table is told."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin import velocity
from armlab.kin.arm import Arm
from armlab.kin.dh import link_transform
from armlab.kin.workspace.measures import inverse_condition, sigma_min
from support.arms import frames_by_products, random_arm, random_q, tool_by_products

TABLES = ["2R", "3R", "RRP", "RRP-alt", "3R-elbow", "PUMA-A", "PUMA-B", "UR10", "UR10-notes", "SCARA"]
TABLES += ["UNIMATE", "STANFORD", "3P", "CYL", "R4", "MD16"]
TWO_R = [("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)]


@pytest.mark.parametrize("name", TABLES)
def test_the_tables_of_the_notes(truth, name):
    case = truth[f"DH-{name}"]
    arm = Arm.from_dh([tuple(row) for row in case["inputs"]["rows"]])
    T = arm.fk(case["inputs"]["q"])
    np.testing.assert_allclose(T, case["expected"]["T"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(arm.fk(case["inputs"]["q"][0]), case["expected"]["T"][0], rtol=0, atol=case["tol"])


def test_the_planar_2r_of_the_notes(truth):
    case = truth["C4.0-2R-fk"]
    l1, l2 = case["inputs"]["l1"], case["inputs"]["l2"]
    arm = Arm.from_dh([("R", l1, 0, 0, 0), ("R", l2, 0, 0, 0)])
    T = arm.fk(case["inputs"]["q"])
    np.testing.assert_allclose(T[:2, 3], case["expected"]["p"], rtol=0, atol=case["tol"])
    assert np.arctan2(T[1, 0], T[0, 0]) == pytest.approx(case["expected"]["phi"], abs=case["tol"])


@pytest.mark.parametrize("special", [False, True])
@pytest.mark.parametrize("n", [1, 2, 3, 5, 7, 12])
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_forward_kinematics_is_the_product_of_matrices(n, special, convention, rng):
    for _ in range(1 if n > 5 else 2):
        arm = random_arm(rng, n, convention=convention, special=special)
        for q in random_q(arm, rng, 3):
            np.testing.assert_allclose(arm.frames(q), frames_by_products(arm, q), rtol=0, atol=1e-13)
            T = tool_by_products(arm, q)
            np.testing.assert_allclose(arm.fk(q), T, rtol=0, atol=1e-13)
            np.testing.assert_allclose(arm.position(q), T[:3, 3], rtol=0, atol=1e-13)


@pytest.mark.parametrize("method", ["fk", "frames", "position", "jacobian", "manipulability"])
def test_a_batch_is_the_single_results_stacked(method, robot, rng):
    q = random_q(robot.arm, rng, 6).reshape(2, 3, robot.arm.n)
    batch = getattr(robot.arm, method)(q)
    singles = [[getattr(robot.arm, method)(row) for row in block] for block in q]
    np.testing.assert_allclose(batch, singles, rtol=0, atol=1e-12)


def test_no_rows_of_a_batch_are_no_results(robot):
    assert robot.arm.fk(np.empty((0, robot.arm.n))).shape == (0, 4, 4)


@pytest.mark.parametrize("method", ["fk", "frames", "position", "jacobian", "manipulability"])
def test_out_is_written_and_returned(method, robot, rng):
    q = random_q(robot.arm, rng, 5)
    expected = getattr(robot.arm, method)(q)
    out = np.full_like(expected, np.nan)
    assert getattr(robot.arm, method)(q, out=out) is out
    np.testing.assert_array_equal(out, expected)


def test_single_precision_stays_single(robot, rng):
    q = random_q(robot.arm, rng, 100)
    positions = robot.arm.position(q.astype(np.float32))
    assert positions.dtype == np.float32
    np.testing.assert_allclose(positions, robot.arm.position(q), rtol=0, atol=5e-6)


def test_batches_in_several_threads_do_not_touch_each_other(rng):
    """Each run has its own scratch memory."""
    arm = Arm.from_dh([*TWO_R, *TWO_R])
    batches = [rng.uniform(-3, 3, (n, 4)).astype(dtype) for n in (3, 500, 5000) for dtype in (np.float32, np.float64)]
    expected = [arm.jacobian(q) for q in batches]
    with ThreadPoolExecutor(3) as pool:
        for found, q in zip(pool.map(arm.jacobian, batches * 5), expected * 5, strict=True):
            np.testing.assert_array_equal(found, q)


def test_whole_numbers_are_joint_values_too():
    assert Arm.from_dh(TWO_R).position([0, 0]).tolist() == [1.5, 0.0, 0.0]


def test_wrong_shapes_are_named():
    arm = Arm.from_dh(TWO_R)
    with pytest.raises(InputError, match=r"q: expected shape \(\.\.\., 2\), got \(3,\)"):
        arm.fk([0.0, 0.0, 0.0])
    with pytest.raises(InputError, match=r"out: .* shape \(5, 3\)"):
        arm.position(np.zeros((5, 2)), out=np.empty((4, 3)))
    with pytest.raises(InputError, match="C-contiguous"):
        arm.position(np.zeros((5, 2)), out=np.empty((5, 6))[:, ::2])


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan])
@pytest.mark.parametrize("method", ["fk", "frames", "position", "jacobian", "manipulability"])
def test_a_configuration_that_is_not_finite_is_refused(method, value):
    arm = Arm.from_dh([*TWO_R, ("P", 0, 0, 0, 0)])
    for i in range(3):
        q = [0.0, 0.0, 0.0]
        q[i] = value
        with pytest.raises(InputError, match="q: expected 3 finite numbers"):
            getattr(arm, method)(q)


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan])
@pytest.mark.parametrize("method", ["fk", "frames", "position", "jacobian", "manipulability"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_row_of_a_batch_that_is_not_finite_gives_nan_and_leaves_the_others(method, value, dtype, rng):
    """Also in the joints a result does not depend on, and where its entries are constant."""
    arm = Arm.from_dh([*TWO_R, ("P", 0, 0, 0, 0)])
    q = rng.uniform(-1, 1, (6, 3)).astype(dtype)
    expected = getattr(arm, method)(q)
    for i in range(3):
        q[2 * i, i] = value
    found = getattr(arm, method)(q)
    assert np.isnan(found[::2]).all()
    np.testing.assert_array_equal(found[1::2], expected[1::2])


def test_large_finite_joint_values_are_no_reason_for_nan():
    slides = Arm.from_dh([("P", 0, 0, 0, 0), ("P", 0, 0, 0, 0)])
    q = np.array([[1e308, 0.0], [1e308, 0.0]])
    assert slides.frames(q)[:, 2, 2, 3].tolist() == [1e308, 1e308]


@pytest.mark.parametrize("q", ["ab", [None, 0.0], [[0.0], [0.0, 1.0]], [10**400, 0.0]])
def test_joint_values_that_are_no_numbers_are_refused(q):
    with pytest.raises(InputError, match=r"q: expected numbers of shape \(\.\.\., 2\)|q: expected 2 finite numbers"):
        Arm.from_dh(TWO_R).fk(q)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"rows": []}, "an arm has 1 to 12 joints, got 0"),
        ({"rows": TWO_R * 7}, "an arm has 1 to 12 joints, got 14"),
        ({"convention": "craig"}, "unknown name 'craig'"),
        ({"limits": [[0, 1]]}, r"limits: expected shape \(2, 2\), got \(1, 2\)"),
        ({"limits": [[0, 1], [1, 0]]}, r"limits of joint 2: the smaller comes first, got \[1\.0, 0\.0\]"),
        ({"limits": [[0, 1], [0, np.inf]]}, "limits of joint 2: expected finite numbers"),
        ({"speed_limits": [1.0, 0.0]}, "speed_limits: expected positive numbers"),
        ({"speed_limits": [1.0]}, "speed_limits: expected 2 numbers"),
        ({"acceleration_limits": [np.nan, 1.0]}, "acceleration_limits: expected positive numbers"),
        ({"tool": np.zeros((4, 4))}, "tool: the last row"),
        ({"task": "position"}, "task: unknown name 'position'"),
        ({"task": ["xy"]}, r"task: unknown name \['xy'\]"),
        (
            {"rows": [("R", 1, 90, 0, 0)]},
            r"row 1, alpha: expected radians, .* got 90; did you mean 90 degrees\? Then write math.radians\(90\)",
        ),
        ({"rows": [TWO_R[0], ("R", 1, 0, 0, -30.0)]}, "row 2, theta: expected radians, .* did you mean -30 degrees"),
        ({"rows": [{"kind": "R", "alpha": 6.3}]}, "row 1, alpha: expected radians"),
        ({"limits": [["0", "1"], ["0", "1"]]}, r"limits: expected numbers of shape \(2, 2\), got"),
        ({"rows": None}, "rows: expected a list of rows, got None"),
        ({"rows": "RR"}, "rows: expected a list of rows, got 'RR'"),
        ({"rows": [5]}, "row 1: expected a row with the entries .*, got 5"),
        ({"rows": [("R", 10**400, 0, 0, 0)]}, "row 1, a: expected a finite number, got 1000"),
        ({"limits": "abc"}, r"limits: expected numbers of shape \(2, 2\), got 'abc'"),
        ({"limits": [[0, 1], [0]]}, r"limits: expected numbers of shape \(2, 2\), got \[\[0, 1\], \[0\]\]"),
        ({"speed_limits": "abc"}, "speed_limits: expected 2 numbers, got 'abc'"),
        ({"base": [[10**400]]}, "base: expected a 4 x 4 matrix of numbers"),
    ],
)
def test_a_wrong_table_is_told_what_is_wrong(change, text):
    arguments = {"rows": TWO_R} | change
    with pytest.raises(InputError, match=text):
        Arm.from_dh(**arguments)


def test_a_full_turn_in_a_table_is_taken_and_a_larger_angle_once_it_is_reduced():
    quarter = Arm.from_dh([("R", 1.0, math.remainder(90.0, math.tau), 0.0, 0.0)])
    np.testing.assert_allclose(quarter.fk([0.0])[1:3, 2], [-math.sin(90.0), math.cos(90.0)], rtol=0, atol=1e-14)
    assert Arm.from_dh([("R", 1.0, math.tau, 0.0, -math.tau)]).n == 1


def test_arms_cannot_be_changed():
    arm = Arm.from_dh(TWO_R)
    with pytest.raises(AttributeError):
        arm.name = "other"
    with pytest.raises(ValueError, match="read-only"):
        arm.limits[0, 0] = 1.0


def test_limits_that_are_left_out_are_a_full_turn_and_a_metre():
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0)])
    np.testing.assert_allclose(arm.limits, [[-np.pi, np.pi], [0.0, 1.0]])
    assert np.all(np.isinf(arm.speed_limits))


def test_no_tool_point_is_farther_than_the_reach(robot, rng):
    p = robot.arm.position(random_q(robot.arm, rng, 2000)) - robot.arm.base[:3, 3]
    assert np.linalg.norm(p, axis=1).max() <= robot.arm.reach + 1e-12


def test_printing_shows_the_table_in_degrees():
    arm = Arm.from_dh(
        [("R", 0.3, np.pi / 2, 0.2, np.pi / 4), ("P", 0.0, 0.0, 0.1, 0.0)], name="Test arm", limits=[[-1, 1], [0, 0.5]]
    )
    assert str(arm).splitlines() == [
        "Test arm: 2 joints (RP), standard convention",
        "joint  a, m  alpha, deg      d, m  theta, deg                   limits",
        "  1 R   0.3          90       0.2     q1 + 45  -57.2958 to 57.2958 deg",
        "  2 P     0           0  q2 + 0.1           0               0 to 0.5 m",
        "task: position (x, y)",
    ]


def test_an_unknown_name_lists_the_others():
    with pytest.raises(UnknownName, match=r"did you mean 'pose'\? Available: phi, pose, x, x phi, xy,"):
        Arm.from_dh(TWO_R, task="pos")


NONSENSE = {
    "too short": [0.0],
    "a number": 1.0,
    "text": "ab",
    "numbers as text": ["1", "2"],
    "complex": [1j, 0.0],
    "ragged": [[0.0], [0.0, 1.0]],
    "nothing": None,
    "objects": [object(), object()],
    "a mapping": {},
    "another batch": np.zeros((2, 3)),
    "too large": [10**400, 0],
}


@pytest.mark.parametrize("given", NONSENSE)
@pytest.mark.parametrize(
    "ask",
    [
        *(Arm.fk, Arm.frames, Arm.position, Arm.jacobian, Arm.manipulability, Arm.clip, Arm.within_limits),
        *(velocity.singularities, velocity.task_matrix, velocity.task_subspaces, velocity.jacobian_at),
        *(velocity.jacobian_derivative, velocity.analytic_jacobian),
    ],
)
def test_whatever_takes_joint_values_says_what_it_expects(ask, given):
    with pytest.raises(InputError, match="q: expected"):
        ask(Arm.from_dh(TWO_R), NONSENSE[given])


@pytest.mark.parametrize("given", [g for g in NONSENSE if g not in ("too short",)])
def test_whatever_takes_a_jacobian_says_what_it_expects(given):
    asked = NONSENSE[given] if given != "another batch" else np.zeros((2, 3, 2))
    for ask in (velocity.dependent_columns, velocity.determinant_tests, velocity.subspaces):
        with pytest.raises(InputError):
            ask(asked)


@pytest.mark.parametrize("out", ["x", 3, [1.0], np.empty((4, 4), int), np.empty((4, 4), complex), np.empty((2, 2))])
def test_out_that_cannot_be_written_is_refused(out):
    with pytest.raises(InputError, match="out: expected a C-contiguous"):
        Arm.from_dh(TWO_R).fk([0.0, 0.0], out=out)
    fixed = np.empty((4, 4))
    fixed.setflags(write=False)
    with pytest.raises(InputError, match="writable"):
        Arm.from_dh(TWO_R).fk([0.0, 0.0], out=fixed)


def test_links_and_rows_that_are_no_numbers_are_refused():
    arm = Arm.from_dh(TWO_R)
    for link in (3, -1, 1.0, "1", None, [1]):
        with pytest.raises(InputError, match="link: expected"):
            velocity.link_jacobian(arm, [0.0, 0.0], link)
    with pytest.raises(InputError, match="alpha: expected numbers, got 'x'"):
        link_transform(0.0, "x", 0.0, 0.0)


@pytest.mark.parametrize("key", ["puma560", "panda", "planar_3r", "scara"])
@pytest.mark.parametrize(
    "ask",
    [
        *(velocity.jacobian_at, velocity.jacobian_derivative, sigma_min, inverse_condition),
        lambda arm, q: velocity.jacobian_rate(arm, q, np.ones(q.shape)),
        lambda arm, q: velocity.analytic_jacobian(arm, q) if arm.n > 4 else velocity.jacobian_at(arm, q, "tool"),
    ],
)
def test_what_follows_from_a_row_that_is_not_finite_is_nan_as_well(ask, key, rng):
    arm = catalogue()[key].arm
    q = rng.uniform(-1.0, 1.0, (4, arm.n))
    expected = ask(arm, q)
    q[1, 0], q[3, -1] = np.nan, np.inf
    found = ask(arm, q)
    assert np.isnan(found[1::2]).all()
    np.testing.assert_allclose(found[::2], expected[::2], rtol=0, atol=1e-13)
