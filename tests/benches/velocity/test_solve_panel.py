"""The page Solve and the arrows, through the protocol a page speaks."""

import math
import re

import numpy as np
import pytest

from armlab.benches.velocity.solve.examples import EXAMPLES, ChooseSolveExample
from armlab.benches.velocity.solve.found import found, found_at
from armlab.benches.velocity.solve.state import AskFor, SetComponent
from armlab.benches.velocity.solve.ui import page as solve
from armlab.benches.velocity.solve.ui.scene import RED, arrows_of, line_of, lines_of, lost_lines, lost_turns, plane_of
from armlab.benches.velocity.solve.ui.words import (
    measures_markup,
    null_markup,
    penrose_markup,
    reached_markup,
    singular_card,
    speeds_markup,
    verdict,
)
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.colours import BLUE, GREEN
from armlab.ui.format import mathml
from armlab.ui.html import joined
from armlab.ui.units import Units, units_of
from support.arms import KINDS, wrist_alone
from support.forms import asked
from support.student import arm_nodes, run, settled, student

UNITS = Units(Notation())


def example(key):
    return apply(State.initial(catalogue()["planar_2r"]), ChooseSolveExample(key))


def parallel(n, task):
    """Return an arm with parallel axes, whose tool stays in a plane."""
    return Arm.from_dh([("R", 0.4, 0.0, 0.0, 0.0)] * n, task=task)


def numbers(markup):
    return [float(text.replace("−", "-")) for text in re.findall(r"<td>(−?[\d.]+)</td>", markup)]


# -- what is said ----------------------------------------------------------------------------------------------------


def test_the_verdict_says_how_many_and_why():
    kind, head, body = verdict(found(example("stretched_30")), UNITS)
    assert (kind, head) == ("no", "No joint speeds give v")
    assert "rank 1 of 2" in body
    assert "433.0 mm/s of it is lost" in body
    assert verdict(found(example("one")), UNITS)[1] == "One answer"
    kind, head, body = verdict(found(example("stretched_90")), UNITS)
    assert (kind, head) == ("ok", "Infinitely many answers")
    assert "n − rank = 2 − 1" in body
    few = State.initial(catalogue()["youbot"])
    few = apply(few, SetComponent(0, 0.1))
    assert verdict(found(few), UNITS)[1] == "Infinitely many answers"


@pytest.mark.parametrize(
    ("arm", "q", "says"),
    [
        (wrist_alone(np.eye(4)), [0.3, 0.8, 0.2], "although it has enough joints: J has rank 0 of 3 at most."),
        (parallel(3, "xyz"), [0.3, 0.8, 0.2], "although it has enough joints: J has rank 2 of 3 at most."),
        (parallel(7, "pose"), [0.3] * 7, "although it has enough joints: J has rank 3 of 6 at most."),
        (parallel(2, "xyz"), [0.3, 0.8], "too few joints for its task: J has rank 2 of 3 everywhere."),
    ],
)
def test_too_few_joints_are_the_reason_only_where_they_are_too_few(arm, q, says):
    body = verdict(found_at(arm, np.array(q), (0.1,) * arm.task.m), UNITS)[2]
    assert says in body
    assert ("too few joints" in body) == (arm.n < arm.task.m)


def test_reached_and_lost_are_the_numbers_of_the_notes():
    shown = numbers(reached_markup(found(example("stretched_30")), UNITS))
    assert shown == [-500.0, -125.0, -375.0, 0.0, 216.5, -216.5]


def test_joint_speeds_are_in_units_and_marked_over_their_limits():
    markup = speeds_markup(found(example("stretched_90")), UNITS)
    assert "11.5 °/s" in markup
    assert "5.7 °/s" in markup
    assert 'class="no"' not in markup
    fast = apply(example("one"), SetComponent(0, 20.0))
    assert 'class="no"' in speeds_markup(found(fast), UNITS)
    radians = speeds_markup(found(example("stretched_90")), Units(Notation(angle="rad")))
    assert "0.200 rad/s" in radians


