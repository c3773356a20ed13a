"""The hand at the end of the arm, whose tips are always the tool point of the forward kinematics."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.ui.figure.glb import Part, joint_material
from armlab.ui.figure.mesh import placed
from armlab.ui.figure.solids import along, block, drum, lathe

NATURAL = 4.0
"""Length of a gripper with enough room, in tube radii."""

SHORTEST = 2.0
"""Shortest room for a gripper, in tube radii; with less there is a pointer."""


def gripper(
    tip: NDArray[np.float64], direction: NDArray[np.float64], length: float, r: float, joint: int
) -> list[Part]:
    """Return a two-finger gripper.

    Parameters
    ----------
    tip : ndarray, shape (3,)
        Where the fingers end.
    direction : ndarray, shape (3,)
        Where they point.
    length : float
        From the flange to the tips.
    r : float
        Tube radius at the end of the arm.
    joint : int
        The last joint, for the colour of the ring.
    """
    s = min(1.25 * r, length / 3.2)
    finger = 0.62 * length - 0.5 * s
    parts: list[Part] = [
        ("dark", drum(1.02 * s, 0.18 * s, 0.08 * s, 0.18 * s, soft=True)),
        (joint_material(joint), drum(1.06 * s, 0.09 * s, 0.03 * s, 0.45 * s, soft=True)),
        ("dark", block((2.7 * s, 1.25 * s, 0.30 * length), 0.16 * s, (0.0, 0.0, 0.5 * s + 0.15 * length))),
    ]
    for side in (1.0, -1.0):
        middle = 0.5 * s + 0.30 * length + finger / 2.0
        parts.append(("steel", block((0.42 * s, 0.8 * s, finger), 0.1 * s, (side * 0.85 * s, 0.0, middle))))
        pad = (side * 0.58 * s, 0.0, 0.85 * length)
        parts.append(("rubber", block((0.3 * s, 0.7 * s, 0.3 * length), 0.06 * s, pad)))
    flange = along(direction, tip - length * direction / np.linalg.norm(direction))
    return [(material, placed(mesh, flange)) for material, mesh in parts]


def pointer(tip: NDArray[np.float64], direction: NDArray[np.float64], r: float, joint: int) -> list[Part]:
    """Return a small cone with its tip at the tool point, for arms without room for a gripper."""
    length = 1.6 * r
    cone = lathe([(0.0, 0.0), (0.7 * r, 0.0), (0.55 * r, 0.25 * length), (0.0, length)])
    pose = along(direction, tip - length * direction / np.linalg.norm(direction))
    return [(joint_material(joint), placed(cone, pose))]
