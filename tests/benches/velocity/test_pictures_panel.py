"""The page Pictures: two lines, the norm against det J, the square and the torus, as markup and over the wire."""

import math
import re

import numpy as np
import pytest

from armlab.benches.velocity.pictures.ui import page as pictures
from armlab.benches.velocity.solve.examples import ChooseSolveExample
from armlab.benches.velocity.solve.pictures import DragTo, StandAt, flat, norm_curve, square
from armlab.benches.velocity.solve.state import Solve
from armlab.benches.velocity.solve.ui.pictures import (
    ROWS,
    lines_svg,
    lines_words,
    marks_style,
    nice,
    norm_svg,
    square_markup,
)
from armlab.benches.velocity.solve.ui.torus import HIGH, WIDE, pressed, projected, torus_markup, torus_style
from armlab.benches.velocity.solve.ui.words import dotted
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import State, apply
from armlab.ui.colours import css
from armlab.ui.form import Marks
from armlab.ui.html import joined
from armlab.ui.units import Units, units_of
from support.forms import asked
from support.student import run, student

UNITS = Units(Notation())


def example(key):
    return apply(State.initial(catalogue()["planar_2r"]), ChooseSolveExample(key))


def picked(state, cell, text):
    def made(form):
        return joined(pictures.head_markup(form, state, UNITS), pictures.maps_markup(form, state, square(state), UNITS))

    return asked(made, cell, text)


def test_an_arm_without_pictures_leads_on_to_one_with_them():
    puma = State.initial(catalogue()["puma560"])

    def offered(form):
        return pictures.arms_markup(form, puma)

    assert asked(offered, "arm scara") == (ChooseRobot("scara"),)
    assert asked(offered, "arm ur10") == ()
    assert pictures.arms_markup(None, State.initial(catalogue()["scara"])) is None


@pytest.mark.parametrize(
    ("cell", "text", "expected"),
    [
        ("first", "1", Set(Solve, "pair", (1, 0))),
        ("first", "2", Set(Solve, "pair", (2, 1))),
        ("second", "0", Set(Solve, "pair", (1, 0))),
        ("second", "2", Set(Solve, "pair", (0, 2))),
        ("square", "0.25,0.75", StandAt(0.25, 0.25)),
        ("square", "0.25,0.75,3", DragTo(0.25, 0.25, 3)),
    ],
)
def test_what_is_pressed_in_the_pictures_becomes_a_command(cell, text, expected):
    assert picked(State.initial(catalogue()["planar_3r"]), cell, text) == (expected,)


def test_a_place_that_is_none_is_refused():
    for text in ("nowhere", "nan,0", "0.25,0.75,nan"):
        with pytest.raises(InputError, match="expected a place"):
            picked(example("one"), "square", text)


def test_two_lines_meet_are_parallel_or_one():
    for key, words in (
        ("one", "meet in one point"),
        ("stretched_30", "No point is on both"),
        ("stretched_90", "no line"),
    ):
        state = example(key)
        two, units = flat(state), units_of(state)
        assert words in lines_words(state, two, units)
        drawing = lines_svg(state, two, units)
        assert sum(f'stroke="{css(colour)}"' in drawing for colour in ROWS) == (1 if key == "stretched_90" else 2)
        assert ('class="nearest"' in drawing) == (key == "stretched_30")


def test_the_determinant_of_the_pictures_has_its_unit():
    state = example("one")
    assert f"det J = {math.sin(math.radians(55.0)):.4f} m²" in pictures.norm_markup(state, UNITS)
    assert ">det J, m²</text>" in pictures.norm_markup(state, UNITS)


@pytest.mark.parametrize("size", [1e-7, 100.0])
def test_the_determinant_of_the_pictures_is_zero_where_the_two_lines_are_parallel(size):
    links = [("R", size, 0.0, 0.0, 0.0)] * 2
    state = State.initial(own_robot(Arm.from_dh(links), "own"))
    for q2, zero in ((0.7, False), (math.pi, True)):
        said = pictures.norm_markup(apply(state, MoveJoint(1, q2)), UNITS)
        assert ("Here det J = 0 m²" in said, " = 0. The ratio" in said) == (zero, zero)


def test_the_arm_is_marked_in_both_charts_where_the_numbers_say():
    state = example("one")
    two, curve = flat(state), norm_curve(state)
    (speed,) = np.degrees([np.linalg.norm(two.answer.qdot)])
    size = norm_svg(curve, (two.determinant, math.radians(speed)), UNITS)
    for drawing, point in (
        (lines_svg(state, two, UNITS), np.degrees(two.answer.qdot)),
        (size, (two.determinant, speed)),
    ):
        x, y = at_numbers(drawing, point)
        cx, cy = re.search(r'class="answer" cx="([\d.]+)" cy="([\d.]+)"', drawing).groups()
        assert (float(cx), float(cy)) == pytest.approx((x, y), abs=0.3)


