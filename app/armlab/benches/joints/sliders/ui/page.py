"""Joint variables: sliders, locks, poses, and the pose of the tool."""

from __future__ import annotations

from armlab.benches.joints.sliders.ui.typed import TypedValue
from armlab.kin.length_power import POWERS, length_power
from armlab.kin.rotations import euler_zyx
from armlab.session.parts.jog import Jog
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose, TakePose
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.adapter import gui_id
from armlab.ui.colours import css, joint_colour
from armlab.ui.factors import turns
from armlab.ui.form import Form
from armlab.ui.format import capitalised, mathml, matrix, number, pairs, subscript
from armlab.ui.html import Inside, Markup, styles, tag
from armlab.ui.jog import show_jog
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Control, Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build a slider for each joint and the read-out of the tool."""
    joints, units = state[Joints], units_of(state)
    gui.heading("Joint variables")
    controls = [(_slider(gui, joints, i, post, units), TypedValue(gui, i, units, post)) for i in range(joints.arm.n)]
    gui.html(_colours([slider for slider, _ in controls]))
    locks, poses, jog, readout = gui.form(post), gui.form(post), gui.form(post), gui.html()
    names = tuple(dict.fromkeys([*state[RobotPart].robot.poses, "zero"]))

    def show(state: State) -> None:
        joints = state[Joints]
        for i, (slider, typed) in enumerate(controls):
            slider.show(_shown(joints, i, units))
            slider.enable(not joints.locked[i])
            typed.show(joints)
        if not locks.shows(joints.locked):
            locks.show(row("Hold", [_lock(locks, joints, i, units) for i in range(joints.arm.n)]))
        if not poses.shows():
            taken = [poses.chip(name, capitalised(name), TakePose(name)) for name in names]
            poses.show(row("Pose", (taken, poses.chip("random", "Random", RandomPose()))))
        show_jog(jog, state)
        readout.show(_readout(joints, units))

    return show


def _shown(joints: Joints, i: int, units: Units) -> float:
    return units.value(float(joints.q[i]), joints.arm.rows[i].revolute)


def _name(joints: Joints, i: int, units: Units) -> str:
    return units.variable(i, joints.arm.rows[i].revolute)


def _slider(gui: Gui, joints: Joints, i: int, post: Post, units: Units) -> Control:
    revolute = joints.arm.rows[i].revolute
    unit, scale, decimals = units.unit(revolute), units.factor(revolute), units.decimals(revolute)
    low, high = (float(value) / scale for value in joints.arm.limits[i])
    return gui.slider(
        f"{_name(joints, i, units)} {unit}",
        round(low, decimals),
        round(high, decimals),
        10.0**-decimals,
        _shown(joints, i, units),
        lambda value: post(MoveJoint(i, value * scale)),
        None,  # viser's would cover the slider above; the chip that holds the joint says it
    )


def _colours(sliders: list[Control]) -> Markup:
    """Return the style that gives each slider the colour of its joint."""
    rules = []
    for i, slider in enumerate(sliders):
        key, colour = gui_id(slider.handle), css(joint_colour(i))
        rules.append(
            f"label[for='{key}']::before{{content:'';display:inline-block;width:9px;height:9px;border-radius:50%;"
            f"margin-right:7px;background:{colour}}}"
            f"[id='{key}'] .mantine-Slider-bar,[id='{key}'] .mantine-Slider-thumb"
            f"{{background:{colour}!important;border-color:{colour}!important}}"
            f"div:has(>p>label[for='{key}']){{width:4.6em!important}}"
        )
    return styles(rules)


def _lock(form: Form, joints: Joints, i: int, units: Units) -> Markup:
    """Return the chip that holds a joint; its hint describes the joint and its limits."""
    revolute, on = joints.arm.rows[i].revolute, joints.locked[i]
    axis = subscript("z", i if joints.arm.convention == "standard" else i + 1)
    low, high = (units.text(float(value), revolute) for value in joints.arm.limits[i])
    does = f"{'turns about' if revolute else 'slides along'} {axis}, {low} to {high} {units.unit(revolute)}"
    wish = "held: click to release it" if on else "click to hold it at its present value"
    hint = f"Joint {i + 1} {does}; {wish}"
    return form.button(str(i), _name(joints, i, units), LockJoint(i, not on), "chip lock", hint, pressed=on)


def _readout(joints: Joints, units: Units) -> Inside:
    T = joints.tool_pose
    (yaw, pitch, roll), singular = euler_zyx(T[:3, :3])
    position = "\u2002".join(units.text(float(value), False) for value in T[:3, 3])
    angles = [units.turned(float(value)) for value in (yaw, pitch, roll)]
    degrees = "°" if units.in_degrees else ""
    product = turns("zyx", False, [f"{value}{degrees}" for value in angles])
    note = "Pitch is ±90°: only yaw ∓ roll is defined, and roll is set to 0."
    measure = mathml("w"), " of the task", tag("br"), joints.arm.task.title
    return (
        tag("h3", "Tool in the world, ", mathml("{}^{w}T_{E}"), " ", tag("small", "position in m")),
        matrix(T, 3, 3),
        pairs(
            [
                (f"position x y z, {units.length_unit}", position),
                (f"yaw pitch roll, {units.angle_unit}", "\u2002".join(angles)),
                (measure, _manipulability(joints)),
            ]
        ),
        tag("div.eq.small", mathml("R="), " ", product),
        tag("p.dim", note) if bool(singular) else None,
    )


def _manipulability(joints: Joints) -> str:
    power = length_power(joints.arm)
    unit = "(mixed units)" if power is None else POWERS[power]
    return f"{number(joints.manipulability, 4)} {unit}".rstrip()


PANEL = Panel((Joints, Jog), build)
