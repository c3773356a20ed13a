"""The page of statics, and what the page of the ellipsoids says of forces, through the protocol and as markup."""

import math
import re

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid.state import VelocityBlock, placed
from armlab.benches.velocity.ellipsoid.state_circle import mapped
from armlab.benches.velocity.ellipsoid.ui.force import force_axes, force_numbers, force_verdict, torque_words
from armlab.benches.velocity.ellipsoid.ui.map import pictures
from armlab.benches.velocity.ellipsoid.ui.scene import force, force_half, speed_half
from armlab.benches.velocity.statics.examples import ChooseExample
from armlab.benches.velocity.statics.state import (
    DrawDisplacement,
    ReleaseWrench,
    SetComponent,
    Statics,
    WriteAlong,
    balance,
)
from armlab.benches.velocity.statics.ui.page import head_markup
from armlab.benches.velocity.statics.ui.scene import torque_name
from armlab.benches.velocity.statics.ui.words import duality_markup, free_markup, torques_markup, verdict, work_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.bench import PutInPlace
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from support.done import done
from support.forms import BareForm, asked
from support.student import run, student


def put(key):
    return apply(State.initial(catalogue()["puma560"]), PutInPlace(f"statics/{key}"))


TORQUES, FORCES = r"A full bar or arc is [\d.]+ N m\.", r"For a prismatic joint a full bar or arrow is 50 N\."


@pytest.mark.parametrize(
    ("robot", "force", "says"),
    [
        ("planar_2r", 50.0, TORQUES),
        ("scara", 50.0, f"{TORQUES} {FORCES}"),
        ("cartesian_3p", 50.0, FORCES),
        ("scara", 0.0, TORQUES),
        ("cartesian_3p", 0.0, ""),
    ],
)
def test_a_full_bar_is_told_for_the_joints_there_are(robot, force, says):
    state = apply(State.initial(catalogue()[robot]), Set(Statics, "force", (force, 0.0, 0.0)))
    state = apply(state, Set(Statics, "moment", (0.0, 0.0, 5.0)))
    assert re.search(rf'<p class="dim">{says}</p>', str(torques_markup(state)))


def test_the_bar_of_a_slide_is_its_part_of_the_full_force():
    state = apply(State.initial(catalogue()["scara"]), Set(Statics, "force", (0.0, 0.0, -40.0)))
    part, found = state[Statics], state.derived(balance)
    assert part.full_force == 50.0
    np.testing.assert_allclose(np.abs(part.shares(state[Joints].arm, found.torques)), [0, 0, 0.8, 0], rtol=0, atol=1e-9)
    assert re.findall(r"--width:([\d.]+)%", str(torques_markup(state))) == ["0.0", "0.0", "40.0", "0.0"]
    none = apply(state, Set(Statics, "force", (0.0, 0.0, 0.0)))
    assert none[Statics].shares(state[Joints].arm, found.torques)[2] == 0.0


def test_fields_and_buttons_become_commands():
    state = put("along")

    def typed(cell, text=""):
        return asked(lambda form: head_markup(form, state[Statics]) + work_markup(form, state), cell, text)

    assert typed("force 0", "12,5 N") == (SetComponent("force", 0, 12.5),)
    assert typed("moment 2", "−3 Nm") == (SetComponent("moment", 2, -3.0),)
    assert typed("release") == (ReleaseWrench(),)
    assert typed("displacement") == (DrawDisplacement(),)
    assert typed("tool") == (WriteAlong("tool"),)
    assert typed("example", "press") == (ChooseExample("press"),)
    assert typed("example") == ()
    with pytest.raises(InputError, match="moment, y: expected a number in N m, got 'strong'"):
        typed("moment 1", "strong")
    with pytest.raises(InputError, match="force, x: expected a number in N, got '5 Nm'"):
        typed("force 0", "5 Nm")


@pytest.mark.parametrize("newtons", [1e3, 1e4, 1e5, 1e6])
def test_works_of_nothing_agree_however_large_the_terms_that_cancel(newtons):
    for degrees in (0.0, 17.0, 50.0, 90.0, 133.0):
        q1 = math.radians(degrees)
        state = done(put("along"), MoveJoint(0, q1), MoveJoint(1, 0.0))
        state = done(state, *(SetComponent("force", k, newtons * f(q1)) for k, f in enumerate((math.cos, math.sin))))
        said = str(work_markup(BareForm(), state))
        assert "✓" in said
        assert "✕" not in said


