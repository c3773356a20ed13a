"""The sheet of formulas: they are compared with the core, errata are not repeated, and LaTeX has all that they use."""

import math
import re

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from armlab.content.errata import errata
from armlab.content.formulas import parse_formulas, sheet
from armlab.content.formulas_latex import latex_sheet
from armlab.content.robots import catalogue
from armlab.errors import ContentError, UnknownName
from armlab.kin.dh import link_transform
from armlab.kin.rotations import rotation_about
from armlab.window.formulas_page import formulas_page
from support.latex_values import matrix, right_side, value

PHI, THETA, PSI = 0.7, -0.4, 1.9

NO_FORMULA = {
    "1.41": "intervals of an example",
    "2.AB": "a direction",
}
"""Errata that are wrong if copied and are no formula of the course."""


def entry(key):
    return next(each for each in sheet().formulas if each.key == key)


def turned(**angles):
    """Return cosines and sines by the names that the sheet gives them."""
    return {
        f"{f}_{name}": getattr(math, long)(a) for name, a in angles.items() for f, long in (("c", "cos"), ("s", "sin"))
    }


def rotation(axes, *angles):
    return np.linalg.multi_dot(
        [np.eye(3), *(rotation_about(axis, angle) for axis, angle in zip(axes, angles, strict=True))]
    )


ANGLES = turned(phi=PHI, theta=THETA, psi=PSI)


# --- Correct forms


@pytest.mark.parametrize(("key", "axes"), [("zxz", "zxz"), ("rpy", "zyx")])
def test_matrices_of_three_angles(key, axes):
    np.testing.assert_allclose(matrix(entry(key), **ANGLES), rotation(axes, PHI, THETA, PSI), atol=1e-12)


def test_the_matrix_of_denavit_and_hartenberg():
    a, alpha, d, theta = 0.3, 0.8, -0.2, 1.1
    found = matrix(entry("dh"), a=a, d=d, **turned(theta=theta, alpha=alpha))
    np.testing.assert_allclose(found, link_transform(a, alpha, d, theta), atol=1e-12)


def test_rates_of_angles_give_the_angular_velocity():
    rates, h = np.array([0.3, -0.5, 0.2]), 1e-6  # of psi, theta, phi

    def at(t):
        psi, theta, phi = np.array([PSI, THETA, PHI]) + t * rates
        return rotation("zyx", phi, theta, psi)

    spin = (at(h) - at(-h)) / (2 * h) @ at(0).T
    omega = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
    T = next(tex for tex in entry("rates").tex if tex.startswith("T"))
    columns = matrix(type(entry("rates"))("", (T,)), **ANGLES)
    np.testing.assert_allclose(np.array(columns) @ rates, omega, atol=1e-8)


def test_the_jacobian_of_the_planar_arm():
    q = np.array([0.4, 1.3])
    arm = catalogue()["planar_2r_unequal"].arm
    l1, l2 = (row.a for row in arm.rows)
    names = {"l_1": l1, "l_2": l2, **turned(**{"1": q[0], "2": q[1], "12": q.sum()})}
    np.testing.assert_allclose(matrix(entry("j_2r"), **names), arm.jacobian(q)[:2], atol=1e-12)
    assert value(right_side(entry("j_2r"), r"\det J"), **names) == pytest.approx(np.linalg.det(arm.jacobian(q)[:2]))


@pytest.mark.parametrize("theta", [1e-9, 0.3, 2.0, math.pi - 1e-9])
def test_the_angle_of_a_rotation(theta):
    r = np.array([1.0, -2.0, 2.0]) / 3.0
    R = np.eye(3) + math.sin(theta) * np.cross(np.eye(3), r) + (1 - math.cos(theta)) * (np.outer(r, r) - np.eye(3))
    names = {f"R_{i + 1}{j + 1}": R[i, j] for i in range(3) for j in range(3)}
    first, second, third = right_side(entry("angle"), "d").strip("() ").split(r",\;")
    d = np.array([value(part.strip("() "), **names) for part in (first, second, third)])
    tex = right_side(entry("angle"), r"\theta").replace(r"\|d\|", "n").replace(r"\text{tr}\,R", "t").replace(r"\pm", "")
    assert value(tex, n=np.linalg.norm(d), t=np.trace(R)) == pytest.approx(theta, abs=1e-12)
    np.testing.assert_allclose(d / (2 * math.sin(theta)), r, atol=1e-6)


