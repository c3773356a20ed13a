"""Determinants in symbols: those of the notes, and every one against the number."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.symbolic import constants
from armlab.kin.velocity._trigonometric import TooLong, Trigonometric
from armlab.kin.velocity.determinant import determinant, determinant_of
from armlab.kin.velocity.subspaces import task_matrix
from support.arms import random_q

ROBOTS = catalogue().robots


def value_of(arm, text, q):
    names = {"sin": math.sin, "cos": math.cos, **constants(arm)} | {f"q{i + 1}": v for i, v in enumerate(q)}
    return eval(text, {"__builtins__": {}}, names)


def test_the_2r_of_the_notes(truth):
    case = truth["C5.1.4-2R-det"]
    arm = Arm.from_dh([("R", case["inputs"]["l1"], 0, 0, 0), ("R", case["inputs"]["l2"], 0, 0, 0)])
    found = determinant(arm)
    assert [(minor.joints, minor.text, minor.latex) for minor in found.minors] == [
        ((1, 2), "a1*a2*sin(q2)", r"a_1\,a_2\,s_2")
    ]
    assert found.square
    assert value_of(arm, found.minors[0].text, case["inputs"]["q"]) == pytest.approx(
        case["expected"]["det"], abs=case["tol"]
    )


def test_the_elbow_arm_of_the_notes(truth):
    case = truth["C5.1.4-elbow-det"]
    d1, l2, l3 = (case["inputs"][name] for name in ("d1", "L2", "L3"))
    arm = Arm.from_dh([("R", 0, math.pi / 2, d1, 0), ("R", l2, 0, 0, 0), ("R", l3, 0, 0, 0)])
    (minor,) = determinant(arm).minors
    assert minor.text == "-a2*a3*sin(q3)*(a2*cos(q2) + a3*cos(q2 + q3))"
    assert minor.latex == r"-a_2\,a_3\,s_3\,\left(a_2\,c_2 + a_3\,c_{23}\right)"
    assert value_of(arm, minor.text, case["inputs"]["q"]) == pytest.approx(case["expected"]["det"], abs=case["tol"])


def test_quarter_turns_with_few_decimals_and_small_lengths_of_the_tool_are_written_as_such():
    rounded, exact = (
        determinant(Arm.from_dh([("R", 0, angle, 0.3, 0), ("R", 0.4, 0, 0, angle), ("R", 0.2, 0, 0, 0)]))
        for angle in (1.57079632679, math.pi / 2)
    )
    assert rounded.minors == exact.minors
    tool = np.eye(4)
    tool[1, 3] = 3.67e-6
    (minor,) = determinant(Arm.from_dh([("R", 0.4, 0, 0, 0), ("R", 0.2, 0, 0, 0)], tool=tool)).minors
    assert r"3.67\cdot 10^{-6}\," in minor.latex


def test_the_rrp_of_the_notes_vanishes_where_they_say(truth):
    arm = ROBOTS["polar_rrp"].arm
    (minor,) = determinant(arm).minors
    assert minor.text == "q3**2*cos(q2)"
    for name in ("C5.1.4-rrp-q3=0", "C5.1.4-rrp-q2=+90", "C5.1.4-rrp-q2=-90"):
        assert value_of(arm, minor.text, truth[name]["inputs"]["q"]) == pytest.approx(0.0, abs=truth[name]["tol"])


def test_arms_with_a_spherical_wrist_have_three_factors():
    text = determinant(ROBOTS["puma560"].arm).minors[0].text
    assert text.startswith("a2*sin(q5)*(")
    assert text.count("(a") == 2
    assert determinant(ROBOTS["stanford"].arm).minors[0].text == "q3**2*sin(q2)*sin(q5)"


@pytest.mark.parametrize("key", ["ur3e", "ur5e", "ur10", "ur10e", "ur10_notes"])
def test_arms_with_three_parallel_axes_have_an_elbow_a_wrist_and_a_shoulder(key):
    (minor,) = determinant(ROBOTS[key].arm).minors
    assert minor.joints == (1, 2, 3, 4, 5, 6)
    for factor in ("sin(q3)", "sin(q5)", "(a2*cos(q2) + a3*cos(q2 + q3) + d5*sin(q2 + q3 + q4))"):
        assert minor.text.count(factor) == 1
    assert r"d_5\,s_{234}" in minor.latex


@pytest.mark.parametrize("key", ["scorbot", "youbot"])
def test_a_joint_that_never_moves_the_tool_has_no_minors(key):
    found = determinant(ROBOTS[key].arm)
    assert not found.square
    assert [minor.joints for minor in found.minors] == [(1, 2, 3), (1, 2, 4), (1, 3, 4), (2, 3, 4)]
    assert found.minors[-1].text == "0"


def test_three_parallel_axes_of_any_arm_of_their_kind(rng):
    """Random lengths, both conventions of signs of the twists, and an offset wherever the kind allows one."""
    for signs in ((1, 1, -1), (-1, 1, -1), (1, -1, 1)):
        first, fourth, fifth = (sign * math.pi / 2 for sign in signs)
        a2, a3, d1, d2, d4, d5, d6 = rng.uniform(0.1, 1.0, 7)
        rows = [("R", 0.1, first, d1, 0), ("R", a2, 0, d2, 0), ("R", a3, 0, 0, 0)]
        rows += [("R", 0, fourth, d4, 0), ("R", 0, fifth, d5, 0), ("R", 0, 0, d6, 0)]
        arm = Arm.from_dh(rows, tool=np.diag([1.0, -1.0, -1.0, 1.0]))
        (minor,) = determinant(arm).minors
        for q in random_q(arm, rng, 10):
            assert value_of(arm, minor.text, q) == pytest.approx(np.linalg.det(arm.jacobian(q)), abs=1e-12)


def test_wide_jacobians_have_minors():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 3, task="xy")
    found = determinant(arm)
    assert not found.square
    assert [minor.joints for minor in found.minors] == [(1, 2), (1, 3), (2, 3)]
    assert found.minors[2].text == "a2*a3*sin(q3)"


def test_every_formula_is_the_determinant(rng):
    known = {key: robot.arm for key, robot in ROBOTS.items() if determinant(robot.arm) is not None}
    assert len(known) >= 15
    for key, arm in known.items():
        for q in random_q(arm, rng, 20):
            J = task_matrix(arm, q)
            for minor in determinant(arm).minors:
                expected = np.linalg.det(J[:, [joint - 1 for joint in minor.joints]])
                assert value_of(arm, minor.text, q) == pytest.approx(expected, abs=1e-12), key


def test_random_planar_arms_and_arms_with_general_twists(rng):
    for _ in range(12):
        a, d, alpha, theta = (rng.uniform(-1.0, 1.0, 3) for _ in range(4))
        kinds = rng.choice(["R", "R", "P"], 3)
        arm = Arm.from_dh([tuple(row) for row in zip(kinds, a, alpha, d, theta, strict=True)], task="xyz")
        found = determinant(arm)
        if found is None:
            continue
        q = rng.uniform(-2.0, 2.0, 3)
        for minor in found.minors:
            expected = np.linalg.det(task_matrix(arm, q)[:, [joint - 1 for joint in minor.joints]])
            assert value_of(arm, minor.text, q) == pytest.approx(expected, abs=1e-10)


@pytest.mark.parametrize("key", ["x", "y", "z", "xz", "yz", "x phi", "y phi", "xy", "xy phi"])
def test_some_coordinates_of_arms_with_parallel_axes(key, rng):
    """Joint axes that turn with the arm would give other minors where only one of x and y is asked."""
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0.3), ("P", 0, 0, 0, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)], task=key)
    for q in random_q(arm, rng, 3):
        J = task_matrix(arm, q)
        for minor in determinant(arm).minors:
            expected = np.linalg.det(J[:, [joint - 1 for joint in minor.joints]])
            assert value_of(arm, minor.text, q) == pytest.approx(expected, abs=1e-12)


def test_larger_arms_have_none():
    assert determinant(ROBOTS["iiwa7"].arm) is None
    assert determinant(ROBOTS["manseur_doty"].arm) is None


def test_what_is_alone_in_a_row_is_a_factor():
    a, b = Trigonometric.symbol("a1", 2), Trigonometric.wave((0, 1), True)
    zero, one = Trigonometric.number(0.0, 2), Trigonometric.number(1.0, 2)
    product = determinant_of([[zero, a, zero], [b, one, one], [one, one, one]])
    assert product.powers == (("a1", 1),)
    assert product.number == pytest.approx(-1.0)
    assert determinant_of([[a, zero], [b, zero]]).number == 0.0


def test_products_of_waves_cancel():
    c, s = (Trigonometric.wave((1, 0), sine) for sine in (False, True))
    assert (c * c + s * s - Trigonometric.number(1.0, 2)).is_zero


def test_arms_with_general_twists_are_given_up_soon_and_not_worked_at_for_minutes(rng):
    arm = Arm.from_dh([("R", *rng.uniform(0.1, 1.0, 4).tolist()) for _ in range(4)], task="xyz")
    assert determinant(arm) is None
    names = [Trigonometric.symbol(f"a{k}", 2) for k in range(40)]
    long = sum(names[1:], names[0])
    with pytest.raises(TooLong):
        long * long