def test_one_null_vector_has_one_table_of_bars():
    markup = null_markup(found(example("stretched_30")), UNITS)
    assert markup.count("so-null") == 1
    assert "−0.500" in markup
    assert "1.000" in markup
    assert null_markup(found(example("one")), UNITS) is None
    assert null_markup(found(example("singular_3r")), UNITS).count("so-null") == 2


def test_the_sentence_names_elbow_and_boundary():
    said = singular_card(found(example("stretched_30")))
    assert "Singular: rank 1, usually 2" in said
    assert "Elbow: the arm is stretched" in said
    assert "boundary" in said
    assert "Rank 2, not singular." in singular_card(found(example("one")))
    near = apply(example("one"), MoveJoint(1, 0.01))
    assert "Poorly conditioned" in singular_card(found(near))


def test_a_wrist_that_never_moves_its_centre_is_not_called_poorly_conditioned():
    state = State.initial(own_robot(wrist_alone(np.eye(4)), "wrist"))
    said = singular_card(found(state))
    assert "Rank 0 everywhere" in said
    assert "onditioned" not in said


@pytest.mark.parametrize("size", [1e-4, 1e-2, 1.0, 100.0])
@pytest.mark.parametrize(("q", "regular"), [((0.3, 0.5, 0.4), True), ((0.3, math.pi, math.pi), False)])
def test_a_determinant_is_zero_where_the_arm_is_singular_whatever_its_size(size, q, regular):
    for n in (2, 3):
        arm = Arm.from_dh([("R", size, 0.0, 0.0, 0.0)] * n, task="xy")
        said = measures_markup(found_at(arm, np.array(q[:n]), (0.1, 0.1)))
        values = re.findall(r"<(?:span|td)>([^<]+) m[²⁴]</", said)
        assert len(values) == (1 if n == 2 else 4)
        assert [value != "0" for value in values] == [regular] * len(values)


def test_determinants_and_minors_have_values_and_units():
    one = measures_markup(found(example("one")))
    assert f"{math.sin(math.radians(55.0)):.4f} m²" in one
    assert "<mi>det</mi>" in one or "det" in one
    wide = measures_markup(found(example("redundant_3r")))
    assert "3 choices of columns" in wide
    assert wide.count("<tr>") == 3
    assert " m⁴" in wide
    assert "1.2628" in wide
    puma = measures_markup(found(example("wrist")))
    assert "metres are divided by L" in puma
    assert "fractions of their limits." in measures_markup(found(example("rrp_upright")))


def test_joints_without_a_speed_limit_are_not_said_to_have_one():
    slides = [("R", 0.3, math.pi / 2, 0.0, 0.0), ("P", 0.0, 0.0, 0.3, 0.0)]
    for limits, known in (([2.0, 0.5], True), ([2.0, math.inf], False), (None, False)):
        seen = found_at(Arm.from_dh(slides, speed_limits=limits), np.array([0.3, 0.5]), (0.1, 0.1))
        for said in (speeds_markup(seen, UNITS), measures_markup(seen)):
            assert ("or of 1 rad/s or 1 m/s where none is known" in said) == (not known)


def test_the_length_that_counts_as_a_radian_is_told_of_an_arm_of_a_millimetre_too():
    for size, told in ((1e-4, "L = 0.00015 m"), (1.0, "L = 1.5 m")):
        arm = Arm.from_dh([("R", size, 0.0, 0.0, 0.0)] * 3, task="xy phi")
        assert told in measures_markup(found_at(arm, np.array([0.3, 0.5, 0.4]), (0.1, 0.1, 0.1)))


@pytest.mark.parametrize(
    ("key", "rows", "units"),
    [
        ("planar_2r", "task", ["m²", "m"]),
        ("planar_3r", "task", ["m²", ""]),
        ("planar_3r", "position", ["m⁴", "m"]),
        ("polar_rrp", "task", ["m²", "m/s"]),
        ("cartesian_3p", "task", ["", ""]),
        ("scara", "task", ["m²", "s⁻¹"]),
        ("scara", "position", ["(m/s)⁶", "m/s"]),
        ("puma560", "task", ["m³", ""]),
        ("iiwa7", "task", ["m⁶", ""]),
    ],
)
def test_determinants_and_the_smallest_singular_value_have_units(key, rows, units):
    state = State.initial(catalogue()[key])
    if rows == "position":
        state = apply(state, AskFor("position"))
    texts = re.findall(r"</span><span>([^<]*)</span>", measures_markup(found(state)).split("<h3>Minors")[0])
    assert [text.partition(" ")[2] for text in texts] == units