def test_both_solutions_of_the_planar_arm():
    l1, l2, x, y = 0.7, 0.5, 0.3, 0.8
    names = {"l_1": l1, "l_2": l2, "p_x": x, "p_y": y}
    for sign in ("", "-"):
        formula = entry("ik_2r")
        names["c_2"] = value(right_side(formula, "c_2"), **names)
        names["s_2"] = value(right_side(formula, "s_2").replace(r"\pm", sign), **names)
        q1, q2 = (value(right_side(formula, name), **names) for name in ("q_1", "q_2"))
        hand = l1 * np.array([math.cos(q1), math.sin(q1)]) + l2 * np.array([math.cos(q1 + q2), math.sin(q1 + q2)])
        np.testing.assert_allclose(hand, [x, y], atol=1e-12)


def test_all_solutions_of_the_elbow_arm():
    arm = catalogue()["elbow_3r"].arm
    d1, l2, l3 = arm.rows[0].d, arm.rows[1].a, arm.rows[2].a
    p = np.array([0.5, -0.4, 0.9])
    formula = entry("ik_elbow")
    for side in ("", "-"):
        for elbow in ("", "-"):
            names = {"p_x": p[0], "p_y": p[1], "p_z": p[2], "d_1": d1, "L_2": l2, "L_3": l3}
            names["c_3"] = value(right_side(formula, "c_3"), **names)
            names["s_3"] = value(right_side(formula, "s_3").replace(r"\pm", elbow), **names)
            q1 = value(right_side(formula, "q_1").replace(r"\pm", side), **names)
            r, h = math.cos(q1) * p[0] + math.sin(q1) * p[1], value(right_side(formula, "h"), **names)
            q2, q3 = value(right_side(formula, "q_2"), r=r, h=h, **names), math.atan2(names["s_3"], names["c_3"])
            np.testing.assert_allclose(arm.position([q1, q2, q3]), p, atol=1e-12)


def test_the_equation_of_sine_and_cosine():
    a, b, c = 1.3, -0.4, 0.9
    by_two, by_half = entry("tan_half").tex
    for sign in ("+", "-"):
        theta = value(by_two.partition("=")[2].replace(r"\pm", sign), a=a, b=b, c=c)
        half = 2 * math.atan(value(by_half.partition("=")[2].replace(r"\pm", sign), a=a, b=b, c=c))
        for found in (theta, half):
            assert a * math.sin(found) + b * math.cos(found) == pytest.approx(c, abs=1e-12)


@pytest.mark.parametrize(("key", "peaks"), [("cubic", 2), ("quintic", 2), ("septic", 0)])
def test_laws_from_rest_to_rest_and_their_peaks(key, peaks):
    formula = entry(key)
    tex = formula.tex[0].partition("=")[2].replace(r"\Delta q", "D") or formula.tex[0]
    tau = np.linspace(0.0, 1.0, 4001)
    q = value(tex, tau=tau, q_i=0.0, D=1.0)
    speed, bend = np.gradient(q, tau), np.gradient(np.gradient(q, tau), tau)
    assert (q[0], q[-1]) == pytest.approx((0.0, 1.0))
    assert max(abs(speed[0]), abs(speed[-1])) < 1e-3
    if key != "cubic":
        assert max(abs(bend[1]), abs(bend[-2])) < 0.05
    found = [np.abs(speed).max(), np.abs(bend[2:-2]).max()][:peaks]
    said = [value(tex.partition("=")[2].replace(r"|\Delta q|", "1"), T=1.0) for tex in formula.tex[1 : 1 + peaks]]
    assert said == pytest.approx(found, rel=2e-3)


def test_the_cubic_with_end_velocities():
    tex = "".join(entry("hermite").tex).partition("=")[2].replace("{}", "")
    ends = {"q_i": 1.0, "q_f": 3.0, "v_i": 0.7, "v_f": -0.4, "T": 2.0}
    q = [value(tex, tau=tau, **ends) for tau in (0.0, 1e-6, 1.0 - 1e-6, 1.0)]
    assert (q[0], q[3]) == pytest.approx((1.0, 3.0))
    assert ((q[1] - q[0]) / 2e-6, (q[3] - q[2]) / 2e-6) == pytest.approx((0.7, -0.4), abs=1e-4)


