"""The page "Closed-form IK": the steps as markup, their branches as commands, and what is drawn of them."""

import html
import math
import re

import numpy as np
import pytest

from armlab.benches.target.by_hand.state import ByHand, ChooseBranch, FollowArm, GoByHand, is_there, sheet
from armlab.benches.target.by_hand.ui.card import out_of_limits
from armlab.benches.target.by_hand.ui.drawn import corners_of_shapes, picture_of
from armlab.benches.target.by_hand.ui.formula import equation, plain
from armlab.benches.target.by_hand.ui.page import around
from armlab.benches.target.solutions.state import Solutions
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.ik.by_hand import method_of
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import EndDrag
from armlab.session.state import apply
from armlab.ui.format import filled
from armlab.ui.units import Units, units_of
from support.searched import moved, opened, searched
from support.student import run, student

BY_HAND = frozenset({"by_hand"})
COVERED = [key for key, robot in catalogue().robots.items() if method_of(robot.arm) is not None]


def read(markup):
    """Return the text of markup."""
    return html.unescape(re.sub(r"<[^>]*>", "", str(markup)))


def choices_of(state):
    return dict(state.derived(sheet).derivation.choices)


# -- state -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", COVERED)
def test_the_branches_are_those_of_the_arm_until_some_are_chosen(key):
    state = opened(key)
    found = state.derived(sheet)
    assert is_there(state, found)
    assert found.count >= 1


def test_a_branch_that_is_chosen_stays_and_the_later_ones_follow_the_arm():
    state = opened("puma560")
    first = choices_of(state)
    state = apply(state, ChooseBranch("q1", 1 - first["q1"]))
    assert choices_of(state)["q1"] == 1 - first["q1"]
    assert state[ByHand].shown == 2
    assert not is_there(state, state.derived(sheet))
    state = apply(state, ChooseBranch("q5", 1))
    assert choices_of(state)["q1"] == 1 - first["q1"]
    assert choices_of(state)["q5"] == 1
    # An earlier choice lets the later ones go.
    state = apply(state, ChooseBranch("q1", first["q1"]))
    assert state[ByHand].choices == (("q1", first["q1"]),)
    assert choices_of(apply(state, FollowArm())) == first


def test_the_arm_goes_where_the_derivation_ends_and_the_target_stays():
    state = opened("ur5e")
    T = state[Joints].arm.fk(state[Joints].q)
    chosen = choices_of(state)
    state = apply(state, ChooseBranch("q3", 1 - chosen["q3"]))
    q = state.derived(sheet).derivation.q
    there = apply(state, GoByHand())
    assert is_there(there, there.derived(sheet))
    np.testing.assert_allclose(np.cos(there[Joints].q), np.cos(q), rtol=0, atol=1e-9)
    np.testing.assert_allclose(there[Joints].arm.fk(there[Joints].q), T, rtol=0, atol=1e-9)


def test_what_cannot_be_chosen_or_gone_to_is_refused_in_a_sentence():
    state = opened("puma560")
    with pytest.raises(InputError, match=r"expected one with two branches now \(q1, q3, q5\), got 'q9'"):
        apply(state, ChooseBranch("q9", 0))
    with pytest.raises(InputError, match="branch: expected 0 or 1, got 2"):
        apply(state, ChooseBranch("q1", 2))
    with pytest.raises(InputError, match="no joint values"):
        apply(apply(state, EndDrag(moved(state, 7.0, 0.0, 0.0), 1)), GoByHand())
    other = apply(state, ChooseBranch("q1", 1 - choices_of(state)["q1"]))
    with pytest.raises(InputError, match=r"joint 1 is held|outside the joint limits"):
        apply(apply(other, LockJoint(0, True)), GoByHand())
    with pytest.raises(InputError, match="no joint values"):
        apply(opened("manseur_doty"), GoByHand())


def test_another_arm_begins_at_the_first_step_without_choices():
    state = apply(opened("puma560"), ChooseBranch("q5", 1))
    state = apply(state, Set(ByHand, "shown", 5))
    other = state.with_robot(catalogue()["ur5e"])
    assert (other[ByHand].shown, other[ByHand].choices) == (1, ())
    with pytest.raises(InputError, match="choices: not usable"):
        ByHand.from_json({"choices": [["q1", 7]]}, catalogue()["ur5e"])


def test_the_page_asks_for_the_list_of_all_solutions():
    state = searched(opened("ur10_notes", "eight"), BY_HAND)
    found = state[Solutions].found
    assert len(found.rows) == 8
    q = state.derived(sheet).derivation.q
    assert found.nearest(q)[1] < 1e-8


# -- markup ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", COVERED)
def test_every_equation_can_be_shown_with_symbols_and_with_numbers(key):
    state = opened(key)
    for units in (units_of(state), Units(Notation(angle="rad", length="m"))):
        for one in state.derived(sheet).others:
            for step in one.steps:
                for line in step.lines:
                    made = str(equation(line, step, units))
                    assert made.count("<math") >= 2
                    assert not re.search(r"[{}@\\]|&lt;|nan|None", made), made


def test_the_numbers_of_an_equation_have_units_brackets_and_the_chosen_sign():
    state = apply(opened("planar_2r"), MoveJoint(1, math.radians(90.0)))
    state = apply(state, ChooseBranch("q2", 1))
    step = state.derived(sheet).derivation.steps[0]
    said = read(equation(step.lines[-1], step, units_of(state)))
    assert "±" in said
    assert "−90.0°" in said
    in_metres = read(equation(step.lines[0], step, Units(Notation(length="m"))))
    assert in_metres.endswith("1.4142 m")


