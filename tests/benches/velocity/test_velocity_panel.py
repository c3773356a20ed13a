"""The pages of velocities and of turning as a browser gets them, and the arrows in the scene."""

import re

import numpy as np
import pytest

from armlab.benches.velocity.speeds.commands import (
    DrawVelocities,
    LookAtLink,
    SetAllSpeeds,
    SetLinkPoint,
    SetSpeed,
    Unfold,
)
from armlab.benches.velocity.speeds.examples import EXAMPLES, ChooseVelocityExample
from armlab.benches.velocity.speeds.motion import moving_of, two_points_of
from armlab.benches.velocity.speeds.state import MATRIX, Velocity, drawn_scales, fastest
from armlab.benches.velocity.speeds.ui import page as velocity
from armlab.benches.velocity.speeds.ui.marks import LEAST, UNIT, unit_scale
from armlab.benches.velocity.speeds.ui.numbers import higher_markup, points_markup, size_markup, sum_markup
from armlab.benches.velocity.speeds.ui.scene import marks_of
from armlab.benches.velocity.speeds.ui.words import in_words
from armlab.benches.velocity.turning.commands import SetTurning, WriteAngles
from armlab.benches.velocity.turning.state import Turning
from armlab.benches.velocity.turning.ui import page as turning
from armlab.benches.velocity.turning.ui.numbers import form_markup, laws_markup, rates_markup, small_markup, tool_markup
from armlab.benches.velocity.turning.ui.scene import axes_marks, omega_marks
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.conditioning import POOR
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Select
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import State, apply
from support.done import done
from support.forms import BareForm, asked
from support.student import moves, run, settled, student


def opened(key="planar_2r", *commands):
    return done(State.initial(catalogue()[key]), *commands)


def drawn(state):
    return marks_of(state, state[Joints].q, 1.0)


# -- arrows ------------------------------------------------------------------------------------------------------------


def test_the_arrows_of_the_parts_sum_to_the_way_of_the_tool(robot, rng):
    """Tip to tail, with the scale that is written on the page, within 1 %."""
    arm, state = robot.arm, State.initial(robot)
    for joint in range(arm.n):
        state = apply(state, SetSpeed(joint, float(rng.uniform(0.3, 1.0) * fastest(arm, joint))))
    for q in rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (5, arm.n)):
        speeds, h = np.array(state[Velocity].qdot), 1e-5
        way = (arm.position(q + h * speeds) - arm.position(q - h * speeds)) / (2 * h)
        found = marks_of(state, q, 1e-4)
        corner = arm.position(q)
        for start, end, _ in found["parts"].arrows:
            np.testing.assert_allclose(start, corner, rtol=0, atol=1e-5)
            corner = end
        scale = drawn_scales(arm, state[Velocity].qdot)[0]
        assert np.linalg.norm((corner - arm.position(q)) / scale - way) < 0.01 * np.linalg.norm(way)
        (start, end, _) = found["v"].arrows[0]
        assert np.linalg.norm((end - start) / scale - way) < 0.01 * np.linalg.norm(way)


def test_a_joint_that_stands_still_has_no_arrow():
    assert len(drawn(opened())["parts"].arrows) == 2
    assert len(drawn(opened("planar_2r", LockJoint(0, True)))["parts"].arrows) == 1
    nothing = drawn(opened("planar_2r", SetAllSpeeds(False)))
    assert nothing["parts"].arrows == []
    assert nothing["v"].label == ""


