"""Matrices to select in and to copy, the lit vectors, and the pages of the Pose bench as a browser gets them."""

import html
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.benches.pose.orientation.ui import scene as turn
from armlab.benches.pose.tool.state import Pair, PoseView
from armlab.benches.pose.tool.ui import scene as lit
from armlab.benches.pose.tool.ui.formulas import LONGEST, short_forms, used_constants, written
from armlab.benches.pose.tool.ui.notation import chain, link_product
from armlab.benches.pose.tool.ui.words import in_words
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.symbolic import pose_formulas
from armlab.kin.transforms import inverse, transform
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Select, Selection
from armlab.session.state import State, apply
from armlab.ui.factors import turns
from armlab.ui.html import joined
from armlab.ui.matrices import MatrixView, as_latex, as_matlab, as_numpy
from armlab.ui.units import Units
from support.forms import BareForm
from support.student import run, student

UNITS = Units(Notation())


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


def shown(state, values, key="pose", **options):
    """Return the view's form after it has shown a matrix."""
    form = BareForm()
    gui = SimpleNamespace(form=lambda post: form)
    MatrixView(gui, form.posted.append, key).show(state, "T", np.asarray(values), **options)
    return form


def lit_cells(markup):
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", markup.replace("\n", ""))
    cells = [re.findall(r"<td(?: class=\"([^\"]*)\")?>", row) for row in rows]
    return {(i, j) for i, row in enumerate(cells) for j, names in enumerate(row) if "lit" in names.split()}


def test_a_press_selects_entry_row_or_column(state):
    form = shown(state, np.eye(4), columns="xyzp", rows="xyz1")
    for cell in ("1,2", "1,", ",3"):
        form.press(cell)
    assert list(form.commands) == [Select("pose", 1, 2), Select("pose", 1, None), Select("pose", None, 3)]


@pytest.mark.parametrize("cell", ["", "4,0", "0,4", "-1,0", "1,2,3", "a,b", "1", "1e0,0", "²,0"])
def test_what_is_no_cell_does_nothing(state, cell):
    form = shown(state, np.eye(4), columns="xyzp")
    form.press(cell)
    assert form.commands == ()


def test_what_is_selected_is_marked_in_its_own_matrix_only(state):
    chosen = apply(state, Select("pose", None, 2))
    form = shown(chosen, np.eye(3))
    assert lit_cells(form.fields.content) == {(0, 2), (1, 2), (2, 2)}
    form = shown(apply(state, Select("pose", 1, 0)), np.eye(3))
    assert lit_cells(form.fields.content) == {(1, 0)}
    assert form.fields.content.count('aria-pressed="true"') == 1
    form = shown(chosen, np.eye(3), key="jacobian")
    assert lit_cells(form.fields.content) == set()


def test_only_named_rows_and_columns_can_be_pressed_and_a_matrix_to_read_has_no_buttons(state):
    form = shown(state, np.eye(2), columns=("x", "p"), rows=("x", ""))
    assert re.findall(r'data-cell="(\d?,\d?)"', form.fields.content) == [",0", ",1", "0,", "0,0", "0,1", "1,0", "1,1"]
    form = shown(state, np.eye(2), key="", columns=("x", "p"))
    assert "data-cell" not in form.fields.content
    assert "<th>p</th>" in form.fields.content


def test_numbers_are_written_with_a_true_minus_and_grey_zeros(state):
    form = shown(state, [[-0.25, 0.0004], [-0.0001, 1.0]])
    assert "−0.250" in form.fields.content
    assert len(re.findall(r'class="zero"', form.fields.content)) == 2
    assert "−0.000" not in form.fields.content


def test_copies_give_the_matrix_back(rng):
    for shape in ((4, 4), (3, 3), (6, 7), (1, 1)):
        values = rng.normal(size=shape) * 10.0 ** rng.integers(-6, 4, shape)
        copied = eval(as_numpy(values), {"np": np})
        np.testing.assert_array_equal(copied, np.where(np.abs(values) < 1e-15, 0.0, values))
        rows = [row.split() for row in as_matlab(values).strip("[]").split(";")]
        np.testing.assert_allclose(np.array(rows, dtype=float), values, rtol=1e-14)
        body = as_latex(values).removeprefix(r"\begin{bmatrix} ").removesuffix(r" \end{bmatrix}")
        assert "e" not in body
        body = re.sub(r"\\cdot 10\^\{(-?\d+)\}", r"e\1", body)
        np.testing.assert_allclose(
            [[float(entry) for entry in row.split("&")] for row in body.split(r"\\")], values, rtol=1e-5
        )