def test_texts_are_put_into_a_formula_as_texts():
    made = str(filled(r"a = \text{@x@} - \text{@y0@}", {"x": "1 < 2", "y0": "(−3°)"}))
    assert "<mn>1 &lt; 2</mn>" in made
    assert "<mn>(−3°)</mn>" in made
    assert filled(r"\text{@x@}", {"x": "5"}) != filled(r"\text{@x@}", {"x": "6"})


def test_symbols_can_stand_in_the_scene():
    assert [plain(text) for text in (r"\theta_1", "L_2", r"\gamma", r"\rho", "q_4", r"\theta_{5,0}")] == [
        "θ₁",
        "L₂",
        "γ",
        "ρ",
        "q₄",
        "θ₅₀",
    ]


def test_joint_values_out_of_limits_are_told_and_the_arm_cannot_be_sent_there():
    state = opened("puma560")
    assert out_of_limits(state, state.derived(sheet).derivation.q) == ""
    state = apply(state, ChooseBranch("q3", 1 - choices_of(state)["q3"]))
    q = state.derived(sheet).derivation.q
    # The list of all solutions judges the limits by itself.
    outside = [row for row in searched(state, BY_HAND)[Solutions].found.rows if not row.within]
    assert any(np.abs(np.sin(0.5 * (row.q - q))).max() < 1e-9 for row in outside)
    said = out_of_limits(state, q)
    assert said.startswith(" Out of the limits of joint")
    with pytest.raises(InputError, match="outside the joint limits"):
        apply(state, GoByHand())


# -- drawing -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", COVERED)
def test_every_step_is_drawn_and_in_the_picture(key):
    state = opened(key)
    base, units = state[Joints].arm.base, units_of(state)
    for k, step in enumerate(state.derived(sheet).derivation.steps, start=1):
        picture = picture_of(step, base, units)
        assert picture.lines or picture.points
        every = [*picture.lines.values(), *picture.points.values(), *picture.faces]
        assert all(np.isfinite(each).all() for each in every)
        assert all("nan" not in text and "\\" not in text for text, _ in picture.names)
        seen = around(apply(state, Set(ByHand, "shown", k)))
        assert len(seen) == len(corners_of_shapes(step.shapes))


def test_the_drawing_stands_in_the_world():
    state = opened("openmanipulator_x")
    step = state.derived(sheet).derivation.steps[0]
    arm = state[Joints].arm
    tool = picture_of(step, arm.base, units_of(state)).points["wanted"][0]
    np.testing.assert_allclose(tool, arm.fk(state[Joints].q)[:3, 3], rtol=0, atol=1e-9)


# -- on the page -------------------------------------------------------------------------------------------------


def test_the_derivation_is_live_and_says_which_step_fails(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("joints", "by_hand")
        await browser.until(lambda: "law of cosines" in browser.html())
        assert browser.html().count('class="bh-step') == 2
        await browser.set_value(browser.slider(2), 90.0)
        await browser.until(lambda: "elbow down 90.0°" in browser.html() and "elbow up −90.0°" in browser.html())
        await browser.press("q2 1")
        await browser.until(lambda: "Move the arm here" in browser.html())
        await browser.press("go")
        await browser.until(lambda: browser.slider(2)["value"] == pytest.approx(-90.0, abs=0.06))
        await browser.drag("start")
        await browser.drag("update", (3.0, 0.0, 0.0))
        await browser.until(lambda: "Step 1 has no value" in browser.html())
        assert "farther from axis 1 than both links in one line" in browser.html()
        assert "nan" not in browser.html()
        await browser.drag("end")
        await browser.close()

    run(main())


def test_the_steps_are_walked_through_and_unfolded(url):
    async def main():
        browser = await student(url, path="/robot/puma560")
        await browser.open("by_hand")
        await browser.until(lambda: "Step 1 of 8" in browser.html())
        await browser.press("next")
        await browser.until(lambda: "a sin θ + b cos θ = c" in browser.html() and "Step 2 of 8" in browser.html())
        await browser.press("step3")
        await browser.until(lambda: "Step 3 of 8" in browser.html())
        await browser.press("unfold")
        await browser.until(
            lambda: (
                len(re.findall('class="[^"]*"[^>]*data-cell="step[0-9]+"[^>]*aria-expanded="true"', browser.html()))
                == 8
            )
        )
        await browser.until(lambda: "of 8 on the page Solutions" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("key", "why"),
    [
        ("manseur_doty", "one equation of degree 16"),
        ("panda", "One joint is to spare"),
        ("iiwa7", "Once the angle of the elbow is chosen, formulas give the rest; this page does not derive them."),
    ],
)
def test_arms_that_are_not_solved_by_hand_say_why_and_where_to_look(url, key, why):
    async def main():
        browser = await student(url, path=f"/robot/{key}")
        await browser.open("by_hand")
        await browser.until(lambda: why in browser.html())
        await browser.press("solutions")
        await browser.until(lambda: "All solutions" in browser.html())
        if key == "iiwa7":
            await browser.until(lambda: "their distance gives q₄" in browser.html())
        await browser.close()

    run(main())