def test_the_card_says_which_joint_works_or_why_none_does():
    state = put("along")
    kind, head, said = verdict(state.derived(balance), state[Joints].arm.revolute)
    assert (kind, head) == ("ok", "No torque needed")
    assert "carries" in said
    state = put("press")
    kind, head, said = verdict(state.derived(balance), state[Joints].arm.revolute)
    assert head == "Joint 3 needs the most"
    assert said == "τ₃ = 30.00 N. Joints 1, 2 and 4 need none."
    planar = apply(State.initial(catalogue()["planar_2r"]), ReleaseWrench())
    planar = apply(planar, SetComponent("moment", 2, -2.0))
    kind, head, said = verdict(planar.derived(balance), planar[Joints].arm.revolute)
    assert (head, said) == ("Joints 1 and 2 need the most", "τ₁ = −2.000 N m, τ₂ = −2.000 N m.")
    nothing = apply(state, ReleaseWrench())
    assert verdict(nothing.derived(balance), state[Joints].arm.revolute)[1] == "No wrench"


def test_bars_have_the_unit_of_their_joint():
    shown = torques_markup(put("slide"))
    assert shown.count("<i>N m</i>") == 2
    assert shown.count("<i>N</i>") == 1
    assert '<b class="zero">0</b>' in torques_markup(put("press"))


def test_forces_without_torque_are_named():
    assert "Any force along (0.87, 0.50, 0.00), along z of the world, or between." in free_markup(put("along"))
    assert "A force along z of the world." in free_markup(put("torques_2r"))
    assert "Every force by itself needs torques." in free_markup(put("weight"))


def test_the_table_of_dual_subspaces_counts_dimensions():
    shown = duality_markup(put("torques_2r"))
    numbers = [
        cell.split("<")[0] for cell in shown.split("<td")[1:] if cell[0] == ">" or cell.startswith(' class="zero"')
    ]
    counts = [text.rsplit(">", 1)[1] for text in numbers if text.rsplit(">", 1)[1].isdecimal()]
    # R(J), N(J^T), R(J^T), N(J); each for whole wrenches, forces, moments.
    assert counts == ["2", "2", "1", "4", "1", "2", "2", "2", "1", "0", "0", "1"]


def test_torques_in_the_scene_have_units_and_true_zeros():
    assert torque_name(0, True, 1.5, 1e-9) == "τ₁ 1.50 N m"
    assert torque_name(2, False, -30.0, 1e-9) == "τ₃ −30.00 N"
    assert torque_name(2, False, 1e-12, 1e-9) == "τ₃ 0"


def test_force_half_axes_end_in_infinity_where_no_torque_is_needed():
    block = VelocityBlock(catalogue()["planar_2r"].arm, "translation")
    stretched = placed(block, np.array([0.3, 0.0]))
    endless = force_half(block, stretched, 1)
    assert endless.length == math.inf
    assert endless.text == "1/σ₂ ∞: any force, no torque"
    assert speed_half(block, stretched, 1).lost
    # Side by side they do not say it twice, at the same place.
    assert speed_half(block, stretched, 1, both=True).text == "σ₂ 0: no speed, any force"
    assert force_half(block, stretched, 1, both=True) == (math.inf, "", False)
    assert force_half(block, stretched, 2).text == ""
    assert force_verdict(block, stretched)[1] == "No torque needed"
    assert "∞" in force_numbers(block, stretched)
    assert "<b>∞</b>" in force_axes(block, stretched)
    assert force(block, 1e9).startswith("over ")
    bent = placed(block, np.array([0.3, 1.2]))
    named = [[half(block, bent, i, both=True).text != "" for i in range(2)] for half in (speed_half, force_half)]
    assert named == [[True, False], [False, True]]
    kind, head, said = force_verdict(block, bent)
    assert (kind, head) == ("ok", "Slow is strong")
    assert f"{1.0 / bent.sigma[1]:.2f} N" in said