def test_copies_carry_no_crumbs_of_zero():
    values = np.array([[1.0, -6e-17], [-0.0, 0.5]])
    assert as_numpy(values) == "np.array([[1.0, 0.0], [0.0, 0.5]])"
    assert as_matlab(values) == "[1 0; 0 0.5]"
    assert as_latex(values) == r"\begin{bmatrix} 1 & 0 \\ 0 & 0.5 \end{bmatrix}"


# -- the lit vectors -------------------------------------------------------------------------------------------------


def random_pair(rng):
    reference, frame = (
        transform(rotation_from_axis_angle(rng.normal(size=3), rng.uniform(-3, 3)), rng.normal(size=3)) for _ in "ab"
    )
    return Pair(reference, frame, inverse(reference) @ frame)


def ends(segment):
    return np.asarray(segment[0]), np.asarray(segment[1])


def test_a_lit_column_is_an_axis_or_the_position(rng):
    for _ in range(10):
        pair = random_pair(rng)
        for j in range(3):
            ((start, end, _),) = lit.marks_of(pair, Selection("pose", None, j), 2.0, UNITS).arrows
            np.testing.assert_allclose(start, pair.frame[:3, 3])
            np.testing.assert_allclose((end - start) / (2.0 * lit.LENGTH), pair.frame[:3, j], atol=1e-12)
        marks = lit.marks_of(pair, Selection("pose", None, 3), 2.0, UNITS)
        start, end = ends(marks.arrows[0])
        np.testing.assert_allclose([start, end], [pair.reference[:3, 3], pair.frame[:3, 3]])
        assert marks.label == f"|p| = {UNITS.length(float(np.linalg.norm(end - start)))}"


def test_a_lit_component_runs_along_its_axis_and_has_its_length(rng):
    for _ in range(10):
        pair = random_pair(rng)
        for i in range(3):
            marks = lit.marks_of(pair, Selection("pose", i, 3), 2.0, UNITS)
            start, end = ends(marks.arrows[0])
            along = pair.reference[:3, :3].T @ (end - start)
            np.testing.assert_allclose(along, pair.transform[i, 3] * np.eye(3)[i], atol=1e-12)
            foot, tip = ends(marks.strokes[0])
            np.testing.assert_allclose(foot, end)
            np.testing.assert_allclose(tip, pair.frame[:3, 3])
            assert (tip - foot) @ pair.reference[:3, i] == pytest.approx(0.0, abs=1e-12)


def test_the_components_of_a_lit_row_lead_to_the_tip_of_its_axis(rng):
    for _ in range(10):
        pair = random_pair(rng)
        for i in range(3):
            marks = lit.marks_of(pair, Selection("pose", i, None), 2.0, UNITS)
            np.testing.assert_allclose(marks.strokes[-1][1], marks.arrows[0][1], atol=1e-12)
            np.testing.assert_allclose(marks.strokes[0][0], pair.frame[:3, 3], atol=1e-12)


def test_the_arc_of_a_lit_cosine_joins_both_axes(rng):
    for _ in range(10):
        pair = random_pair(rng)
        for i in range(3):
            for j in range(3):
                marks = lit.marks_of(pair, Selection("pose", i, j), 2.0, UNITS)
                at, radius = pair.frame[:3, 3], 2.0 * lit.ARC
                np.testing.assert_allclose((marks.strokes[0][0] - at) / radius, pair.reference[:3, i], atol=1e-9)
                np.testing.assert_allclose((marks.strokes[-1][1] - at) / radius, pair.frame[:3, j], atol=1e-9)
                assert f"{pair.transform[i, j]:.3f}".replace("-", "−") in marks.label


