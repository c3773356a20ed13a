"""The page of the singularity microscope as a browser gets it."""

import re

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid.state import VelocityBlock, placed
from armlab.benches.velocity.ellipsoid.ui.words import verdict_of
from armlab.benches.velocity.microscope.commands import AimAlong, BringNear, SetComponent, SetDamping
from armlab.benches.velocity.microscope.examples import ChooseMicroscopeExample
from armlab.benches.velocity.microscope.looked import known_places, looked, near
from armlab.benches.velocity.microscope.state import Microscope
from armlab.benches.velocity.microscope.ui.bars import bars, scale_of
from armlab.benches.velocity.microscope.ui.page import damping_markup, head_markup, speed_unit, wish_markup
from armlab.benches.velocity.microscope.ui.scene import names_of
from armlab.benches.velocity.microscope.ui.words import (
    NAMES,
    components,
    condition_card,
    scales_words,
    sigma_bars,
    table,
)
from armlab.benches.velocity.solve.found import found as solved
from armlab.benches.velocity.solve.ui.words import singular_card
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.state import State, apply
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.student import run, student


def opened(key, *given):
    state = State.initial(catalogue()[key])
    for command in given:
        state = apply(state, command)
    return state


def page_of(state):
    look, units = state.derived(looked), units_of(state)
    return (
        condition_card(look, state.derived(near), units)
        + bars(look, units)
        + table(look, BareForm(), units)
        + sigma_bars(look)
    )


def test_no_page_at_any_known_singularity_holds_a_number_that_is_none(robot):
    start = opened(robot.key)
    for distance in (0.0, 1e-9, 0.05):
        for i in range(len(known_places(start))):
            state = apply(apply(start, Set(Microscope, "distance", distance)), BringNear(i))
            for aim in ("lost", "across"):
                page = page_of(apply(state, Set(Microscope, "aim", aim)))
                assert not re.search(r"\bnan\b|\binf\b|∞", page)
                assert "<rect" in page


def test_bars_are_finite_but_for_the_inverse_which_says_it_does_not_exist():
    state = opened("planar_2r", MoveJoint(1, 0.0), Set(Microscope, "aim", "across"))
    picture = bars(state.derived(looked), units_of(state))
    assert picture.count("<rect") == 2 * 4
    assert [word in picture for word in (">does<", ">not<", ">exist<")] == [True] * 3
    heights = [float(height) for height in re.findall(r'<rect[^>]* height="([^"]+)"', picture)]
    assert np.isfinite(heights).all()
    assert max(heights) <= 47.0
    words = table(state.derived(looked), BareForm(), units_of(state))
    assert "J is singular here: J⁻¹ does not exist" in words


@pytest.mark.parametrize(("key", "how_far"), [("planar_2r", "34.4°"), ("scara", "34.4° or 401.1 mm")])
def test_where_none_is_near_the_page_says_how_far_it_looked(key, how_far):
    state = opened(key, MoveJoint(1, 1.5))
    card = condition_card(state.derived(looked), state.derived(near), units_of(state))
    assert f"No singularity was found that one joint alone reaches within {how_far}." in card


def test_what_is_too_long_is_cut_and_told():
    state = opened("planar_2r", MoveJoint(1, 0.01))
    look, units = state.derived(looked), units_of(state)
    picture = bars(look, units)
    assert picture.count('class="cut"') == 4
    inverse = next(each for each in look.answers if each.key == "inverse")
    assert np.abs(inverse.step.qdot).max() > scale_of(look.answers)
    most = np.degrees(np.abs(inverse.step.qdot).max())
    assert f"{most:.1f} °/s" in picture.replace("−", "")


def test_speeds_above_the_limits_of_the_joints_are_marked():
    state = opened("planar_2r", ChooseMicroscopeExample("near_stretched"))
    words = table(state.derived(looked), BareForm(), units_of(state))
    limits = state[Joints].arm.speed_limits
    rows = dict(zip(NAMES, words.split("<tr>")[2:], strict=True))
    for each in state.derived(looked).answers:
        speeds = np.abs(each.step.qdot * state[Microscope].task.joint_units)
        assert ("Above the speed limit" in rows[each.key]) == bool(np.any(speeds > limits))
    assert words.count("Above the speed limit") == 2
    assert "The tool moves at 300.0 mm/s" in rows["pinv"]