def at_numbers(drawing, point):
    """Return the pixel of a point from the numbers of the axes that are farthest apart."""
    found = re.findall(r'<text class="tick" x="([\d.]+)" y="([\d.]+)" text-anchor="(\w+)">([^<]+)<', drawing)
    read = [(float(x), float(y) - 4.0, float(words.replace("−", "-"))) for x, y, _, words in found]
    base = max(y for _, y, _ in read)
    across = [(value, x) for x, y, value in read if y == base]
    up = [(value, y) for _, y, value in read if y != base]
    return tuple(
        low[1] + (value - low[0]) / (high[0] - low[0]) * (high[1] - low[1])
        for value, (low, *_, high) in zip(point, (across, up), strict=True)
    )


def test_the_axes_of_both_charts_are_in_the_units_on_screen():
    state = example("one")
    for units, unit in ((UNITS, "°/s"), (Units(Notation(angle="rad")), "rad/s")):
        lines = lines_svg(state, flat(state), units)
        names = [f"{dotted(k, state[Joints].arm, units)}, {unit}" for k in (1, 0)]
        assert re.findall(r">([^<]+/s)</text>", lines) == names
        assert f">‖q̇‖, {unit}</text>" in pictures.norm_markup(state, units)


def test_the_square_has_its_numbers_in_the_units_on_screen():
    state = example("one")
    for units, names, right in (
        (UNITS, ("q₁, °", "q₂, °"), ["−180", "−90", "0", "90", "180"]),
        (Units(Notation(angle="rad")), ("q₁, rad", "q₂, rad"), ["−1.57", "0", "1.57", "3.14"]),
    ):
        drawing = square_markup(Marks(), state, square(state), units)
        assert re.findall(r">(q[^<]+)</text>", drawing) == [names[1], names[0]]
        assert re.findall(r'y="266.0" text-anchor="\w+">([^<]+)<', drawing) == right
        # The elbow is singular stretched and folded: at 0 and at ±180°, over the whole width of the square.
        (singular,) = re.findall(r'd="([^"]+)" class="singular"', drawing)
        points = np.array(re.findall(r"([\d.]+) ([\d.]+)", singular), dtype=float)
        assert {*points[:, 1].tolist()} <= {0.0, 125.0, 250.0}
        assert 125.0 in points[:, 1]
        assert (points[:, 0].min(), points[:, 0].max()) == pytest.approx((46.0, 296.0), abs=2.0)


def test_the_mark_in_the_square_is_where_the_arm_stands():
    state = apply(example("one"), StandAt(0.7, 0.2))
    style = marks_style(state, square(state), flat(state))
    assert "--x:70.00%" in style
    assert "--y:20.00%" in style
    assert "--way:block" in style


def test_round_numbers_are_not_smaller():
    rng = np.random.default_rng(5)
    for value in (10.0 ** rng.uniform(-6, 6, 200)).tolist():
        assert value * (1.0 - 1e-9) <= nice(value) <= 1.7 * value


def test_a_press_on_the_torus_is_where_it_is_drawn():
    rng = np.random.default_rng(3)
    for q in rng.uniform(-math.pi, math.pi, (200, 2)):
        (x, y), seen = projected(q)
        assert 0.0 <= x <= WIDE
        assert 0.0 <= y <= HIGH
        found_at = pressed(x / WIDE, y / HIGH)
        back, front = projected(found_at)
        assert front  # what is behind cannot be pressed
        assert np.linalg.norm(back - (x, y)) < 8.0
        outside = abs(math.cos(q[1])) > 0.6 and math.cos(q[1]) > 0.0 and math.sin(q[0]) < -0.3
        if seen and outside:
            gap = np.array(found_at) - q
            assert np.abs(gap - math.tau * np.round(gap / math.tau)).max() < 0.15
    assert pressed(0.01, 0.02) is None
    assert pressed(0.5, 0.5) is None or projected(pressed(0.5, 0.5))[1]


def test_the_torus_shows_the_singular_set_the_arm_and_its_velocity():
    state = example("one")
    markup = torus_markup(Marks(), square(state))
    assert markup.count('class="singular') == 2
    style = torus_style(state, flat(state))
    (x, _), _ = projected(np.radians([40.0, 55.0]))
    assert f"--x:{100.0 * x / WIDE:.2f}%" in style
    assert "--way:block" in style
    (command,) = picked(state, "torus", f"{x / WIDE},0.9")
    assert isinstance(command, StandAt)
    assert picked(state, "torus", "0.01,0.02") == ()


def test_a_press_in_the_square_moves_the_arm_and_other_arms_are_refused(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("velocity", "pictures")
        await browser.until(lambda: "so-map" in browser.html())
        await browser.press("square", "0.75,0.75")
        await browser.until(lambda: "--x:75.00%" in browser.html())
        assert "--y:25.00%" in browser.html()
        await browser.close()
        other = await student(url, path="/robot/puma560")
        await other.open("velocity", "pictures")
        await other.until(lambda: "parallel axes" in other.html())
        assert "so-map" not in other.html()
        await other.close()

    run(main())
