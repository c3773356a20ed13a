"""Formulas in symbols: they read like the book and they are right."""

import math
import re

import numpy as np
import pytest

from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.symbolic import PoseFormulas, angle_offsets, constants, pose_formulas
from armlab.kin.transforms import transform
from support.arms import random_arm, random_q

H = math.pi / 2
ELBOW = Arm.from_dh([("R", 0, H, 0.6, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
SCARA = Arm.from_dh([("R", 0.3, 0, 0.4, 0), ("R", 0.2, math.pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])


def test_formulas_evaluate_to_forward_kinematics(robot, rng):
    formulas, values = pose_formulas(robot.arm), constants(robot.arm)
    for q in random_q(robot.arm, rng, 3):
        names = values | {f"q{i + 1}": value for i, value in enumerate(q)}
        names |= {"sin": math.sin, "cos": math.cos}
        T = np.linalg.inv(robot.arm.base) @ robot.arm.fk(q)
        for name, text in formulas.items():
            expected = T["xyz".index(name[1]), 3] if name[0] == "p" else T[int(name[1]) - 1, int(name[2]) - 1]
            assert eval(text, {}, names) == pytest.approx(expected, abs=1e-12), (name, text)


def test_a_twist_that_is_no_quarter_turn_is_a_symbol_too():
    arm = Arm.from_dh([("R", 0.2, 0.3, 0.1, 0), ("R", 0.4, 0, 0, 0)])
    assert "cos(alpha1)" in pose_formulas(arm)["py"]
    names = constants(arm) | {"q1": 0.4, "q2": -0.7, "sin": math.sin, "cos": math.cos}
    assert eval(pose_formulas(arm)["py"], {}, names) == pytest.approx(arm.position([0.4, -0.7])[1], abs=1e-14)


@pytest.mark.parametrize(
    ("arm", "name", "style", "formula"),
    [
        (ELBOW, "px", "text", "a2*cos(q1)*cos(q2) + a3*cos(q1)*cos(q2 + q3)"),
        (ELBOW, "pz", "text", "d1 + a2*sin(q2) + a3*sin(q2 + q3)"),
        (ELBOW, "px", "latex", "a_2 c_1 c_2 + a_3 c_1 c_{23}"),
        (ELBOW, "r33", "latex", "0"),
        (ELBOW, "r23", "latex", "-c_1"),
        (SCARA, "pz", "latex", "d_1 - q_3"),
        (SCARA, "r11", "latex", r"\cos(q_1 + q_2 - q_4)"),
        (SCARA, "r13", "text", "0"),
    ],
)
def test_formulas_read_like_the_book(arm, name, style, formula):
    assert pose_formulas(arm, style)[name] == formula


def test_an_offset_that_is_no_quarter_turn_belongs_to_the_angle():
    """theta_2 = q_2 + 0.3: c_12 is short for the cosine of the table's angles, and Python gets the offset."""
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, H), ("R", 0.5, 0.0, 0.0, 0.3), ("P", 0.0, 0.0, 0.0, 0.7)])
    assert angle_offsets(arm) == {2: 0.3}
    assert pose_formulas(arm, "latex")["py"] == "a_1 c_1 + a_2 c_{12}"
    assert pose_formulas(arm)["py"] == "a1*cos(q1) + a2*cos(q1 + (q2 + 0.3))"
    turned = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, math.pi, 0.0, -0.3), ("R", 0.1, 0.0, 0.0, 0.0)])
    assert pose_formulas(turned, "latex")["r11"] == r"\cos(q_1 + \theta_2 - q_3)"


# The first counts as zero: three angles of it, on an arm of about a metre.
@pytest.mark.parametrize(
    ("offset", "tolerance"), [(1e-12, 4e-12), (1e-7, 1e-12), (0.4, 1e-12), (-2.0, 1e-12), (H + 1e-7, 1e-12)]
)
def test_formulas_with_offsets_evaluate_to_forward_kinematics(offset, tolerance, rng):
    rows = [("R", 0.3, 0.2, 0.1, offset), ("P", 0.2, H, 0.3, offset), ("R", 0.4, 0.0, 0.2, -offset)]
    for convention in ("standard", "modified"):
        arm = Arm.from_dh(rows, convention)
        for q in random_q(arm, rng, 3):
            names = constants(arm) | {f"q{i + 1}": value for i, value in enumerate(q)}
            names |= {"sin": math.sin, "cos": math.cos}
            T = arm.fk(q)
            formulas = pose_formulas(arm)
            for k, axis in enumerate("xyz"):
                assert eval(formulas[f"p{axis}"], {}, names) == pytest.approx(T[k, 3], abs=tolerance)
                assert eval(formulas[f"r1{k + 1}"], {}, names) == pytest.approx(T[0, k], abs=tolerance)


@pytest.mark.parametrize("tool", [np.eye(4), transform(rotation_about("z", 0.3), [3.67e-6, 0.2, 0.1])])
def test_numbers_of_a_product_are_one_number_with_a_power_of_ten_in_latex(tool, rng):
    """In LaTeX two numbers side by side read as one, and an exponent e as a letter."""
    arm = Arm.from_dh([("P", 0, H, 0, H / 3), ("R", 0.4, 0, 0, 0)], tool=tool)
    formulas = pose_formulas(arm, "latex")
    for latex in formulas.values():
        assert not re.search(r"\d *e[-+]?\d|\d [\d.]|\}\s+\d", re.sub(r"[cs]_\S+", "f", latex)), latex
    if tool[0, 3]:
        assert r"\cdot 10^{-6} c_2" in formulas["px"]
    for q in random_q(arm, rng, 3):
        names = constants(arm) | {"q1": q[0], "q2": q[1], "sin": math.sin, "cos": math.cos}
        assert eval(pose_formulas(arm)["px"], {}, names) == pytest.approx(arm.fk(q)[0, 3], abs=1e-12)


@pytest.mark.parametrize("quarter", [1.57079632679, 1.5707963268])
def test_a_quarter_turn_with_few_decimals_is_one_in_the_formulas(quarter):
    for style in ("text", "latex"):
        found, exact = (
            pose_formulas(Arm.from_dh([("R", 0.3, angle, 0, angle), ("R", 0.5, 0, 0, 0)]), style)
            for angle in (quarter, H)
        )
        assert found == exact
    assert found["px"] == "-a_1 s_1 - a_2 s_1 c_2"


def test_terms_are_counted_as_they_are_printed(robot, rng):
    arms = [robot.arm] + [random_arm(rng, int(rng.integers(1, 6)), special=bool(i % 2)) for i in range(6)]
    for arm in arms:
        terms = PoseFormulas(arm).terms
        for name, formula in pose_formulas(arm, "latex").items():
            outside = re.sub(r"\\(?:sin|cos)\([^()]*\)", "", formula)
            assert terms[name] == len(re.findall(r" [+-] ", outside)) + 1, (name, formula)


def test_entries_with_too_many_terms_are_not_printed():
    pose = PoseFormulas(Arm.from_dh([("R", 0.1, 0.6, 0.1, 0.0)] * 12))
    assert min(pose.terms.values()) > 10_000
    assert pose.printed("latex", 100) == {}
    few = PoseFormulas(Arm.from_dh([("R", 0.1, 0.6, 0.1, 0.0)] * 4))
    kept = few.printed("text", few.terms["r13"])
    assert kept.keys() == {name for name, count in few.terms.items() if count <= few.terms["r13"]}
    assert 0 < len(kept) < 12