def test_penrose_and_the_formula_that_holds():
    assert mathml(r"J^\#-J^{-1}") in penrose_markup(found(example("one")))
    assert mathml(r"J^\#-J^T(J J^T)^{-1}") in penrose_markup(found(example("redundant_3r")))
    assert "The rank is not full" in penrose_markup(found(example("stretched_30")))


def test_of_a_scaled_matrix_the_formula_is_said_of_that_matrix():
    rows = [("P", 0, np.pi / 2, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0)]
    arm = Arm.from_dh(rows, task="xz", speed_limits=[0.2, 2.0, 2.0, 3.0])
    state = State.initial(own_robot(arm, "mixed"))
    for i, value in enumerate((0.1, 0.4, 0.7, -0.5)):
        state = apply(state, MoveJoint(i, value))
    solved = found(state)
    formula = solved.scaled.T @ np.linalg.inv(solved.scaled @ solved.scaled.T)
    np.testing.assert_allclose(solved.scaled_inverse, formula, atol=1e-12)
    assert np.abs(solved.spaces.inverse - solved.J.T @ np.linalg.inv(solved.J @ solved.J.T)).max() > 0.01
    said = penrose_markup(solved)
    assert mathml(r"\bar{J}^\#-\bar{J}^T(\bar{J} \bar{J}^T)^{-1}") in said
    assert "J̄ is J with" in said


@pytest.mark.parametrize("key", KINDS)
def test_every_arm_has_its_page_also_where_it_is_singular(key):
    robot = catalogue()[key]
    state = State.initial(robot)
    for q in (robot.home, np.zeros(robot.arm.n)):
        for i, value in enumerate(q):
            state = apply(state, MoveJoint(i, float(value)))
        solved, units = found(state), units_of(state)
        parts = [
            *verdict(solved, units),
            reached_markup(solved, units),
            speeds_markup(solved, units),
            null_markup(solved, units),
            singular_card(solved),
            measures_markup(solved),
            penrose_markup(solved),
            solve.svd_markup(solved),
            solve.spaces_markup(solved),
        ]
        text = str(joined(parts))
        assert "nan" not in text
        assert not re.search(r"\binf\b", text)


# -- typed and pressed -----------------------------------------------------------------------------------------------


def typed(state, cell, text):
    return asked(lambda form: solve.head_markup(form, state, found(state), UNITS), cell, text)


@pytest.mark.parametrize(
    ("cell", "text", "expected"),
    [
        ("v-0", "250", (SetComponent(0, 0.25),)),
        ("v-1", "0.5 m/s", (SetComponent(1, 0.5),)),
        ("example", "seven", (ChooseSolveExample("seven"),)),
        ("example", "", ()),
    ],
)
def test_what_is_typed_becomes_a_command(cell, text, expected):
    assert typed(example("one"), cell, text) == expected


def test_position_alone_can_be_asked_for_where_it_is_less_than_the_task():
    assert typed(State.initial(catalogue()["puma560"]), "rows-position", "") == (AskFor("position"),)
    assert typed(example("one"), "rows-position", "") == ()


def test_what_is_no_number_is_refused():
    with pytest.raises(InputError, match="vx: expected a number"):
        typed(example("one"), "v-0", "fast")


def test_the_largest_speed_is_told_in_the_unit_on_screen():
    told = "vx: expected a number in mm/s from −100000 to 100000, got '200000'"
    with pytest.raises(InputError, match=f"^{told}$"):
        typed(example("one"), "v-0", "200000")
    assert typed(example("one"), "v-0", "100000") == (SetComponent(0, 100.0),)


