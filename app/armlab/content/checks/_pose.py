"""A pose with tolerances, and sentences on a deviation: which part, which axis, which mistake."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import Words, angle_tolerance, length_tolerance, with_edge
from armlab.content.checks._position import point, position_mistake, refuse_out_of_reach
from armlab.content.reader import Table
from armlab.content.robots import Robot
from armlab.kin.rotations import axis_angle, is_rotation, rotation_about, rotation_from_sequence

Matrix = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PoseGoal:
    """A position in the world within metres, and perhaps an orientation within radians.

    ``rpy``, in radians, is what the orientation was written with: R = Rz(yaw) Ry(pitch) Rx(roll); None for a matrix.
    """

    position: Matrix
    within: float
    rotation: Matrix | None = None
    turned_within: float = 0.0
    rpy: Matrix | None = None

    def is_met(self, pose: Matrix) -> bool:
        """Return whether a pose, shape (4, 4), is within the tolerances."""
        return self._is_there(pose) and self._is_turned(pose[:3, :3])

    def says(self, name: str, pose: Matrix, words: Words) -> str:
        """Return a sentence on what deviates: the position, the orientation or both."""
        there, turned = self._is_there(pose), self._is_turned(pose[:3, :3])
        if there and turned:
            return f"{name} is where it should be."
        says = []
        if not there:
            p = pose[:3, 3]
            distance = words.length(float(np.linalg.norm(p - self.position)))
            mistake = position_mistake(p, self.position, self.within, words)
            says.append(f"{name} is {distance} away from {point(self.position, words)}: {mistake}.")
        elif not turned:
            says.append("The position is right, the orientation is not:")
        if not turned:
            mistake = self._turn_mistake(pose[:3, :3], words)
            says.append(mistake if there else f"The orientation is not right either: {mistake}")
        elif self.rotation is not None:
            says.append("The orientation is right.")
        return " ".join(says)

    def _is_there(self, pose: Matrix) -> bool:
        return bool(np.linalg.norm(pose[:3, 3] - self.position) <= with_edge(self.within))

    def _is_turned(self, R: Matrix) -> bool:
        return self.rotation is None or self._near(R, self.rotation)

    def _near(self, R: Matrix, other: NDArray[np.floating]) -> bool:
        return float(axis_angle(R.T @ other)[1]) <= with_edge(self.turned_within)

    def _turn_mistake(self, R: Matrix, words: Words) -> str:
        """Return the mistake that explains an orientation, or the axis with the largest deviation."""
        assert self.rotation is not None
        asked = self.rotation
        named = self._about_another_axis(R) or self._in_other_order(R)
        if self._near(R, asked.T):
            return "the rotation is the transposed one, the inverse of the one asked for."
        if named:
            return named
        off = np.arccos(np.clip(np.sum(R * asked, axis=0), -1.0, 1.0))
        if self._near(R, asked @ rotation_about("xyz"[int(np.argmin(off))], math.pi)):
            first, second = (axis for i, axis in enumerate("xyz") if i != int(np.argmin(off)))
            return f"its axes {first} and {second} point the wrong way; {'xyz'[int(np.argmin(off))]} is right."
        k = int(np.argmax(off))
        return f"its {'xyz'[k]} axis points {words.angle(float(off[k]))} away from where it should."

    def _about_another_axis(self, R: Matrix) -> str:
        """Return the mistake of turning by the right angle about another coordinate axis, or ""."""
        assert self.rotation is not None
        axis, angle = axis_angle(self.rotation)
        right = int(np.argmax(np.abs(axis)))
        if abs(axis[right]) < 1.0 - 1e-9 or float(angle) <= 2.0 * self.turned_within:
            return ""
        signed = float(angle) * float(np.sign(axis[right]))
        for k, name in enumerate("xyz"):
            if k != right and any(self._near(R, rotation_about(name, turn)) for turn in (signed, -signed)):
                return f"it is rotated about {name} instead of {'xyz'[right]}."
        return ""

    def _in_other_order(self, R: Matrix) -> str:
        """Return the mistake of applying roll, pitch and yaw in the reverse order, or ""."""
        if self.rpy is None or not self._near(R, rotation_from_sequence("xyz", self.rpy)):
            return ""
        return "roll, pitch and yaw are in the reverse order: about fixed axes first roll, then pitch, then yaw."


def read_goal(table: Table, robot: Robot, *, turned: bool) -> PoseGoal:
    """Read ``position``, ``tolerance_m``; ``rpy_deg`` or ``rotation``, with ``tolerance_deg``.

    Parameters
    ----------
    table : Table
    robot : Robot
    turned : bool
        Whether an orientation has to be given.
    """
    position, within = table.numbers("position", 3), length_tolerance(table, robot)
    refuse_out_of_reach(table, "position", position, robot, within)
    given = [key for key in ("rpy_deg", "rotation") if table.has(key)]
    if len(given) > 1:
        raise table.fail("rotation", "expected rpy_deg or rotation, got both")
    if not given:
        if turned:
            raise table.fail("rpy_deg", "missing; expected rpy_deg or rotation (for a position alone use 'tool_at')")
        if table.has("tolerance_deg"):
            raise table.fail("tolerance_deg", "expected rpy_deg or rotation with it")
        return PoseGoal(position, within)
    turned_within = angle_tolerance(table)
    if given == ["rotation"]:
        R = table.matrix("rotation")
        if not is_rotation(R):
            raise table.fail("rotation", "expected a rotation matrix: orthonormal, determinant +1, within 1e-6")
        return PoseGoal(position, within, R, turned_within)
    rpy = np.radians(table.numbers("rpy_deg", 3))
    R = np.array(rotation_from_sequence("xyz", rpy, fixed=True), dtype=np.float64)
    return PoseGoal(position, within, R, turned_within, rpy)
