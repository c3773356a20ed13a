"""A slice of the workspace as a picture: the reached points of a plane, and their values."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.cuts import AXES, across
from armlab.benches.workspace.section.found import Found, once_each
from armlab.benches.workspace.section.state import SectionView, found_of
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.section import Section
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

PIXELS = 200
"""Number of pixels along the longer side of a picture."""

FINER = 2
"""Number of pixels along a side of a cell."""

ROUND = 64
"""Number of values of s by which the extent of a workspace is found."""


class Plane(NamedTuple):
    """A rectangle in the world.

    Attributes
    ----------
    corner : ndarray, shape (3,)
        Metres.
    right, up : ndarray, shape (3,)
        Unit vectors.
    width, height : float
        Metres.
    """

    corner: Floats
    right: Floats
    up: Floats
    width: float
    height: float

    @property
    def middle(self) -> Floats:
        """Centre of the rectangle."""
        return np.asarray(self.corner + 0.5 * (self.width * self.right + self.height * self.up))

    @property
    def corners(self) -> Floats:
        """The four corners, (4, 3)."""
        sides = [(i * self.width, j * self.height) for i in (0, 1) for j in (0, 1)]
        return np.array([self.corner + wide * self.right + high * self.up for wide, high in sides])


class Slice(NamedTuple):
    """A picture with its rows from below and its columns from the left.

    Attributes
    ----------
    plane : Plane
    reached : ndarray, shape (rows, columns)
    values : ndarray, shape (rows, columns), or None
    """

    plane: Plane
    reached: Bools
    values: Floats | None


def slice_of(state: State) -> Slice | None:
    """Return the slice to draw in the scene, or None."""
    found, plane = found_of(state), plane_drawn(state)
    if found is None or plane is None:
        return None
    if found.section.grid.flat:
        return in_own_plane(found)
    return _of_section(found, slice_at(state, found)) if state[SectionView].slice == "axis" else picture(found, plane)


def plane_drawn(state: State) -> Plane | None:
    """Return the plane of the slice to draw in the scene, or None."""
    found, part = found_of(state), state[SectionView]
    if found is None or part.slice == "none" or not found.section.filled.any():
        return None
    if found.section.grid.flat:
        return own_plane(found.section)
    return plane_at(found, slice_at(state, found)) if part.slice == "axis" else plane_of(state, found)


@once_each
def in_own_plane(found: Found) -> Slice | None:
    """Return the region that a planar arm reaches in its plane, or None for other arms and before it is known."""
    if not found.section.grid.flat or not found.section.filled.any():
        return None
    return picture(found, own_plane(found.section))


def plane_of(state: State, found: Found) -> Plane:
    """Return the chosen plane across an axis, as large as the workspace."""
    part = state[SectionView]
    return _across_axis(found, AXES.index(part.slice), part.offset)


def slice_at(state: State, found: Found) -> float:
    """Return the place of the slice through (or across) the axis of joint 1, rad or m."""
    turn = state[SectionView].turn
    return float(found.section.joint.split(state[Joints].tool_pose[:3, 3])[2]) if turn is None else turn


def slice_range(found: Found, kind: str) -> tuple[float, float]:
    """Return between which places a slice of a kind meets the workspace, rad or m."""
    points, joint, base = hull(found.section), found.section.joint, found.arm.base
    if kind == "axis" and joint.revolute:
        return -math.pi, math.pi
    along = joint.split(points)[:, 2] if kind == "axis" else (points - base[:3, 3]) @ base[:3, AXES.index(kind)]
    return float(along.min()), float(along.max())


def picture(found: Found, plane: Plane) -> Slice:
    """Return the reached part of a plane."""
    step = max(plane.width, plane.height) / PIXELS
    columns, rows = (max(round(side / step), 1) for side in (plane.width, plane.height))
    x = (np.arange(columns) + 0.5) * (plane.width / columns)
    y = (np.arange(rows) + 0.5) * (plane.height / rows)
    points = plane.corner + y[:, None, None] * plane.up + x[None, :, None] * plane.right
    section = found.section
    coordinates = section.joint.split(points)
    cells, on = section.grid.cell_of(coordinates[..., :2])
    reached = on & _smoothly(section, coordinates[..., :2])
    if section.arcs is not None and section.around is not None:
        reached &= section.arcs.holds(section.around.coarse(cells), coordinates[..., 2])
    values = None if found.values is None else np.where(reached, found.values.reshape(-1)[cells], np.nan)
    return Slice(plane, reached, values)


def own_plane(section: Section) -> Plane:
    """Return the plane of a planar arm, as large as its reached region."""
    joint = section.joint
    right, up = (joint.axes[:, 0], joint.axes[:, 1]) if joint.revolute else (joint.axes[:, 0], joint.axes[:, 2])
    local = (hull(section) - joint.origin) @ np.column_stack([right, up])
    base = joint.origin + (joint.axes[:, 2] if joint.revolute else joint.axes[:, 1]) * section.v[0]
    return _rectangle(base, right, up, local)


def _smoothly(section: Section, uv: Floats) -> Bools:
    """Return whether places (..., 2) of the section are reached, by interpolation between the centres of four cells."""
    rows, columns = section.filled.shape
    filled = _shown(section).astype(np.float64)
    x = (uv[..., 0] - section.grid.low[0]) / section.step - 0.5
    # Beside the axis of joint 1 nothing ends.
    x = np.maximum(x, 0.0) if section.grid.at_axis else x
    i = np.clip(np.floor(x).astype(np.intp), 0, rows - 2)
    dx = np.clip(x - i, 0.0, 1.0)
    if section.grid.flat:
        part = filled[i, 0] * (1.0 - dx) + filled[i + 1, 0] * dx
        return np.asarray((part > 0.5) & (np.abs(uv[..., 1] - section.v[0]) < section.step))
    y = (uv[..., 1] - section.grid.low[1]) / section.step - 0.5
    j = np.clip(np.floor(y).astype(np.intp), 0, columns - 2)
    dy = np.clip(y - j, 0.0, 1.0)
    first = filled[i, j] * (1.0 - dx) + filled[i + 1, j] * dx
    second = filled[i, j + 1] * (1.0 - dx) + filled[i + 1, j + 1] * dx
    return np.asarray(first * (1.0 - dy) + second * dy > 0.5)


def _of_section(found: Found, s: float) -> Slice:
    """Return the section itself, moved to s by joint 1."""
    section = found.section
    fine = _finely(found)
    reached = fine.reached
    covered = _covered(section, s)
    if covered is not None and section.around is not None:
        wide = covered[section.around.coarse(np.arange(section.filled.size))].reshape(section.filled.shape)
        reached = reached & np.repeat(np.repeat(wide.T, FINER, 0), FINER, 1)
    return Slice(plane_at(found, s), reached, fine.values)


def looks(found: Found, s: float) -> bytes:
    """Return a key that is the same for all s at which the section looks the same."""
    covered = _covered(found.section, s)
    return b"" if covered is None else covered.tobytes()


def _covered(section: Section, s: float) -> Bools | None:
    """Return the coarse cells for which joint 1 reaches s, shape (C,), or None if it reaches every s."""
    if section.arcs is None:
        return None
    cells = np.arange(len(section.arcs.covered))
    return section.arcs.holds(cells, np.full(len(cells), s))


def plane_at(found: Found, s: float) -> Plane:
    """Return the plane to which joint 1 moves the section: through its axis, or across it."""
    section, joint = found.section, found.section.joint
    if joint.revolute:
        right = joint.axes[:, 0] * math.cos(s) + joint.axes[:, 1] * math.sin(s)
        up, origin = joint.axes[:, 2], joint.origin
    else:
        right, up, origin = joint.axes[:, 0], joint.axes[:, 1], joint.origin + s * joint.axes[:, 2]
    low, size = section.grid.low, section.step * np.array(section.grid.shape)
    return Plane(origin + low[0] * right + low[1] * up, right, up, float(size[0]), float(size[1]))


@once_each
def _finely(found: Found) -> Slice:
    """Return the section with an edge smoother than its cells, for any value of joint 1."""
    section = found.section
    inside = _shown(section)
    reached = np.repeat(np.repeat(inside.T, FINER, 0), FINER, 1) if section.grid.flat else _twice_as_fine(inside.T)
    values = None
    if found.values is not None:
        values = np.repeat(np.repeat(found.values.T, FINER, 0), FINER, 1)
    nowhere = Plane(np.zeros(3), np.zeros(3), np.zeros(3), 0.0, 0.0)
    return Slice(nowhere, reached, values)


def _twice_as_fine(inside: Bools) -> Bools:
    """Return the result of `_smoothly` at four places of each cell of some (rows, columns): (2 rows, 2 columns).

    They are a quarter of a cell from the centre, so the centres round them count 9, 3, 3 and 1 of 16.
    """
    wide = np.pad(inside.astype(np.uint8), 1, mode="edge")
    found = np.empty((2 * len(inside), 2 * inside.shape[1]), dtype=bool)
    for i, above in enumerate((wide[:-2], wide[2:])):
        rows = 3 * wide[1:-1] + above
        for j, beside in enumerate((rows[:, :-2], rows[:, 2:])):
            found[i::2, j::2] = 3 * rows[:, 1:-1] + beside > 8
    return found


def _shown(section: Section) -> Bools:
    """Return the cells to draw as reached. A line or a surface passes through no centre of a cell."""
    inside = section.outline.inside
    return inside if inside.any() else section.filled


def section_picture(found: Found) -> Slice:
    """Return the reached region of the section; its plane has no meaning."""
    return _finely(found)


def _across_axis(found: Found, axis: int, offset: float) -> Plane:
    base = found.arm.base
    right, up = across(base, axis)
    origin = base[:3, 3] + offset * base[:3, axis]
    return _rectangle(origin, right, up, (hull(found.section) - origin) @ np.column_stack([right, up]))


def _rectangle(origin: Floats, right: Floats, up: Floats, local: Floats) -> Plane:
    low, high = local.min(axis=0), local.max(axis=0)
    return Plane(origin + low[0] * right + low[1] * up, right, up, float(high[0] - low[0]), float(high[1] - low[1]))


def hull(section: Section) -> Floats:
    """Return points of the world (k, 3) around the whole reached region."""
    i, j = np.nonzero(section.filled)
    u, v = section.u[i], section.v[j]
    half = 0.5 * section.step
    ends = np.array([[a, b] for a in (u.min() - half, u.max() + half) for b in (v.min(), v.max())])
    s = _span(section.joint, section)
    uv = np.repeat(ends, len(s), axis=0)
    return section.joint.join(np.column_stack([uv, np.tile(s, len(ends))]))


def _span(joint: FirstJoint, section: Section) -> Floats:
    if joint.revolute:
        return np.linspace(-math.pi, math.pi, ROUND + 1)
    if section.around is None:
        return np.array([joint.low, joint.high])
    low, high = section.around.ends
    return np.array([low + joint.low, high + joint.high])
