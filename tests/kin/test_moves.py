"""The elementary moves of a row, and the frame on its way along them."""

import math

import numpy as np
import pytest

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.dh import Row, link_transform
from armlab.kin.moves import Move, factors, matrix_of, moves_of, partial_product
from support.arms import random_arm, random_q

H = math.pi / 2


def both_ways(arm):
    return arm, converted(arm, "modified" if arm.convention == "standard" else "standard")


def test_the_moves_of_a_revolute_row_in_the_standard_order():
    assert moves_of(Row("R", a=0.5, alpha=0.3, d=0.2, theta=0.1), 1.0, "standard") == (
        Move("theta", "z", "turn", 1.1, True),
        Move("d", "z", "shift", 0.2, False),
        Move("a", "x", "shift", 0.5, False),
        Move("alpha", "x", "turn", 0.3, False),
    )


def test_the_moves_of_a_prismatic_row_in_the_modified_order():
    assert moves_of(Row("P", a=0.5, alpha=0.3, d=0.25, theta=0.1), 0.5, "modified") == (
        Move("alpha", "x", "turn", 0.3, False),
        Move("a", "x", "shift", 0.5, False),
        Move("theta", "z", "turn", 0.1, False),
        Move("d", "z", "shift", 0.75, True),
    )


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_four_matrices_make_the_matrix_of_the_row(convention, rng):
    for kind in ("R", "P"):
        a, alpha, d, theta, q = rng.uniform(-1, 1, 5)
        matrices = [matrix_of(move) for move in moves_of(Row(kind, a, alpha, d, theta), q, convention)]
        angle, length = (theta + q, d) if kind == "R" else (theta, d + q)
        expected = link_transform(a, alpha, length, angle, convention)
        np.testing.assert_allclose(np.linalg.multi_dot(matrices), expected, rtol=0, atol=1e-15)


def test_parts_of_a_move_add_up(rng):
    for move in moves_of(Row("R", a=0.5, alpha=0.3, d=0.2, theta=0.1), 1.0, "standard"):
        np.testing.assert_array_equal(matrix_of(move, 0.0), np.eye(4))
        both = matrix_of(move, 0.3) @ matrix_of(move, 0.7)
        np.testing.assert_allclose(both, matrix_of(move), rtol=0, atol=1e-15)


def test_a_constant_quarter_turn_is_exact():
    expected = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]
    assert matrix_of(Move("alpha", "x", "turn", H, False)).tolist() == expected


def test_every_row_arrives_in_the_next_frame_and_the_tool_step_in_the_tool(robot, rng):
    rounding = 1e-14 * max(1.0, robot.arm.reach)
    for arm in both_ways(robot.arm):
        for q in random_q(arm, rng, 3):
            frames = arm.frames(q)
            for row in range(arm.n):
                np.testing.assert_array_equal(partial_product(arm, q, row, 0.0), frames[row])
                np.testing.assert_allclose(partial_product(arm, q, row, 4.0), frames[row + 1], rtol=0, atol=rounding)
            np.testing.assert_array_equal(partial_product(arm, q, arm.n, 0), frames[-1])
            np.testing.assert_allclose(partial_product(arm, q, arm.n, 1.0), arm.fk(q), rtol=0, atol=rounding)


def test_the_film_never_jumps(rng):
    """A step of progress moves the frame by no more than the move's own share."""
    for convention in ("standard", "modified"):
        arm = random_arm(rng, 3, convention=convention)
        q = random_q(arm, rng)
        for row in range(arm.n + 1):
            whole = 4.0 if row < arm.n else 1.0
            steps = np.linspace(0.0, whole, 801)
            film = np.array([partial_product(arm, q, row, min(float(s), whole)) for s in steps])
            amounts = [abs(m.amount) for m in factors(arm, q, row, 0).moves] if row < arm.n else [math.pi, 1.0]
            # An entry changes no faster than the amount of a move; the tool's two happen together.
            assert np.abs(np.diff(film, axis=0)).max() <= 1.01 * max(amounts) * whole / 800 + 1e-12


def test_factors_hold_the_partial_move_and_the_growing_product():
    arm = Arm.from_dh([("R", 0.5, H, 0.2, 0.0), ("P", 0.1, 0.0, 0.3, 0.0)])
    found = factors(arm, [1.0, 0.4], 0, 2.5)
    assert found.parts == (1.0, 1.0, 0.5, 0.0)
    assert [move.symbol for move in found.moves] == ["theta", "d", "a", "alpha"]
    c, s = math.cos(1.0), math.sin(1.0)
    expected = [[c, -s, 0, 0.25 * c], [s, c, 0, 0.25 * s], [0, 0, 1, 0.2], [0, 0, 0, 1]]
    np.testing.assert_allclose(found.product, expected, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(found.matrices[3], np.eye(4))
    assert found.matrices[2][0, 3] == 0.25


def test_the_partial_product_is_the_start_times_the_growing_product(robot, rng):
    q, row, progress = random_q(robot.arm, rng), robot.arm.n - 1, 1.7
    expected = robot.arm.frames(q)[row] @ factors(robot.arm, q, row, progress).product
    np.testing.assert_array_equal(partial_product(robot.arm, q, row, progress), expected)


def test_half_of_a_tool_step_is_half_its_turn_and_half_its_shift():
    tool = [[0, -1, 0, 0.2], [1, 0, 0, 0], [0, 0, 1, 0.4], [0, 0, 0, 1]]
    arm = Arm.from_dh([("R", 0, 0, 0, 0)], tool=tool)
    r = math.sqrt(0.5)
    expected = [[r, -r, 0, 0.1], [r, r, 0, 0], [0, 0, 1, 0.2], [0, 0, 0, 1]]
    np.testing.assert_allclose(partial_product(arm, [0.0], 1, 0.5), expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("row", "progress", "text"),
    [
        (3, 0.0, "row: expected 0 to 2, got 3"),
        (-1, 0.0, "row: expected a whole number, at least 0, got -1"),
        (0, 4.1, "progress: expected a number from 0 to 4, got 4.1"),
        (2, 1.5, "progress: expected a number from 0 to 1, got 1.5"),
        (0, math.nan, "progress: expected a number from 0 to 4, got nan"),
    ],
)
def test_a_step_outside_the_film_is_refused(row, progress, text):
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)])
    with pytest.raises(InputError, match=text):
        partial_product(arm, [0.0, 0.0], row, progress)


def test_the_tool_step_has_no_factors_and_other_conventions_no_moves():
    arm = Arm.from_dh([("R", 1, 0, 0, 0)])
    with pytest.raises(InputError, match="row: expected 0 to 0, got 1"):
        factors(arm, [0.0], 1, 0.5)
    with pytest.raises(InputError, match="q: expected 1 finite numbers"):
        factors(arm, [0.0, 1.0], 0, 0.5)
    with pytest.raises(UnknownName, match="Available: modified, standard"):
        moves_of(arm.rows[0], 0.0, "craig")
