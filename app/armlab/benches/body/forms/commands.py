"""Commands that turn the body: a drag, and each form in which a rotation can be typed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.body.forms.rotation import STILL, forms, forms_of, triples_of
from armlab.benches.body.forms.state import Body
from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.kin.nearest import nearest_rotation
from armlab.kin.quaternions import exponential, unit
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_quaternion, rotation_from_sequence
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import put
from armlab.session.state import Command, State

PLACES: dict[str, tuple[str, str, bool, tuple[float, float, float]]] = {
    "none": ("None", "zyx", False, (0.0, 0.0, 0.0)),
    "quarter": ("z by 90°", "zyx", False, (90.0, 0.0, 0.0)),
    "half": ("Half turn", "zyx", False, (180.0, 0.0, 0.0)),
    "lock": ("Lock, ZYX", "zyx", False, (40.0, 90.0, 20.0)),
    "zxz": ("Lock, ZXZ", "zxz", False, (30.0, 180.0, 50.0)),
}
"""Orientations to begin with, by key: title, sequence, whether about fixed axes, and angles in degrees."""


def turned(part: Body, q: ArrayLike, **more: Any) -> Body:
    """Return the body with an orientation, and the other fields that follow it; ``more`` are fields as they were typed.

    Parameters
    ----------
    part : Body
    q : array_like, shape (4,)
        A quaternion of any length but zero.
    """
    body = part.with_values({"q": _floats(q), "matrix": None})
    straight = unit(body.q)
    R = np.asarray(rotation_from_quaternion(straight), dtype=np.float64)
    axes, fixed = more.get("axes", part.axes), more.get("fixed", part.fixed)
    values: dict[str, Any] = {
        "angles": _floats(triples_of(R, axes, fixed, np.array(more.get("angles", part.angles))).shown)
    }
    if np.linalg.norm(straight[1:]) > STILL:
        values["axis"] = _floats(straight[1:] / np.linalg.norm(straight[1:]))
    return body.with_values(values | more)


def _floats(values: ArrayLike) -> list[float]:
    found: list[float] = np.asarray(values, dtype=float).tolist()
    return found


def _with(values: Sequence[float], index: int, value: float, name: str) -> list[float]:
    """Return values with one replaced, counted from 0."""
    refuse_beyond(index, len(values), name)
    return [value if k == index else float(each) for k, each in enumerate(values)]


@dataclass(frozen=True, eq=False)
class TurnBody(Command):
    """Turn the body; this is one event of a drag.

    Parameters
    ----------
    wxyz : ndarray, shape (4,)
    drag : object
        Which drag it belongs to; one drag is one step of undo.
    """

    wxyz: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "turn of the body"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return TurnBody, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the body there, and of q and -q the one that is nearer to the quaternion before."""
        part = state[Body]
        before, q = unit(part.q), unit(self.wxyz)
        return put(state, turned(part, -q if before @ q < 0.0 else q))


@dataclass(frozen=True)
class SetBodyAngle(Command):
    """Set one of the three angles (rad), 0-based."""

    index: int
    value: float
    label: ClassVar[str] = "angle of the body"

    def apply(self, state: State) -> State:
        """Return the state with the product of the three turns."""
        part = state[Body]
        angles = _with(state.derived(forms_of).triples.shown.tolist(), self.index, self.value, "angle")
        part = part.with_values({"angles": angles})
        return put(state, _by_angles(part, angles))


@dataclass(frozen=True)
class SetBodyAxis(Command):
    """Set one component of the axis, 0-based; it need not be of unit length."""

    index: int
    value: float
    label: ClassVar[str] = "axis of the body"

    def apply(self, state: State) -> State:
        """Return the state with the present angle about the new axis."""
        part, found = state[Body], state.derived(forms_of)
        axis = _with(_typed_axis(part, found.axis), self.index, self.value, "axis")
        part = part.with_values({"axis": axis})
        return put(state, _about(part, axis, found.angle))


@dataclass(frozen=True)
class SetWholeAxis(Command):
    """Set the axis, three components; it need not be of unit length."""

    values: tuple[float, ...]
    label: ClassVar[str] = "axis of the body"

    def apply(self, state: State) -> State:
        """Return the state with the present angle about the axis."""
        return put(state, _about(state[Body], self.values, state.derived(forms_of).angle))


@dataclass(frozen=True)
class SetBodyTurn(Command):
    """Set the angle (rad) about the axis."""

    value: float
    label: ClassVar[str] = "angle about the axis"

    def apply(self, state: State) -> State:
        """Return the state with this angle about the present axis."""
        part, found = state[Body], state.derived(forms_of)
        if not abs(self.value) <= 2.0 * math.pi:
            raise InputError(
                f"θ: expected −360° to 360°, got {math.degrees(self.value):.6g}°: two whole turns are all there is, "
                "q returns after them"
            )
        return put(state, _about(part, _typed_axis(part, found.axis), self.value))


@dataclass(frozen=True)
class SetBodyQuaternion(Command):
    """Set one component of the quaternion, 0-based, scalar first; its length does not matter."""

    index: int
    value: float
    label: ClassVar[str] = "quaternion of the body"

    def apply(self, state: State) -> State:
        """Return the state with this quaternion."""
        part = state[Body]
        return put(state, turned(part, _with(part.q, self.index, self.value, "q")))


@dataclass(frozen=True)
class SetWholeQuaternion(Command):
    """Set the quaternion, scalar first; its length does not matter."""

    values: tuple[float, ...]
    label: ClassVar[str] = "quaternion of the body"

    def apply(self, state: State) -> State:
        """Return the state with this quaternion."""
        return put(state, turned(state[Body], self.values))