# -- drawings --------------------------------------------------------------------------------------------------------


def test_the_lost_direction_of_the_stretched_2r_is_drawn_within_a_degree():
    solved = found(example("stretched_30"))
    point = np.asarray(solved.arm.position(solved.q))
    (line,) = lost_lines(solved)
    along = np.array([math.cos(math.pi / 6), math.sin(math.pi / 6), 0.0])
    assert abs(line @ along) > math.cos(math.radians(1.0))
    arrows = arrows_of(solved, point, 2.0).arrows
    assert [colour for *_, colour in arrows] == [GREEN, BLUE]
    np.testing.assert_allclose(arrows[0][1] - point, [-0.125, math.sqrt(3) / 8, 0.0], atol=1e-9)
    marks = lines_of(solved, point, 2.0)
    assert marks.label == "lost direction"
    red = [(start, end) for start, end, colour in marks.strokes if colour == RED]
    np.testing.assert_allclose(
        red[0][0], point + np.array([-0.125, math.sqrt(3) / 8, 0.0]), atol=1e-9
    )  # from what is reached
    np.testing.assert_allclose(
        red[len(red) // 2 - 1][1], point + np.array([-0.5, 0.0, 0.0]), atol=1e-9
    )  # to what is wanted
    reached = line_of(solved)
    assert abs(reached @ along) < math.sin(math.radians(1.0))


def test_a_plane_of_velocities_is_drawn_and_a_regular_arm_has_none():
    solved = found(example("rrp_upright"))
    normal = plane_of(solved)
    assert abs(normal @ lost_lines(solved)[0]) == pytest.approx(1.0, abs=1e-9)
    regular = found(example("one"))
    assert (plane_of(regular), line_of(regular), lost_lines(regular)) == (None, None, [])
    assert len(lost_turns(found(example("wrist")))) == 1


# -- over the wire ---------------------------------------------------------------------------------------------------


def test_the_page_solves_moves_and_refuses(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("velocity", "solve")
        await browser.until(lambda: "One answer" in browser.html())
        await browser.press("example", "stretched_30")
        await browser.until(lambda: "No joint speeds give v" in browser.html())
        await browser.until(lambda: "216.5" in browser.html() and "Elbow" in browser.html())
        assert EXAMPLES["stretched_30"].says.split(":")[0] in browser.html()
        await browser.press("v-0", "fast")
        await browser.until(lambda: "expected a number" in browser.html())
        await browser.press("v-0", "0")
        await browser.until(lambda: "Infinitely many" in browser.html())
        assert 'aria-pressed="false"' in browser.html()
        await browser.press("svd")
        await browser.until(lambda: "U is 2 × 2" in browser.html())
        await browser.press("subspaces")
        await browser.until(lambda: "dimension 1" in browser.html())
        await browser.press("penrose")
        await browser.until(lambda: "Largest entries" in browser.html())
        await browser.press("example", "redundant_3r")
        await browser.until(lambda: "Self-motion, closed" in browser.html())
        before = [browser.nodes[name]["wxyz"] for name in arm_nodes(browser)]
        await browser.set_value(browser.control("Along, %"), 30.0)
        await browser.until(lambda: [browser.nodes[name]["wxyz"] for name in arm_nodes(browser)] != before)
        await settled(browser)
        assert "Self-motion, closed" in browser.html()
        assert browser.notices == ["This example uses the Planar 3R. Undo (Ctrl+Z) brings back the Planar 2R."]
        await browser.close()

    run(main())


def test_the_arrow_is_dragged(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("velocity", "solve")
        await browser.until(lambda: "One answer" in browser.html())
        await settled(browser)
        node = next(name for name in browser.nodes if name.endswith("solve/handle"))
        tip = np.array(browser.nodes[node]["position"])
        await browser.drag("start", node=node)
        await browser.drag("update", tip + np.array([0.1, 0.3, 0.0]), (1.0, 0.0, 0.0, 0.0), node=node)
        await browser.drag("end", node=node)
        await browser.until(lambda: 'value="300"' in browser.html())
        await browser.close()

    run(main())