@pytest.mark.parametrize("angle", [0.0, 1e-12, math.pi, math.pi - 1e-12])
def test_parallel_and_opposite_axes_are_drawn(angle):
    T = transform(rotation_from_axis_angle([0.0, 0.0, 1.0], angle))
    pair = Pair(np.eye(4), T, T)
    for i in range(3):
        for j in range(4):
            marks = lit.marks_of(pair, Selection("pose", i, j), 1.0, UNITS)
            points = np.array([end for segment in marks.arrows + marks.strokes for end in segment[:2]])
            assert np.isfinite(points).all()
            if i == j == 0:
                np.testing.assert_allclose(marks.strokes[-1][1], lit.ARC * T[:3, 0], atol=1e-9)
    assert lit.marks_of(pair, Selection("pose", None, 3), 1.0, UNITS).label == "p = 0"


def test_nothing_selected_lights_nothing(rng):
    pair = random_pair(rng)
    for selected in (Selection(), Selection("pose", 3, None), Selection("pose", 3, 1), Selection("pose", 3, 3)):
        marks = lit.marks_of(pair, selected, 1.0, UNITS)
        assert marks.arrows == marks.strokes == []


def test_the_axis_of_the_turn_stays_where_it_is(rng):
    """R leaves its axis alone, in both frames."""
    for _ in range(10):
        pair = random_pair(rng)
        marks = turn.marks_of(pair, 1.0, UNITS)
        start, end = ends(marks.arrows[0])
        axis = (end - start) / turn.LENGTH
        np.testing.assert_allclose(pair.reference[:3, :3].T @ axis, pair.frame[:3, :3].T @ axis, atol=1e-9)
    assert turn.marks_of(Pair(np.eye(4), np.eye(4), np.eye(4)), 1.0, UNITS).label == "no turn"


# -- words and formulas ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("selected", "words"),
    [
        (Selection(), "Select a letter"),
        (Selection("pose", None, 0), "x axis of {E}, in the axes of {w}"),
        (Selection("pose", None, 3), "|p| = 3000.0 mm"),
        (Selection("pose", 1, None), "y axis of {w} in the axes of {E}"),
        (Selection("pose", 1, 3), "p<sub>y</sub> = 2000.0 mm"),
        (Selection("pose", 0, 1), "r₁₂ = cos 150.0° = −0.866"),
        (Selection("pose", 3, 3), "0 0 0 1"),
    ],
)
def test_what_is_selected_is_said(selected, words):
    T = transform(rotation_from_axis_angle([0.0, 0.0, 1.0], math.pi / 3), [1.0, 2.0, -2.0])
    assert words in joined(in_words(PoseView(6), selected, Pair(np.eye(4), T, T), UNITS))


def test_a_transform_is_written_as_the_product_of_its_steps():
    def letters(reference, frame):
        return re.sub(r"<[^>]*>|\s|[^\x21-\x7e]", "", html.unescape(joined(chain(PoseView(6, reference, frame)))))

    assert letters("0", "3") == "0T3=A1A2A3"
    assert letters("3", "0") == letters("0", "3")
    assert letters("w", "E").endswith("A66TE")
    assert letters("w", "0") == letters("6", "E") == ""
    assert letters("4", "5") == "4T5=A5"


def test_products_are_written_as_they_are_multiplied():
    assert re.findall(r"<mi>R</mi><mi>(.)</mi>.*?<mn>(.)</mn>", turns("zyx", True, "123")) == [
        ("x", "3"),
        ("y", "2"),
        ("z", "1"),
    ]
    parameters = {"a": 0.1, "alpha": 0.2, "d": 0.3, "theta": 0.4}
    rows = [("R", 0.1, 0.2, 0.3, 0.0)]
    for convention, order in (("standard", "Rz Tz Tx Rx"), ("modified", "Rx Tx Rz Tz")):
        markup = link_product(Arm.from_dh(rows, convention), parameters, UNITS)
        assert " ".join(a + b for a, b in re.findall(r"<mi>(.)</mi><mi>(.)</mi>", markup)) == order


