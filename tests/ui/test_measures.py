"""What the panels say of manipulability and of the common normal: formulas, units, names, sentences."""

import asyncio
import math

import numpy as np
import pytest

from armlab.benches.joints.sliders.ui import page as joints
from armlab.benches.robot.normal.state import SNAP_ANGLE, SNAP_DISTANCE, Lines, PlaceLines
from armlab.benches.robot.normal.ui import page as normal
from armlab.benches.velocity.ellipsoid.state import VelocityBlock, placed
from armlab.benches.velocity.ellipsoid.ui import page as ellipsoid
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.format import mathml
from armlab.ui.html import joined
from armlab.ui.units import Units, units_of
from support.student import run, student

METRES = Units(Notation(length="m", angle="rad"))
TASKS = ("xy", "xyz", "xy phi", "phi", "pose", "x", "xyz approach")


def block_of(key, name="translation"):
    return VelocityBlock(catalogue()[key].arm, name)


def random_arm(rng, kinds, task, scale):
    rows = [
        Row(kind, *(scale * rng.uniform(0.2, 0.5), rng.uniform(0.4, 1.2), scale * rng.uniform(0.1, 0.3), 0.0))
        for kind in kinds
    ]
    return Arm.from_dh(rows, task=task)


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize(
    "kinds", ["R", "RR", "RP", "PRP", "RRR", "RPR", "PPP", "RPRR", "RRRR", "RRPRRR", "RRRRRRR", "RPRRPRR"]
)
def test_the_unit_of_w_is_how_it_grows_with_the_arm(kinds, task, rng):
    """Twice the size is twice the lengths: w grows by 2 to the power of its metres, or by no power at all."""
    seed = int(rng.integers(1 << 30))
    small, large = (random_arm(np.random.default_rng(seed), kinds, task, scale) for scale in (1.0, 2.0))
    power = joints.length_power(small)
    growths = []
    for _ in range(6):
        q = rng.uniform(0.2, 1.0, len(kinds))
        w, W = (float(arm.manipulability(q * grown)) for arm, grown in ((small, 1.0), (large, 1.0 + ~small.revolute)))
        if w > 1e-6:
            growths.append(math.log2(W / w))
    if power is not None:
        np.testing.assert_allclose(growths, power, atol=1e-6)


def test_mixed_units_are_called_mixed():
    arm = Arm.from_dh([Row("R", a=0.4, alpha=1.0), Row("P", alpha=0.5)], task="xyz")
    assert joints.length_power(arm) == 1
    redundant = Arm.from_dh([Row("R", a=0.4, alpha=1.0), Row("P", alpha=0.5), Row("R", a=0.3)], task="xy")
    assert joints.length_power(redundant) is None
    shown = joints._manipulability(Joints(redundant, np.array([0.2, 0.3, 0.4]), (False,) * 3))
    assert shown.endswith("(mixed units)")


def test_the_two_w_have_names_of_their_own():
    assert ellipsoid.name_of_w(block_of("puma560")).endswith("of translation")
    assert ellipsoid.name_of_w(block_of("puma560", "rotation")).endswith("of rotation")
    assert ellipsoid.name_of_w(block_of("cylindrical_rpp")).endswith("of translation, scaled by limits")


@pytest.mark.parametrize("key", ["planar_2r", "scara", "puma560"])
def test_w_of_the_task_is_told_with_the_task_of_the_arm(key):
    """A SCARA turns its hand about z alone: that is not the orientation."""
    arm = catalogue()[key].arm
    told = joined(joints._readout(Joints.initial(catalogue()[key]), METRES))
    assert f"of the task<br>{arm.task.title}</span>" in told


def test_the_formula_is_the_one_that_is_computed():
    assert ellipsoid.volume(block_of("puma560")) == (r"w=\sqrt{\det(J_{v}\,J_{v}^T)}=\sigma_1\,\sigma_2\,\sigma_3")
    tall = VelocityBlock(Arm.from_dh([Row("R", a=0.4, alpha=1.1), Row("R", a=0.3)], task="xyz"), "translation")
    assert r"\det(J_{v}^TJ_{v})" in ellipsoid.volume(tall)
    assert r"\sigma_3" not in ellipsoid.volume(tall)
    assert r"\bar{J}=J_{v}\,\mathrm{diag}" in ellipsoid.volume(block_of("cylindrical_rpp"))
    for formula in (ellipsoid.volume(tall), ellipsoid.volume(block_of("cylindrical_rpp"))):
        assert mathml(formula).startswith("<math")