@pytest.mark.parametrize(
    ("units", "said"),
    [
        ((), "δq = (0.57°, 0.57°, 7.5 mm)"),
        ((("length", "m"), ("angle", "rad")), "δq = (0.0100 rad, 0.0100 rad, 0.0075 m)"),
    ],
)
def test_a_virtual_displacement_is_told_in_all_units_and_is_not_zero(units, said):
    state = State.initial(catalogue()["polar_rrp"])
    for name, unit in units:
        state = apply(state, Set(Notation, name, unit))
    assert said in work_markup(BareForm(), state)


def test_no_direction_is_the_strongest_where_all_half_axes_are_alike():
    arm = catalogue()["cartesian_3p"].arm
    block = VelocityBlock(arm, "translation")
    found = placed(block, arm.limits.mean(axis=1))
    assert force_verdict(block, found) == ("ok", "Equally strong", "In every direction: 1.00 N.")
    arm = Arm.from_dh([Row("R", np.sqrt(0.5), 0.0), Row("R", 0.5, 0.0)])
    block = VelocityBlock(arm, "translation")
    found = placed(block, np.array([0.4, 0.75 * np.pi]))
    assert force_verdict(block, found)[1:] == ("Equally strong", "In every direction the task controls (x, y): 2.00 N.")


def test_the_torques_that_count_as_one_are_said():
    for key, words in (("puma560", "≤ 1 N m."), ("cartesian_3p", "≤ 1 N."), ("cylindrical_rpp", "≤ 1 W.")):
        assert torque_words(VelocityBlock(catalogue()[key].arm, "translation")).endswith(words)


def test_circle_and_ellipse_are_drawn_with_the_same_point():
    state = apply(State.initial(catalogue()["planar_2r"]), MoveJoint(1, 0.0))
    found = state.derived(mapped)
    shown = pictures(found, VelocityBlock(state[Joints].arm, "translation"))
    assert shown.count("<svg") == 2
    assert "nan" not in shown
    assert f"v = ({found.velocity[0]:.3f}".replace("-", "−") in shown


def test_the_page_shows_torques_and_takes_a_wrench(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("statics")
        await browser.until(lambda: "needs the most" in browser.html())
        await browser.press("example", "along")
        await browser.until(lambda: "No torque needed" in browser.html())
        await browser.press("force 0", "much")
        await browser.until(lambda: "force, x: expected a number in N" in browser.html())
        await browser.press("force 0", "2000000")
        await browser.until(lambda: "force: expected at most 1e+06 N" in browser.html())
        assert 'value="2000000"' in browser.html()
        assert not browser.notices
        await browser.press("force 0", "0")
        await browser.press("force 1", "20")
        await browser.until(lambda: "needs the most" in browser.html())
        await browser.press("displacement")
        await browser.until(lambda: "✓" in browser.html())
        assert any(name.endswith("/statics/force/shaft") for name in browser.nodes)
        assert any(name.endswith("/torque1/arc") for name in browser.nodes)
        await browser.close()

    run(main())


def test_the_tip_of_the_force_can_be_pulled(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("statics")
        await browser.until(lambda: any(name.endswith("/force_tip") for name in browser.nodes))
        node = next(name for name in browser.nodes if name.endswith("/force_tip"))
        await browser.until(lambda: "position" in browser.nodes[node])
        x, y, z = browser.nodes[node]["position"]
        await browser.drag("start", node=node)
        await browser.drag("update", (x + 0.1, y, z), (1.0, 0.0, 0.0, 0.0), node=node)
        await browser.drag("end", node=node)
        await browser.until(lambda: 'data-cell="force 0"' in browser.html() and 'value="12"' not in browser.html())
        await browser.close()

    run(main())


def test_the_ellipsoid_of_forces_can_be_chosen(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("ellipsoid")
        await browser.until(lambda: "el-map" in browser.html())
        assert "r = √(l₁² + l₂²) = 1414.2 mm" in browser.html()
        await browser.press("both")
        await browser.until(lambda: "Slow is strong" in browser.html())
        assert "Well conditioned" in browser.html()
        await browser.until(lambda: any(name.endswith("_force/body") for name in browser.nodes))
        await browser.press("force")
        await browser.until(lambda: "Well conditioned" not in browser.html())
        await browser.close()

    run(main())
