"""Overlays: where they stand against forward kinematics, what their names say, and when they are there."""

import re

import numpy as np
import pytest

from armlab.benches.robot.normal.state import TakeAxes
from armlab.content.robots import catalogue
from armlab.kin.dh import Row
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.commands import shortcuts
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.plugin import layers, panel
from armlab.ui.scene._dimensions import dimensions_of
from armlab.ui.scene._strokes import dashes, stretch
from armlab.ui.scene._turns import before_turn
from armlab.ui.scene.angles import name_of
from armlab.ui.units import Units
from support.arms import frames_by_products, random_arm, random_q
from support.fake_browser import CAMERA
from support.student import arm_nodes, is_on, run, student

PLAIN, TABLE = Units(Notation()), Units(Notation(angle="rad", length="m", variable="theta"))
OVERLAYS = {
    "angles": r"/angle(_to)?\d",
    "lengths": r"/(a|alpha|d)\d",
    "projections": "/projections",
    "swept": "/swept",
    "symbols": r"/type\d",
}
"""The switch of each overlay, and what the names of its nodes hold."""


def nodes_of(anatomy, q):
    """Return the poses of nodes 0 to n in the world, as the page has them."""
    poses = [anatomy.root]
    for body, value in zip(anatomy.bodies, q, strict=True):
        motion = np.eye(4)
        if body.revolute:
            motion[:2, :2] = [[np.cos(value), -np.sin(value)], [np.sin(value), np.cos(value)]]
        else:
            motion[2, 3] = body.offset + value
        poses.append(poses[-1] @ body.mount @ motion)
    return poses