def test_joints_that_slide_have_speeds_of_their_own():
    page = page_of(opened("scara"))
    assert "mm/s" in page
    assert page.count("max |q̇|") == 2
    assert [name for name, _ in components(catalogue()["scara"].arm.task)] == ["v_x", "v_y", "v_z", "ω_z"]
    assert len(components(catalogue()["puma560"].arm.task)) == 6


def test_fields_become_commands_and_nonsense_is_said():
    state = opened("planar_2r")
    look, units = state.derived(looked), units_of(state)

    def typed(cell, text=""):
        def made(form):
            wish = head_markup(form, state, units) + wish_markup(form, look, units)
            return wish + table(look, form, units) + damping_markup(form, look)

        return asked(made, cell, text)

    assert typed("v 0", "250 mm") == (SetComponent(0, 0.25),)
    assert typed("place 1") == (BringNear(1),)
    assert typed("aim across") == (Set(Microscope, "aim", "across"),)
    assert typed("along 1") == (AimAlong(1),)
    assert typed("watch pinv") == (Set(Microscope, "method", "pinv"),)
    assert typed("distance", "90") == (Set(Microscope, "distance", np.pi / 2),)
    assert typed("d epsilon", "0,5") == (SetDamping("epsilon", 0.5),)
    for cell, text, says in (
        ("v 0", "fast", "v_x: expected a number in mm"),
        ("speed", "x", "size: expected a number"),
        ("speed", "1e9", "size: expected a number in m/s from 1e−6 to 100, got '1e9'"),
        ("d lambda", "x", "λ .damping factor.: expected a number"),
        ("distance", "x", "distance: expected a number in degrees"),
    ):
        with pytest.raises(InputError, match=says):
            typed(cell, text)


def test_a_look_costs_one_decomposition_for_each_method_at_most(monkeypatch):
    """The scene follows a drag with one decomposition and one answer; no clock."""
    state = opened("puma560")
    calls = []
    monkeypatch.setattr(np.linalg, "svd", lambda *a, _svd=np.linalg.svd, **k: calls.append(1) or _svd(*a, **k))
    look = looked(state)
    look.answer("dls_variable")
    assert len(calls) <= 2


async def says(browser, text):
    await browser.until(lambda: text in browser.html())


def test_the_page_brings_the_arm_near_and_answers(url):
    async def main():
        browser = await student(url)
        await browser.open("microscope")
        await says(browser, "Wrist: q₅")
        await browser.press("example", "wrist")
        await says(browser, "2.0° away, at q₅ = ")
        await browser.press("distance", "5")
        cell = re.search(r'data-cell="(place \d)"[^>]*>Wrist', browser.html())[1]
        await browser.press(cell)
        await says(browser, "5.0° away, at q₅ = ")
        await browser.press("along 5")
        await browser.press("d lambda", "0.04")
        await says(browser, 'value="0.04"')
        await browser.press("d epsilon", "-1")
        await says(browser, "ε (σ_min below which it is damped): expected a number")
        await browser.press("watch pinv")
        await browser.press("v 5", "12")
        await says(browser, 'value="12"')
        await browser.press("example", "stretched")
        await says(browser, "J is singular here: J⁻¹ does not exist")
        await says(browser, "Elbow: the arm is stretched")
        assert any("microscope_wish" in name for name in browser.nodes)
        await browser.close()

    run(main())


def test_the_example_frees_held_joints():
    state = opened("planar_2r", ChooseMicroscopeExample("stretched"))
    assert state[Joints].q[1] == 0.0
    assert state[Microscope].aim == "lost"


def test_a_size_and_a_damping_have_units():
    for key, size, squared in (("planar_2r", "m/s", " m² here"), ("puma560", "1/s, scaled", " here")):
        state = opened(key)
        assert speed_unit(state.derived(looked)) == size
        assert re.search(rf"λ\(σ\) is [\d.]+{squared}<", damping_markup(BareForm(), state.derived(looked)))


def test_where_wish_and_reached_meet_they_have_one_name():
    wish = np.array([0.8, 0.0, 0.0, 0.0, 0.6, 0.0])
    assert names_of(wish, wish) == (("wanted, reached", "ω wanted, reached"), ("", ""))
    assert names_of(wish, 0.5 * wish) == (("wanted", "ω wanted"), ("reached", "ω reached"))
    assert names_of(wish, np.array([0.8, 0, 0, 0, 0, 0])) == (("wanted, reached", "ω wanted"), ("", ""))