def test_a_selected_column_is_the_column_and_its_axis():
    state = opened("elbow_3r", Select(MATRIX, None, 1))
    arm, moving = state[Joints].arm, moving_of(state)
    marks = drawn(state)["lit"]
    (linear, angular), scale = marks.arrows, drawn_scales(arm, (1.0,) * 3)[0]
    np.testing.assert_allclose((linear[1] - linear[0]) / scale, moving.J[:3, 1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.cross(angular[1] - angular[0], moving.J[3:, 1]), np.zeros(3), rtol=0, atol=1e-12)
    assert set(drawn(state)) == {"lit"}
    assert "across the lever" in in_words(state, moving)


@pytest.mark.parametrize("axes", ["world", "tool"])
@pytest.mark.parametrize("row", [0, 4])
def test_a_selected_row_is_what_each_joint_gives_along_its_axis(axes, row):
    state = opened("puma560", Set(Velocity, "axes", axes), Select(MATRIX, row, None))
    moving, marks = moving_of(state), drawn(state)["lit"]
    axis = moving.axes[:, row % 3]
    scale = unit_scale(state[Joints].arm) if row < 3 else UNIT
    seen = [j for j in range(6) if abs(scale * moving.matrix[row, j]) > LEAST]
    assert len(marks.arrows) == len(seen) > 1
    for j, (start, end, _) in zip(seen, marks.arrows, strict=True):
        np.testing.assert_allclose(start, moving.origins[j], rtol=0, atol=1e-12)
        np.testing.assert_allclose(end - start, scale * moving.matrix[row, j] * axis, rtol=0, atol=1e-12)
    assert "Row" in in_words(state, moving)


def test_a_selected_entry_is_a_component_of_its_column():
    state = opened("puma560", Select(MATRIX, 1, 0))
    moving, (whole, part) = moving_of(state), drawn(state)["lit"].arrows
    np.testing.assert_allclose(part[1] - part[0], (whole[1] - whole[0]) * [0, 1, 0], rtol=0, atol=1e-12)
    assert f"{1000 * moving.J[1, 0]:.1f}".replace("-", "−") in in_words(state, moving)


@pytest.mark.parametrize("row", [None, 0])
def test_a_column_that_was_pressed_on_the_page_of_another_arm_is_none(row):
    """Between the choice of an arm and its page one may press what is on the page of the one before."""
    plain, pressed = opened("planar_2r"), opened("planar_2r", Select(MATRIX, row, 6))
    assert in_words(pressed, moving_of(pressed)) == in_words(plain, moving_of(plain))
    assert set(drawn(pressed)) == set(drawn(plain))


def test_v2_is_drawn_as_v1_and_what_the_turning_adds():
    state = apply(opened("planar_2r", ChooseVelocityExample("two_points")), DrawVelocities("points", True))
    found, marks = two_points_of(state), drawn(state)
    scale = drawn_scales(state[Joints].arm, state[Velocity].qdot)[0]
    carried, across, whole = marks["second"].arrows
    np.testing.assert_allclose((carried[1] - carried[0]) / scale, found.v1, rtol=0, atol=1e-12)
    np.testing.assert_allclose((across[1] - across[0]) / scale, found.across, rtol=0, atol=1e-12)
    np.testing.assert_allclose((whole[1] - whole[0]) / scale, found.v2, rtol=0, atol=1e-12)


def test_the_axes_of_the_turns_are_the_columns_of_t():
    state = opened("planar_2r", Select("rates", None, 1))
    marks = axes_marks(state, np.zeros(3), 1.0)
    assert len(marks.strokes) == 3
    (arrow,) = marks.arrows
    T = turning.turned_of(state).T
    np.testing.assert_allclose(arrow[1] / np.linalg.norm(arrow[1]), T[:, 1], rtol=0, atol=1e-12)
    still = opened("planar_2r", *[SetTurning("rates", k, 0.0) for k in range(3)])
    assert omega_marks(still, np.zeros(3), 1.0).arrows == []


# -- numbers -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_has_its_numbers(key):
    state = opened("planar_2r", ChooseVelocityExample(key))
    text = sum_markup(state) + size_markup(state) + higher_markup(state)
    assert "nan" not in text
    assert len(re.findall("<tr", sum_markup(state))) == state[Joints].arm.n + 2


def test_units_are_those_that_were_chosen():
    state = opened("planar_2r", MoveJoint(0, 0.0), MoveJoint(1, 0.0), SetSpeed(0, 1.0), SetSpeed(1, 0.0))
    assert "2000.0 mm/s" in size_markup(state)
    other = apply(apply(state, Set(Notation, "length", "m")), Set(Notation, "angle", "rad"))
    assert "2.0000 m/s" in size_markup(other)
    assert "1.000 rad/s" in size_markup(other)


def test_a_singular_angle_says_what_is_lost():
    regular = rates_markup(opened())
    assert "✓ Well conditioned" in regular
    singular = rates_markup(opened("planar_2r", SetTurning("angles", 1, np.pi / 2)))
    assert "✕ Singular" in singular
    assert "no rates turn the body about the axis across" in singular
    near = rates_markup(opened("planar_2r", SetTurning("angles", 1, np.pi / 2 - 0.05)))
    assert "◐ Poorly conditioned" in near
    assert "1/|det T| = 20.0 times as large" in near


def test_a_poor_angle_is_poor_by_the_same_number_as_a_poor_jacobian():
    # Of two axes at an angle θ and one across both, σ_min/σ_max = tan θ/2.
    border = 2.0 * np.arctan(POOR)
    for k, says in ((0.99, "Poorly conditioned"), (1.01, "Well conditioned")):
        assert says in rates_markup(opened("planar_2r", SetTurning("angles", 1, np.pi / 2 - k * border)))


def test_the_analytic_jacobian_of_the_tool_is_there_or_says_why_not():
    state = opened("planar_2r", WriteAngles("zyx", False), SetSpeed(0, np.radians(10)), SetSpeed(1, np.radians(25)))
    assert "35.0\N{EN SPACE}0.0\N{EN SPACE}0.0" in tool_markup(state)
    singular = tool_markup(apply(state, WriteAngles("zxz")))
    assert "It does not exist here" in singular
    assert "first and the third axis are one line" in singular


def test_the_two_laws_and_the_small_turns_are_told():
    text = laws_markup(opened("planar_2r", Set(Turning, "shown", "laws")))
    assert text.count("90.0\N{EN SPACE}0.0\N{EN SPACE}90.0") == 2
    assert "120.0°" in text
    assert "Same integral, other orientation" in text
    on = laws_markup(opened("planar_2r", Set(Turning, "shown", "laws"), OpenClip("turning")))
    assert "Same integral" not in on  # nothing has turned
    assert "0.0°" in on
    assert "1.01·10⁻⁴" in small_markup()


# -- what is pressed and typed -----------------------------------------------------------------------------------------


def pressed(state, cell, text=""):
    """Return what follows on the pages of velocities and of turning, with all that can be folded away unfolded."""

    def made(form):
        points = velocity.folded_markup("points", "", form, unfolded, points_markup)
        return velocity.head_markup(form, state) + velocity.below_markup(form, state) + points

    unfolded = apply(state, Unfold("points", True))
    return asked(made, cell, text)


def turned(state, cell, text=""):
    return asked(lambda form: turning.clock_markup(form, state) + form_markup(form, state), cell, text)


def test_drive_goes_on_where_it_stands():
    state = opened()
    assert pressed(state, "play-speeds") == (OpenClip("speeds", play=True),)
    assert pressed(apply(state, OpenClip("speeds")), "play-speeds") == (Play(True),)
    assert turned(apply(state, OpenClip("turning")), "play-turning") == (Play(True),)


def test_what_is_switched_is_turned_round():
    state = opened()
    assert pressed(state, "mark v off") == (DrawVelocities("v", False),)
    assert pressed(state, "mark points on") == (DrawVelocities("points", True),)
    assert pressed(state, "fold points off") == (Unfold("points", False),)
    assert turned(state, "about moving") == (WriteAngles(fixed=False),)


def test_what_is_typed_is_read_in_the_units_on_screen():
    points = opened()[Velocity].points
    (command,) = pressed(opened(), "point 1 2", "250")
    assert command == SetLinkPoint(1, (*points[1][:2], 0.25))
    assert pressed(opened(), "link", "1") == (LookAtLink(1),)
    assert pressed(opened(), "link", "3") == ()
    with pytest.raises(InputError, match="point 2, z: expected a number in mm"):
        pressed(opened(), "point 1 2", "far")
    (command,) = turned(opened(), "rates 0", "90")
    assert command == SetTurning("rates", 0, pytest.approx(np.pi / 2))
    with pytest.raises(InputError, match="angle 1: expected a number in degrees"):
        turned(opened(), "angles 0", "much")


async def says(browser, text):
    await browser.until(lambda: text in browser.html())


def test_the_page_of_speeds(url):
    async def main():
        browser = await student(url)
        await browser.open("velocity")
        await says(browser, "Parts and their sum")
        await browser.press("example", "kernel")
        await says(browser, "The tool point is on the axis of joint 1")
        await says(browser, "|ω| <b>60.0 °/s</b>")
        await browser.press(",0")
        await says(browser, "its linear half is 0")
        await browser.press("fold points on")
        await says(browser, "v₂ = v₁ + ω × r₁₂")
        await browser.press("point 0 0", "far")
        await says(browser, "point 1, x: expected a number in mm")
        await browser.press("none")
        await says(browser, "All joints are at rest.")
        await browser.press("alone 1")
        await says(browser, "|ω| <b>30.0 °/s</b>")
        slider = next(c for c in browser.controls.values() if c["props"].get("label", "").startswith("q\u0307₂"))
        await browser.set_value(slider, 60.0)
        await says(browser, "|ω| <b>60.0 °/s</b>")
        await settled(browser)
        await browser.press("play-speeds")
        await moves(browser)
        await browser.close()

    run(main())


def test_the_page_of_turning(url):
    async def main():
        browser = await student(url)
        await browser.open("turning")
        await says(browser, "T is not a rotation matrix")
        await browser.press("axes", "zyz")
        await browser.press("about moving")
        await says(browser, "of a spherical wrist")
        await browser.press("angles 1", "0")
        await says(browser, "✕ Singular")
        await browser.press("shown laws")
        await says(browser, "Same integral, other orientation")
        await browser.press("play-turning")
        await says(browser, "❚❚ Pause")
        await browser.close()

    run(main())


def test_the_pages_watch_what_they_show():
    assert {Velocity, Joints, Timeline} <= set(velocity.PANEL.watches)
    assert {Turning, Timeline} <= set(turning.PANEL.watches)


def test_the_acceleration_is_told_along_v_and_across_it():
    state = opened("planar_2r", MoveJoint(1, 1.0), SetSpeed(0, 0.5), SetSpeed(1, 0.7))
    arm, q, qdot, h = state[Joints].arm, state[Joints].q, np.array([0.5, 0.7]), 1e-4
    before, now, after = (arm.position(q + step * qdot) for step in (-h, 0.0, h))
    v, a = (after - before) / (2 * h), (after - 2 * now + before) / h**2
    along = 1e3 * float(a @ v) / np.linalg.norm(v)
    across = np.sqrt(1e6 * float(a @ a) - along**2)
    told = re.search(r"the point (−?[\d.]+) mm/s² are along v and ([\d.]+) mm/s² across it", higher_markup(state))
    assert abs(along) > 10.0
    found = [float(each.replace("−", "-")) for each in told.groups()]
    np.testing.assert_allclose(found, [along, across], rtol=0, atol=0.1)


@pytest.mark.parametrize("shown", ["angles", "laws"])
def test_the_clock_of_turning_tells_the_time_of_what_is_shown(shown):
    state = opened("planar_2r", Set(Turning, "shown", shown))
    form = BareForm()
    assert ("t = 2.00 s" in turning.clock_markup(form, state)) == (shown == "laws")
    assert "t = 0.50 s" in turning.clock_markup(form, apply(apply(state, OpenClip("turning")), Seek(0.5)))