def test_the_equation_of_the_spline_with_uneven_intervals():
    t, q = np.array([0.0, 0.5, 1.7]), np.array([0.0, 1.0, 0.3])
    v = CubicSpline(t, q, bc_type=((1, 0.4), (1, -0.2)))(t, 1)
    names = {"h_k": t[1] - t[0], "h_kp1": t[2] - t[1]}
    names |= dict(zip(("q_k", "q_kp1", "q_kp2"), q, strict=True))
    names |= dict(zip(("v_k", "v_kp1", "v_kp2"), v, strict=True))
    left, right = (tex.partition("=")[2 * i] for i, tex in enumerate(entry("spline").tex))
    assert value(left, **names) == pytest.approx(value(right, **names), abs=1e-12)


# --- Errata


def test_every_formula_that_is_wrong_if_copied_stands_here_in_its_correct_form():
    here = {each for formula in sheet().formulas for each in formula.errata}
    wrong = {each.id for each in errata().values() if each.severity == "A"}
    assert wrong - here == set(NO_FORMULA)
    assert here <= set(errata())


# --- On two pages


def test_there_are_two_pages_with_all_chapters():
    assert len(sheet().pages) == 2
    assert next(iter(sheet().pages[1])) == "Differential kinematics"
    assert sum(map(len, sheet().pages)) == 8
    page = formulas_page(sheet())
    assert page.count("<main>") == 2
    assert page.count("<math") > 200
    assert formulas_page(sheet(), "lab") is None


def test_the_latex_uses_what_latex_and_amsmath_have():
    text = latex_sheet(sheet())
    body = text[text.index(r"\begin{document}") :]
    assert set(re.findall(r"\\([A-Za-z]+)", body)) <= KNOWN
    assert sorted(re.findall(r"\\begin\{(.*?)\}", text)) == sorted(re.findall(r"\\end\{(.*?)\}", text))
    assert body.count(r"\left") == body.count(r"\right")
    for formula in sheet().formulas:
        for tex in formula.tex:
            assert tex.count("{") == tex.count("}"), tex
    assert body.isascii()
    assert body.replace(r"\$", "").count("$") % 2 == 0
    assert not re.search(r"(?<!\\)[%&#](?![^&]*end)", re.sub(r"\\begin\{bmatrix\}.*?\\end\{bmatrix\}", "", body))


KNOWN = set(
    re.findall(
        r"\w+",
        """begin end newpage chapterline name formula par normalsize footnotesize textbf quad linewidth
        alpha beta gamma Delta epsilon eta theta kappa lambda Lambda xi pi sigma Sigma tau phi psi omega infty
        sin cos tan arctan sinh cosh det min max text mathbb mathcal frac tfrac sqrt sum int partial prime circ imath
        dot ddot dddot left right cdot cdots times oplus perp angle pm mp le ge approx to""",
    )
)
"""Commands of LaTeX, of amsmath and of the head of the sheet."""


# --- The file

TEXT = """second = "2"
about = "A word."
[[parts]]
chapter = "1"
[[parts.formulas]]
name = "One"
tex = ['a = b']
errata = ["1.58"]
[[parts]]
chapter = "2"
"""


@pytest.mark.parametrize(
    ("old", "new", "error", "says"),
    [
        ('chapter = "1"', 'chapter = "9"', ContentError, r"parts\[1\].chapter: unknown value '9'"),
        ("tex = ['a = b']", "tex = []", ContentError, r"parts\[1\].formulas\[1\].tex: expected at least one formula"),
        ('name = "One"', 'nmae = "One"', ContentError, r"parts\[1\].formulas\[1\].name: missing"),
        ('["1.58"]', '["1.85"]', UnknownName, "erratum: unknown name '1.85'"),
    ],
)
def test_a_mistake_in_the_file_is_named(old, new, error, says):
    assert [list(page) for page in parse_formulas(TEXT).pages] == [["Introduction"], ["Sensors and actuators"]]
    assert old in TEXT
    with pytest.raises(error, match=says):
        parse_formulas(TEXT.replace(old, new))
