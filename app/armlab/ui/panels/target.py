"""The target: typed, handled, and what the arm makes of it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx, rotation_from_sequence
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import (
    GoAnotherWay,
    HandleBy,
    PlaceTarget,
    Target,
    TargetToTool,
    target_pose,
    verdict,
)
from armlab.session.session import Refuse
from armlab.session.state import State
from armlab.ui.format import capitalised, mathml
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.units import Units, units_of
from armlab.ui.verdicts import verdict_card
from armlab.ui.widgets import Fields, Gui

ANGLES = ("yaw", "pitch", "roll")
PRODUCT = r"R=R_z(yaw)\,R_y(pitch)\,R_x(roll)"
FARTHEST = 1e3
MOST_TURNED = 20.0 * math.pi
"""Metres and radians; what is typed beyond is a slip of the pen."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the fields, the choices and the verdict."""
    present, units = state, units_of(state)
    task = state[Joints].arm.task

    def typed(cell: str, text: str) -> None:
        try:
            pose = typed_pose(present, cell, text, units)
        except InputError as refusal:
            post(Refuse(str(refusal)))
            show_fields(present)  # what holds, not what was refused
            return
        post(PlaceTarget(pose))

    gui.heading("Target of the tool")
    fields = gui.fields(typed)

    def show_fields(state: State) -> None:
        fields.show(_fields(fields, state, units))

    handles = None
    if task.rotation != "none" and task.position:
        handles = gui.segments(
            "Handle",
            {"move": "Move", "turn": "Turn"},
            state[Target].handle,
            lambda key: post(HandleBy(handle="move" if key == "move" else "turn")),
            "What dragging the handle does; only what this arm controls is offered",
        )
    axes = gui.segments(
        "Along axes of",
        {"world": "World", "tool": "Tool"},
        state[Target].axes,
        lambda key: post(HandleBy(axes="world" if key == "world" else "tool")),
        "Along and about whose axes the handle moves",
    )
    method = gui.dropdown(
        "Method",
        {method.key: capitalised(method.title) for method in ik.methods().values()},
        state[Target].method,
        lambda key: post(HandleBy(method=key)),
        "How the arm follows. All stay inside the joint limits and only ever come closer.",
    )
    card = gui.html()
    back = gui.button("Target to tool", lambda: post(TargetToTool()), "Put the target back on the tool.")
    gui.button(
        "Go there another way",
        lambda: post(GoAnotherWay()),
        "To the nearest other solution inside the limits. All of them are on the page Solutions.",
    )

    def show(state: State) -> None:
        nonlocal present
        present = state
        show_fields(state)
        if handles is not None:
            handles.show(state[Target].handle)
        axes.show(state[Target].axes)
        method.show(state[Target].method)
        card.show(verdict_card(state.derived(verdict), units))
        away = state[Target].pose is not None and state.derived(verdict).status != "reached"
        if back.visible != away:
            back.visible = away

    return show


def typed_pose(state: State, cell: str, text: str, units: Units) -> NDArray[np.floating]:
    """Return the target with one typed component: ``x y z`` or ``yaw pitch roll phi`` in the units on screen.

    Raises
    ------
    InputError
        Not a finite number, or an absurd one.
    """
    turns = cell not in "xyz"
    value = units.read(text, turns, cell)
    most = MOST_TURNED if turns else FARTHEST
    if abs(value) > most:
        raise InputError(f"{cell}: expected at most {units.angle(most) if turns else units.length(most)}, got {text}")
    reference = _reference(state[Joints].arm)
    pose = inverse(reference) @ target_pose(state)
    if cell in "xyz":
        pose["xyz".index(cell), 3] = value
    else:
        angles = list(euler_zyx(pose[:3, :3])[0])
        angles[0 if cell == "phi" else ANGLES.index(cell)] = value
        pose[:3, :3] = rotation_from_sequence("zyx", angles)
    return np.asarray(reference @ pose)


def _reference(arm: Arm) -> NDArray[np.float64]:
    """Return the frame targets are typed in: the world, or frame 0 of an arm whose base is turned.

    The task is about the axes of frame 0; a wall-mounted planar arm cannot be asked for the world's x and y.
    """
    return np.eye(4) if np.array_equal(arm.base[:3, :3], np.eye(3)) else arm.base


def _fields(fields: Fields, state: State, units: Units) -> str:
    arm = state[Joints].arm
    task, reference = arm.task, _reference(arm)
    pose = inverse(reference) @ target_pose(state)
    position = _row(
        f"{'position' if reference is not arm.base else 'in frame 0'}, {units.length_unit}",
        [
            fields.field(
                axis,
                units.text(float(pose[k, 3]), False),
                f"{axis} in {units.length_unit}",
                axis not in task.position,
            )
            for k, axis in enumerate("xyz")
        ],
    )
    yaw, pitch, roll = (units.turned(float(value)) for value in euler_zyx(pose[:3, :3])[0])
    if task.rotation == "none":
        angles = '<p class="dim">This arm controls the position only; its orientation follows.</p>'
    elif task.rotation == "phi":
        angles = _row(f"φ about z, {units.angle_unit}", [fields.field("phi", yaw, f"phi in {units.angle_unit}")])
    else:
        cells = zip(ANGLES, (yaw, pitch, roll), strict=True)
        angles = _row(
            f"yaw pitch roll, {units.angle_unit}",
            [fields.field(name, value, f"{name} in {units.angle_unit}") for name, value in cells],
        )
        angles += f'<div class="eq small">{mathml(PRODUCT)}</div>'
    return position + angles


def _row(label: str, cells: list[str]) -> str:
    return row(label, "".join(cells), wide=True, cells=True)


PANEL = Panel(
    "target",
    "Target",
    "TARGET_ARROW",
    30,
    (Joints, Target),
    build,
    about=(
        "S1.1-inverse-kinematics",
        "4.4",
        "S5.2.1-dls",
        "inverse kinematics",
        "reach a point",
        "drag",
    ),
)