def test_short_formulas_are_shown_whole_and_of_long_ones_the_beginning(robot):
    for latex in pose_formulas(robot.arm, "latex").values():
        formula = written(robot.arm, UNITS, latex)
        if len(formula.latex) < LONGEST - 3:
            assert formula.left_out == 0
        if len(formula.latex) > LONGEST:
            assert formula.left_out > 0
        shown = formula.markup.count('class="term"')
        signs = len(re.findall(r" [+-] ", re.sub(r"\\(sin|cos)\([^()]*\)", "", formula.latex)))
        assert shown + formula.left_out == signs + 1


def test_a_formula_breaks_at_signs_but_not_inside_functions_or_braces():
    arm = catalogue()["puma560"].arm
    formula = written(arm, UNITS, r"-c_1 (a_2 c_2 - d_{3}) + \cos(q_1 + q_2 - q_4)")
    assert formula.markup.count('class="term"') == 3
    assert written(arm, UNITS, "0.707106781187").latex == "0.70711"
    assert written(arm, UNITS, "0").constant
    assert written(arm, UNITS, "-1").constant
    assert not written(arm, UNITS, "-c_1").constant
    small = written(arm, UNITS, r"-3.6712345\cdot 10^{-6}")
    assert small.latex == r"-3.6712\cdot 10^{-6}"
    assert small.constant
    assert "e-" not in written(arm, UNITS, r"0.2 + 5\cdot 10^{-5} c_1").markup


def test_variables_have_the_letters_of_the_student():
    units = Units(Notation(variable="theta"))
    scara = catalogue()["scara"].arm
    assert written(scara, units, "d_1 - q_3 + q_4").latex == r"d_1 - d_{3} + \theta_{4}"
    assert short_forms(scara, UNITS, ["a_1 c_1 + s_{12}"]) == ["c₁ = cos q₁", "s₁₂ = sin(q₁ + q₂)"]
    assert used_constants(["d1 + a2*cos(q1)*cos(alpha10)", "a10*a2"]) == ["a2", "a10", "alpha10", "d1"]


# -- the pages -------------------------------------------------------------------------------------------------------


def entries(browser):
    """Return the matrix on the page as it would be copied."""
    return re.findall(r"np\.array\([^)]*\)", html.unescape(browser.html()))


def test_the_pose_page_follows_presses_and_the_arm(url):
    async def main():
        browser = await student(url)
        await browser.open("pose")
        await browser.until(lambda: "tool in the world, p in m" in browser.html())
        await browser.press(",3")
        await browser.until(lambda: "|p| = " in browser.html())
        await browser.press("2-3")
        await browser.press("inverse")  # before the page has shown the other
        await browser.until(lambda: "frame 2 in frame 3, p in m" in browser.html())
        await browser.press("w-E")
        await browser.until(lambda: "world in the tool, p in m" in browser.html())
        await browser.press("inverse")
        await browser.until(lambda: "tool in the world, p in m" in browser.html())
        first = entries(browser)
        await browser.set_value(browser.slider(1), 60.0)
        await browser.until(lambda: entries(browser) != first)
        assert html.unescape(browser.html()).count("np.array(") == 1
        await browser.close()

    run(main())


def test_the_orientation_page_writes_both_triples_and_says_where_it_is_singular(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("orientation")
        await browser.until(lambda: "Both triples of angles give R" in browser.html())
        sequence = browser.control("Sequence")
        await browser.set_value(sequence, "zxz")
        await browser.until(lambda: "Singular: only φ + ψ is defined" in browser.html())
        assert "φ + ψ = 95.0°; here ψ is set to 0" in browser.html()
        await browser.close()

    run(main())


def test_the_formulas_page_has_values_beside_formulas(url):
    async def main():
        browser = await student(url, path="/robot/scara")
        await browser.open("formulas")
        await browser.until(lambda: "a1*cos(q1) + a2*cos(q1 + q2)" in html.unescape(browser.html()))
        values = re.findall(r'class="value">.*?= ([−\d.]+) mm', browser.html())
        arm = catalogue()["scara"].arm
        p = arm.position(catalogue()["scara"].home) * 1e3
        np.testing.assert_allclose([float(v.replace("−", "-")) for v in values], p, atol=0.06)
        await browser.close()

    run(main())