def axes_of(arm, frames):
    """Return the direction of the axis of each joint."""
    on = frames[:-1] if arm.convention == "standard" else frames[1:]
    return on[:, :3, 2]


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_arcs_go_from_x_of_the_frame_before_to_x_of_the_joints_own(seed, convention):
    rng = np.random.default_rng(seed)
    arm = random_arm(rng, int(rng.integers(1, 8)), convention=convention, special=seed % 2 == 0)
    anatomy, q = anatomy_of(arm), random_q(arm, rng)
    nodes, frames = nodes_of(anatomy, q), frames_by_products(arm, q)
    for i, (body, row) in enumerate(zip(anatomy.bodies, arm.rows, strict=True)):
        start = nodes[i] @ before_turn(body, row.theta)
        np.testing.assert_allclose(start[:3, 0], frames[i, :3, 0], atol=1e-9)
        np.testing.assert_allclose(start[:3, 2], axes_of(arm, frames)[i], atol=1e-9)
        # Turned by theta, offset included, x is that of frame i, which the arrow hangs on.
        theta = row.theta + (q[i] if row.revolute else 0.0)
        own = start[:3, :3] @ [np.cos(theta), np.sin(theta), 0.0]
        np.testing.assert_allclose(own, frames[i + 1, :3, 0], atol=1e-9)
        np.testing.assert_allclose(nodes[i + 1][:3, 0], frames[i + 1, :3, 0], atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_dimension_lines_measure_the_constants_between_the_frames(seed, convention):
    rng = np.random.default_rng(seed)
    arm = random_arm(rng, int(rng.integers(1, 8)), convention=convention, special=seed % 2 == 0)
    anatomy, q = anatomy_of(arm), random_q(arm, rng)
    nodes, frames = nodes_of(anatomy, q), frames_by_products(arm, q)
    axes = axes_of(arm, frames)
    found = {(one.field, one.index): one for one in dimensions_of(anatomy)}
    for i, row in enumerate(arm.rows):
        before = i if convention == "modified" else i + 1
        assert (("d", i + 1) in found) == (row.revolute and row.d != 0.0)
        assert (("a", before) in found) == (row.a != 0.0)
        assert (("alpha", before) in found) == (row.alpha != 0.0)
        assert (("theta", i + 1) in found) == (not row.revolute and row.theta != 0.0)
    for (field, index), one in found.items():
        T = nodes[one.body]
        lines = one.lines.astype(float) @ T[:3, :3].T + T[:3, 3]
        if field in ("alpha", "theta"):
            centre = lines[-1, 0]
            first, last = (ray / np.linalg.norm(ray) for ray in (lines[-2, 1] - centre, lines[-1, 1] - centre))
            start = axes[index - 1] if index else arm.base[:3, 2]
            end = axes[index] if index < arm.n else frames[-1, :3, 2]
            if field == "theta":
                start, end = frames[index - 1, :3, 0], frames[index, :3, 0]
            np.testing.assert_allclose(first, start, atol=1e-5)
            np.testing.assert_allclose(last, end, atol=1e-5)
            continue
        direction = frames[index, :3, 0] if field == "a" else axes[index - 1]
        np.testing.assert_allclose(lines[1, 0] - lines[0, 0], one.value * direction, atol=1e-5)
        np.testing.assert_allclose(lines[2, 1] - lines[2, 0], one.value * direction, atol=1e-5)
        standard_end = {"a": frames[index, :3, 3], "d": frames[index - 1, :3, 3] + one.value * axes[index - 1]}
        modified_end = {"a": frames[index, :3, 3] + one.value * direction, "d": frames[index, :3, 3]}
        expected = (standard_end if convention == "standard" else modified_end)[field]
        np.testing.assert_allclose(lines[1, 0], expected, atol=1e-5)


def test_names_follow_units_letters_and_offsets():
    assert name_of(PLAIN, 0, Row("R"), -0.5) == "q₁ −28.6°"
    assert name_of(PLAIN, 2, Row("P"), 0.32) == "q₃ 320.0 mm"
    assert name_of(PLAIN, 1, Row("R", theta=-np.pi / 2), np.pi) == "θ₂ = q₂ − 90° = 90.0°"
    assert name_of(PLAIN, 1, Row("P", d=0.1), 0.2) == "d₂ = q₂ + 100 mm = 300.0 mm"
    assert name_of(TABLE, 0, Row("R"), 0.5) == "θ₁ 0.500 rad"
    assert name_of(TABLE, 1, Row("R", theta=0.25), 0.5) == "θ₂ + 0.25 rad = 0.750 rad"
    texts = {one.text(PLAIN) for one in dimensions_of(anatomy_of(catalogue()["puma560"].arm))}
    assert {"d₁ 671.83 mm", "a₂ 431.8 mm", "α₁ 90°", "α₃ −90°"} <= texts
    assert "θ₃ −90°" in {one.text(PLAIN) for one in dimensions_of(anatomy_of(catalogue()["stanford"].arm))}
    texts = {one.text(TABLE) for one in dimensions_of(anatomy_of(catalogue()["puma560"].arm))}
    assert {"d₁ 0.67183 m", "a₂ 0.4318 m", "α₁ 1.5708 rad"} <= texts


def test_a_stretched_line_is_never_mirrored():
    class Line:
        scale = (1.0, 1.0, 1.0)

    for factors in ((2.0, 0, 0), (-2.0, 0, 0), (0, -3.0, 0), (0, 0, -1.0), (-1.0, 2.0, 0), (-1.0, -2.0, 0)):
        line = Line()
        stretch(line, factors)
        assert np.prod(line.scale) > 0.0
        assert [s for s, f in zip(line.scale, factors, strict=True) if f] == [f for f in factors if f]


def test_dashes_begin_and_end_with_the_line():
    made = dashes([1.0, 0.0, 0.0], [1.0, 2.0, 0.0], 5)
    assert made.shape == (5, 2, 3)
    np.testing.assert_allclose(made[0, 0], [1.0, 0.0, 0.0])
    np.testing.assert_allclose(made[-1, 1], [1.0, 2.0, 0.0])


def test_keys_are_given_once():
    keys = [(entry.key, entry.modifier) for entry in shortcuts() if entry.key]
    assert len(keys) == len(set(keys))


class Scene:
    """What a browser has been told of nodes: names, texts, visibility and scale."""

    def __init__(self, browser):
        self.texts, self.made, self.seen = {}, set(), {}
        browser.on_message = self.note

    def note(self, message, _at):
        name = message.get("name", "")
        if "/stage/" in name:
            return  # made anew with every switch
        if message["type"] == "LabelMessage":
            self.texts[name] = message["props"]["text"]
        if message["type"] == "SceneNodeUpdateMessage" and "text" in message["updates"]:
            self.texts[name] = message["updates"]["text"]
        if message["type"] == "SetSceneNodeVisibilityMessage":
            self.seen[name] = message["visible"]
        if name and "props" in message:
            self.made.add(name)
            self.seen[name] = True

    def shown(self, text):
        """Return the names of visible labels that say this."""
        return [name for name, said in self.texts.items() if said == text and self.seen.get(name, True)]


@pytest.mark.parametrize("switch", OVERLAYS)
def test_an_overlay_is_made_when_switched_on_and_hidden_as_a_whole(url, switch):
    async def main():
        browser = await student(url)
        scene = Scene(browser)

        def own():
            """The nodes of the overlay: those of the arm may come at any time."""
            return {name for name in scene.made if re.search(OVERLAYS[switch], name)}

        await browser.open("picture")
        assert not own()
        await browser.press(switch)
        await browser.until(lambda: len(own()) > 3 and is_on(browser, switch))
        await browser.press(switch)
        await browser.until(lambda: not any(scene.seen[name] for name in own()))
        made, texts = own(), dict(scene.texts)
        assert texts
        await browser.open("joints")
        await browser.set_value(browser.slider(1), 30.0)
        half = np.radians(30.0) / 2
        await browser.until(lambda: np.allclose(browser.nodes[arm_nodes(browser)[0]]["wxyz"][3], np.sin(half)))
        assert (own(), scene.texts) == (made, texts)  # while it is hidden, nothing is written to it
        await browser.close()

    run(main())


def test_angles_follow_the_pose_and_all_names_the_units(url):
    async def main():
        browser = await student(url)
        scene = Scene(browser)
        await browser.open("picture", "joints")
        for switch in ("angles", "lengths", "projections"):
            await browser.press(switch)
        await browser.until(lambda: scene.shown("q₁ −18.0°") and scene.shown("a₂ 431.8 mm"))
        await browser.set_value(browser.slider(1), 30.0)
        await browser.until(lambda: bool(scene.shown("q₁ 30.0°")))
        q = np.array(catalogue()["puma560"].home)
        q[0] = np.radians(30.0)
        x = 1e3 * catalogue()["puma560"].arm.position(q)[0]
        await browser.until(lambda: bool(scene.shown(f"x {x:.1f} mm")))
        await browser.press("rad")
        await browser.until(lambda: bool(scene.shown("q₁ 0.524 rad") and scene.shown("α₁ 1.5708 rad")))
        await browser.press("m")
        await browser.until(lambda: bool(scene.shown("a₂ 0.4318 m") and scene.shown(f"x {x / 1e3:.4f} m")))
        await browser.close()

    run(main())


def test_arcs_of_angles_come_to_the_face_that_is_seen_when_the_eye_goes_round(url):
    async def main():
        browser = await student(url)
        await browser.open("picture", "joints")
        await browser.press("angles")

        def arcs():
            found = sorted((name, tuple(pose.get("position", (0.0, 0.0, 0.0)))) for name, pose in browser.nodes.items())
            return [at for name, at in found if re.search(r"/angle_to1$", name)]

        await browser.until(lambda: bool(arcs()) and arcs()[0][2] > 0.0)
        above = arcs()[0][2]
        await browser.send({**CAMERA, "position": (0.5, 0.5, -4.0)})
        await browser.until(lambda: arcs()[0][2] < above)
        await browser.send({**CAMERA, "position": (0.5, 0.5, 4.0)})
        await browser.until(lambda: arcs()[0][2] == above)
        await browser.close()

    run(main())


def test_the_arm_is_out_of_the_way_of_lines_of_ones_own(url):
    async def main():
        browser = await student(url)
        scene = Scene(browser)
        await browser.press("zero")
        await browser.open("normal")

        def arm():
            return {seen for name, seen in scene.seen.items() if name.endswith(("/symbol1", "/symbol6", "/body"))}

        def symbols():
            return [scene.seen[name] for name in scene.seen if "/symbol" in name]

        await browser.until(lambda: any(name.endswith("/line1") for name in scene.made))
        assert arm() <= {False}
        axes = browser.control("Axes of arm")
        await browser.set_value(axes, axes["props"]["options"][2])
        await browser.until(lambda: len(symbols()) == 6 and all(symbols()))
        await browser.set_value(axes, axes["props"]["options"][0])
        await browser.until(lambda: not any(symbols()))
        assert arm() <= {False}
        # The arm that was moved while it was hidden is where it stands now.
        await browser.press("undo")
        await browser.open("robot")
        await browser.until(lambda: any(seen for name, seen in scene.seen.items() if name.endswith("/body")))
        await browser.close()

    run(main())


def test_what_is_in_the_way_are_layers():
    fresh = State.initial(catalogue()["puma560"])
    hidden = panel("normal").hides_then(fresh)
    assert {"arm", "skeleton"} <= set(hidden) <= set(layers())
    assert panel("normal").hides_then(apply(fresh, TakeAxes(0))) == ()