def test_arrows_too_short_to_carry_a_name_beside_those_of_the_joints_have_none():
    wish, reached = np.array([0.99, 0.0, 0.0, 0.12, 0.0, 0.0]), np.array([0.03, 0.0, 0.0, 0.0, 0.3, 0.0])
    assert names_of(wish, reached) == (("wanted", ""), ("", "ω reached"))
    assert names_of(wish, np.zeros(6)) == (("wanted", ""), ("", ""))


def test_the_speed_of_a_sliding_joint_is_in_true_metres():
    """v_z of the SCARA is the speed of joint 3, whatever length the picture is scaled by."""
    state = opened("scara", AimAlong(2), SetComponent(2, 0.25))
    look, units = state.derived(looked), units_of(state)
    assert look.task.length != 1.0
    assert re.search(r"q₃: −?250\.0 mm/s", bars(look, units))
    row = table(look, BareForm(), units).split("<tr>")[2:][list(NAMES).index("pinv")]
    assert re.findall(r">(−?[\d.]+)<", row) == ["0.0", "250.0"]


def test_the_name_of_the_lost_direction_is_away_from_that_of_the_wish(url):
    async def main():
        browser = await student(url)
        await browser.open("microscope")
        await browser.press("example", "near_stretched")
        await says(browser, "3.0° away, at q₂ = ")

        def way(suffix):
            """z of a node, along which its name stands."""
            wxyz = next(node["wxyz"] for name, node in browser.nodes.items() if name.endswith(suffix))
            return rotation_from_quaternion(wxyz)[:, 2]

        await browser.until(lambda: way("microscope_lost_moving") @ way("microscope_wish/moving") < -0.5)
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("q2", "verdict"), [(0.0, "Singular"), (0.05, "Poorly conditioned"), (1.5, "Well conditioned")]
)
def test_one_configuration_has_one_verdict_on_every_page(q2, verdict):
    state = opened("planar_2r", MoveJoint(0, 0.2), MoveJoint(1, q2))
    units = units_of(state)
    block = VelocityBlock(state[Joints].arm, "translation")
    assert verdict in condition_card(state.derived(looked), state.derived(near), units)
    assert verdict in singular_card(solved(state))
    assert verdict_of(block, placed(block, state[Joints].q))[1] == verdict


LINKS = [("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)]
"""A planar 3R, whose tool cannot move along z."""


@pytest.mark.parametrize(
    ("q", "verdict"), [((0.2, 0.0, 0.0), "Singular"), ((0.2, 0.1, 0.0), "Poorly"), ((0.2, 1.0, 1.0), "Well")]
)
def test_what_no_configuration_can_do_does_not_make_this_one_singular(q, verdict):
    state = State.initial(own_robot(Arm.from_dh(LINKS, task="xyz"), "own"))
    for i, value in enumerate(q):
        state = apply(state, MoveJoint(i, value))
    card = condition_card(state.derived(looked), state.derived(near), units_of(state))
    assert verdict in card
    assert verdict in singular_card(solved(state))
    assert state.derived(looked).singular == (verdict == "Singular")
    assert "The rank of J is at most 2 of 3 in any configuration." in card
    assert ("Elbow: the arm is stretched" in card) == (verdict != "Well")


def test_where_no_joint_moves_what_is_asked_nothing_is_singular():
    turns = [("R", 0.0, -np.pi / 2, 0.0, 0.0), ("R", 0.0, np.pi / 2, 0.0, 0.0), ("R", 0.0, 0.0, 0.0, 0.0)]
    state = State.initial(own_robot(Arm.from_dh(turns, task="xyz"), "own"))
    assert "Rank 0 everywhere" in condition_card(state.derived(looked), state.derived(near), units_of(state))
    assert (state.derived(looked).singular, known_places(state)) == (False, ())


@pytest.mark.parametrize(("size", "told"), [(1e-4, "0.00015 m"), (1.0, "1.5 m")])
def test_the_length_by_which_others_are_divided_is_not_rounded_away(size, told):
    arm = Arm.from_dh([("R", size, 0.0, 0.0, 0.0)] * 3, task="xy phi")
    assert f"divided by {told}" in scales_words(State.initial(own_robot(arm, "own")).derived(looked))