@dataclass(frozen=True)
class FlipQuaternion(Command):
    """Take -q in place of q: the same rotation."""

    label: ClassVar[str] = "sign of the quaternion"

    def apply(self, state: State) -> State:
        """Return the state with -q."""
        part = state[Body]
        return put(state, turned(part, -np.array(part.q)))


@dataclass(frozen=True)
class UnitQuaternion(Command):
    """Divide the quaternion by its length."""

    label: ClassVar[str] = "length of the quaternion"

    def apply(self, state: State) -> State:
        """Return the state with a unit quaternion."""
        part = state[Body]
        return put(state, turned(part, unit(part.q)))


@dataclass(frozen=True)
class SetBodyMatrix(Command):
    """Set the nine numbers of a matrix, row by row; the body takes the nearest rotation."""

    values: tuple[float, ...]
    label: ClassVar[str] = "matrix of the body"

    def apply(self, state: State) -> State:
        """Return the state with the rotation that is nearest to the matrix."""
        if len(self.values) != 9:
            raise InputError(f"matrix: expected 9 numbers, row by row, got {len(self.values)}")
        part = state[Body].with_values({"matrix": np.reshape(np.array(self.values, dtype=float), (3, 3)).tolist()})
        nearest = nearest_rotation(np.array(part.matrix))
        if not nearest.only:
            raise InputError(
                "matrix: expected one with a single nearest rotation; several are at the same distance "
                f"{nearest.distance:.3g} of this one"
            )
        return put(state, turned(part, quaternion_from_rotation(nearest.rotation), matrix=part.matrix))


@dataclass(frozen=True)
class SetBodyEntry(Command):
    """Set one entry of the matrix, 0-based; the body takes the nearest rotation."""

    row: int
    column: int
    value: float
    label: ClassVar[str] = "matrix of the body"

    def apply(self, state: State) -> State:
        """Return the state with the rotation that is nearest to the matrix with this entry."""
        for index, name in ((self.row, "row"), (self.column, "column")):
            refuse_beyond(index, 3, name)
        found = state.derived(forms_of)
        shown = found.R if found.nearest is None else np.array(state[Body].matrix)
        values = _with(shown.ravel().tolist(), 3 * self.row + self.column, self.value, "entry")
        return SetBodyMatrix(tuple(values)).apply(state)


@dataclass(frozen=True)
class WriteBody(Command):
    """Write the same orientation in the angles of another sequence, or about fixed axes."""

    axes: str | None = None
    fixed: bool | None = None
    label: ClassVar[str] = "sequence of axes"

    def apply(self, state: State) -> State:
        """Return the state with that triple of the sequence which is nearer to zero."""
        part = state[Body]
        axes = part.axes if self.axes is None else self.axes
        fixed = part.fixed if self.fixed is None else self.fixed
        known_name("axes", axes, SEQUENCES)
        if (axes, fixed) == (part.axes, part.fixed):
            return state
        angles = triples_of(forms(part).R, axes, fixed, np.zeros(3)).shown
        return put(state, part.with_values({"axes": axes, "fixed": fixed, "angles": _floats(angles)}))


@dataclass(frozen=True)
class SetBodyTurns(Command):
    """Set the sequence of axes, whether they are fixed, and the three angles (rad)."""

    axes: str
    fixed: bool
    angles: tuple[float, ...]
    label: ClassVar[str] = "turns of the body"

    def apply(self, state: State) -> State:
        """Return the state with the product of the three turns."""
        part = state[Body].with_values({"axes": self.axes, "fixed": self.fixed, "angles": list(self.angles)})
        return put(state, _by_angles(part, part.angles))


@dataclass(frozen=True)
class TakeOtherAngles(Command):
    """Take the other triple of angles: the same orientation with other turns."""

    label: ClassVar[str] = "other angles"

    def apply(self, state: State) -> State:
        """Return the state with the other triple."""
        part, triples = state[Body], state.derived(forms_of).triples
        if triples.singular:
            raise InputError("angles: there are no two triples here but infinitely many; type the third angle")
        return put(state, part.with_values({"angles": _floats(triples.other)}))


@dataclass(frozen=True)
class PlaceBody(Command):
    """Turn the body to one of the `PLACES`, by key."""

    key: str
    label: ClassVar[str] = "orientation of the body"

    def apply(self, state: State) -> State:
        """Return the state with the body there."""
        known_name("orientation", self.key, PLACES)
        _, axes, fixed, degrees = PLACES[self.key]
        return SetBodyTurns(axes, fixed, tuple(math.radians(angle) for angle in degrees)).apply(state)


def _by_angles(part: Body, angles: Sequence[float]) -> Body:
    R = rotation_from_sequence(part.axes, angles, fixed=part.fixed)
    return turned(part, quaternion_from_rotation(R), angles=list(angles))


def _about(part: Body, axis: Sequence[float], angle: float) -> Body:
    part = part.with_values({"axis": list(axis)})
    part.check()
    half = 0.5 * angle * np.array(axis) / math.hypot(*axis)
    return turned(part, exponential([0.0, *half.tolist()]), axis=list(axis))


def _typed_axis(part: Body, axis: NDArray[np.float64]) -> list[float]:
    """Return the axis in the length in which it was typed, if that is still the axis."""
    typed = np.array(part.axis)
    same = np.abs(typed / np.linalg.norm(typed) - axis).max() < STILL
    return _floats(typed if same else axis)
