"""The target: typed, handled, and what the arm makes of it."""

from __future__ import annotations

import math
import re

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
from armlab.ui.format import capitalised, mathml, number, turn, verdict_card
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.widgets import Fields, Gui

ANGLES = ("yaw", "pitch", "roll")
PRODUCT = r"R=R_z(yaw)\,R_y(pitch)\,R_x(roll)"
MOST_MM = 1e6
MOST_DEG = 3600.0


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the fields, the choices and the verdict."""
    present = state
    task = state[Joints].arm.task

    def typed(cell: str, text: str) -> None:
        try:
            pose = typed_pose(present, cell, text)
        except InputError as refusal:
            post(Refuse(str(refusal)))
            show_fields(present)  # what holds, not what was refused
            return
        post(PlaceTarget(pose))

    gui.heading("Target of the tool")
    fields = gui.fields(typed)

    def show_fields(state: State) -> None:
        fields.show(_fields(fields, state))

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
    other = gui.button(
        "Go there another way",
        lambda: post(GoAnotherWay()),
        "Look for another branch that reaches this target, and jump to it.",
    )

    def show(state: State) -> None:
        nonlocal present
        present = state
        show_fields(state)
        if handles is not None:
            handles.show(state[Target].handle)
        axes.show(state[Target].axes)
        method.show(state[Target].method)
        card.show(verdict_card(state.derived(verdict)))
        status = state.derived(verdict).status
        away = state[Target].pose is not None and status != "reached"
        for button, on in ((back, away), (other, away and status in ("limit", "closest"))):
            if button.visible != on:
                button.visible = on

    return show


def typed_pose(state: State, cell: str, text: str) -> NDArray[np.floating]:
    """Return the target with one typed component: ``x y z`` in mm, ``yaw pitch roll phi`` in degrees.

    Raises
    ------
    InputError
        Not a finite number, or an absurd one.
    """
    unit, most = ("mm", MOST_MM) if cell in "xyz" else ("degrees", MOST_DEG)
    plain = text.strip().replace("−", "-").replace(",", ".")
    if not re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d{1,3})?", plain, re.IGNORECASE):
        raise InputError(f"{cell}: expected a number in {unit}, got {text.strip()[:40]!r}")
    value = float(plain)
    if not math.isfinite(value) or abs(value) > most:
        raise InputError(f"{cell}: expected at most {most:,.0f} {unit}, got {text.strip()[:40]}")
    reference = _reference(state[Joints].arm)
    pose = inverse(reference) @ target_pose(state)
    if cell in "xyz":
        pose["xyz".index(cell), 3] = value / 1000.0
    else:
        angles = list(euler_zyx(pose[:3, :3])[0])
        angles[0 if cell == "phi" else ANGLES.index(cell)] = math.radians(value)
        pose[:3, :3] = rotation_from_sequence("zyx", angles)
    return np.asarray(reference @ pose)


def _reference(arm: Arm) -> NDArray[np.float64]:
    """Return the frame targets are typed in: the world, or frame 0 of an arm whose base is turned.

    The task is about the axes of frame 0; a wall-mounted planar arm cannot be asked for the world's x and y.
    """
    return np.eye(4) if np.array_equal(arm.base[:3, :3], np.eye(3)) else arm.base


def _fields(fields: Fields, state: State) -> str:
    arm = state[Joints].arm
    task, reference = arm.task, _reference(arm)
    pose = inverse(reference) @ target_pose(state)
    position = _row(
        "position, mm" if reference is not arm.base else "in frame 0, mm",
        [
            fields.field(axis, number(1000.0 * float(pose[k, 3]), 1), f"{axis} in mm", axis not in task.position)
            for k, axis in enumerate("xyz")
        ],
    )
    yaw, pitch, roll = (turn(float(value)) for value in euler_zyx(pose[:3, :3])[0])
    if task.rotation == "none":
        angles = '<p class="dim">This arm controls the position only; its orientation follows.</p>'
    elif task.rotation == "phi":
        angles = _row("φ about z, °", [fields.field("phi", yaw, "phi in degrees")])
    else:
        cells = zip(ANGLES, (yaw, pitch, roll), strict=True)
        angles = _row("yaw pitch roll, °", [fields.field(name, value, f"{name} in degrees") for name, value in cells])
        angles += f'<div class="eq small">{mathml(PRODUCT)}</div>'
    return position + angles


def _row(label: str, cells: list[str]) -> str:
    return f'<div class="row wide"><span>{label}</span><div class="cells">{"".join(cells)}</div></div>'


PANEL = Panel("target", "Target", "TARGET_ARROW", 30, (Joints, Target), build)
