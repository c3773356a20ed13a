"""Fields for a pose: position, and the angles that an arm controls, typed in the units on screen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx, rotation_from_sequence
from armlab.kin.transforms import inverse
from armlab.session.sizes import MOST_TURNED
from armlab.ui.form import Form, Wish
from armlab.ui.format import mathml
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.units import Units

AXES, ANGLES = ("x", "y", "z"), ("yaw", "pitch", "roll")
COMPONENTS = (*AXES, *ANGLES, "phi")
PRODUCT = r"R=R_z(yaw)\,R_y(pitch)\,R_x(roll)"
FARTHEST = 1e3
"""Largest component of a position that can be typed, metres."""

Floats = NDArray[np.floating]


def typed_component(arm: Arm, pose: Floats, name: str, text: str, units: Units) -> Floats:
    """Return a pose in the world with one typed component: ``x y z`` or ``yaw pitch roll phi`` in the units on screen.

    Raises
    ------
    InputError
        Not a finite number, or an absurd one; `UnknownName` for a component that is none.
    """
    if name not in COMPONENTS:
        raise UnknownName("component", name, COMPONENTS)
    turns = name not in AXES
    value = units.read(text, turns, name)
    most = MOST_TURNED if turns else FARTHEST
    if abs(value) > most:
        raise InputError(
            f"{name}: expected at most {units.constant(most, turns)} either way, got {text.strip()[:40]!r}"
        )
    reference = reference_of(arm)
    local = inverse(reference) @ pose
    if not turns:
        local[AXES.index(name), 3] = value
    else:
        angles = list(euler_zyx(local[:3, :3])[0])
        angles[0 if name == "phi" else ANGLES.index(name)] = value
        local[:3, :3] = rotation_from_sequence("zyx", angles)
    return np.asarray(reference @ local)


def reference_of(arm: Arm) -> NDArray[np.float64]:
    """Return the frame in which poses are typed: the world, or frame 0 of an arm whose base is turned.

    The task is about the axes of frame 0; a wall-mounted planar arm cannot be asked for the world's x and y.
    """
    return np.eye(4) if np.array_equal(arm.base[:3, :3], np.eye(3)) else arm.base


def frame_of_places(arm: Arm) -> str:
    """Return in words in which frame positions are typed; empty for the world."""
    return "in frame 0" if reference_of(arm) is arm.base else ""


def pose_form(
    form: Form, arm: Arm, pose: Floats, units: Units, action: Callable[[Floats], Wish], prefix: str = ""
) -> Markup:
    """Return fields for the components of a pose in the world that an arm controls.

    Parameters
    ----------
    form : Form
    arm : Arm
    pose : ndarray, shape (4, 4)
    units : Units
    action : callable
        Gets the pose with the component that was typed.
    prefix : str
        Their cells begin with it.
    """
    task, reference = arm.task, reference_of(arm)
    local = inverse(reference) @ pose

    def field(name: str, value: str, unit: str, off: bool = False) -> Markup:
        def taken(text: str) -> Wish:
            return action(typed_component(arm, pose, name, text, units))

        return form.field(prefix + name, value, f"{name} in {unit}", taken, off=off)

    where = frame_of_places(arm) or "position"
    axes = [
        field(axis, units.text(float(local[k, 3]), False), units.length_unit, axis not in task.position)
        for k, axis in enumerate(AXES)
    ]
    position = _row(f"{where}, {units.length_unit}", axes)
    yaw, pitch, roll = (units.turned(float(value)) for value in euler_zyx(local[:3, :3])[0])
    if task.rotation == "none":
        return position
    if task.rotation == "phi":
        return joined(position, _row(f"φ about z, {units.angle_unit}", [field("phi", yaw, units.angle_unit)]))
    named = zip(ANGLES, (yaw, pitch, roll), strict=True)
    angles = [field(name, value, units.angle_unit) for name, value in named]
    return joined(position, _row(f"yaw pitch roll, {units.angle_unit}", angles))


def product() -> Markup:
    """Return the product of the three rotations."""
    return tag("div.eq.small", mathml(PRODUCT))


def _row(label: str, cells: list[Markup]) -> Markup:
    return row(label, cells, wide=True, cells=True)