def test_arms_whose_joints_are_of_one_kind_are_not_scaled():
    slides = block_of("cartesian_3p")
    assert ellipsoid.scaling_words(slides, METRES) == "For joint speeds with √(Σ q̇ᵢ²) ≤ 1 m/s."
    assert ellipsoid.volume_unit(slides, 3) == ""
    assert ellipsoid.scaling_words(block_of("puma560"), METRES) == "For joint speeds with √(Σ q̇ᵢ²) ≤ 1 rad/s."
    assert "Revolute and prismatic joints" in ellipsoid.scaling_words(block_of("cylindrical_rpp"), METRES)


def test_the_card_names_the_directions_and_the_ratio():
    block = block_of("planar_2r")
    kind, head, said = ellipsoid.verdict_of(block, placed(block, np.array([0.2, 1.5])))
    assert (kind, head) == ("ok", "Well conditioned")
    assert "In every direction the task controls (x, y): at least" in said
    assert f"{block.ellipsoid([0.2, 1.5]).inverse_condition:.3f}" in said
    kind, head, said = ellipsoid.verdict_of(block, placed(block, np.array([0.2, 0.05])))
    assert (kind, head) == ("warn", "Poorly conditioned")
    block = block_of("puma560")
    assert (
        "In every direction: at least"
        in ellipsoid.verdict_of(block, placed(block, np.array(catalogue()["puma560"].home)))[2]
    )


def test_lines_that_snapped_say_within_what_in_the_students_units():
    lines = State.initial(catalogue()["puma560"])[Lines]
    said = normal._card(type(lines)(lines.first, lines.second, lines.scale, snapped=True), METRES)
    assert f"{SNAP_ANGLE:.3f} rad or {SNAP_DISTANCE * lines.scale:.4f} m of it" in said


def test_lines_without_a_cross_product_say_how_x_is_taken():
    state = State.initial(catalogue()["puma560"])
    said = {kind: joined(normal._products(apply(state, PlaceLines(kind))[Lines])) for kind in normal.CASES}
    assert "perpendicular to both lines" in said["parallel"]
    assert "perpendicular to the line" in said["coincident"]
    assert "n=0" not in said["skew"]
    assert "straight across" not in said["coincident"]


def test_angles_that_move_do_not_fill_the_memory():
    state = State.initial(catalogue()["puma560"])
    first = joined(joints._readout(state[Joints], units_of(state)))
    assert "<msub><mi>R</mi><mi>z</mi></msub>" in first
    before = mathml.cache_info().currsize
    rng = np.random.default_rng(1)
    for _ in range(20):
        joints._readout(state[Joints].moved_to(rng.uniform(-1.0, 1.0, 6)), units_of(state))
    assert mathml.cache_info().currsize == before


def test_lines_of_my_own_are_taken_from_the_list(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("normal")
        await browser.until(lambda: "Axes of arm" in str(browser.controls))
        control = browser.control("Axes of arm")
        own, taken = control["props"]["options"][:2]
        await browser.set_value(control, taken)
        await browser.until(lambda: "of the table" in browser.html())
        await browser.set_value(control, own)
        await browser.until(lambda: "Row 1 of the table" not in browser.html())
        await browser.close()

    run(main())


def test_curves_of_a_moving_arm_are_drawn_when_it_rests(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        await browser.open("ellipsoid")
        await browser.until(lambda: "singular at" in browser.html())
        await browser.set_value(browser.slider(3), 30.0)
        await browser.until(lambda: "updated when the arm is at rest" in browser.html())
        await browser.until(lambda: "singular at" in browser.html())
        await asyncio.sleep(0.05)
        await browser.close()

    run(main())
