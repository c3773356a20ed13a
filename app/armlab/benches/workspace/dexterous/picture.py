"""Content of the scene for a study: a slice of values on a plane, or a body of voxels; and the value at the tool."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.cuts import BEHIND, FRONT
from armlab.benches.workspace.dexterous.state import SHARES, Dexterous, slice_of, study_of
from armlab.benches.workspace.dexterous.study import Study
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.transforms import transform
from armlab.kin.workspace.approach import MOST, directions
from armlab.kin.workspace.sheet import Sheet
from armlab.kin.workspace.sheet_maps import SheetMap, sheet_of
from armlab.kin.workspace.solution_count import count_of
from armlab.kin.workspace.spherical_wrist import ALL, Coverage, coverage_at, tried_at
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]

LEAST = 1.0 - ALL
"""Share of the directions below which nothing is drawn, which removes the blur of the voxels."""


@dataclass(frozen=True, eq=False)
class Slice:
    """Values in square cells on a plane in the world.

    Attributes
    ----------
    values : ndarray, shape (U, V)
        nan where there is nothing.
    corner, right, up : ndarray, shape (3,)
        The corner of cell (0, 0) in the world, metres, and unit vectors along U and V.
    step : float
        Edge of a cell, metres.
    """

    values: Floats
    corner: Floats
    right: Floats
    up: Floats
    step: float

    def met(self, origin: Floats, direction: Floats) -> Floats | None:
        """Return the point where a line of sight meets a cell with a value, (3,) in the world, or None."""
        normal = np.cross(self.right, self.up)
        slope = float(normal @ direction)
        if slope == 0.0:
            return None
        along = float(normal @ (self.corner - origin)) / slope
        point = origin + along * direction
        local = np.array([(point - self.corner) @ self.right, (point - self.corner) @ self.up]) / self.step
        if along <= 0.0 or not np.isfinite(local).all() or np.any(local < 0.0) or np.any(local >= self.values.shape):
            return None
        return point if np.isfinite(self.values[int(local[0]), int(local[1])]) else None


def slice_shown(state: State) -> Slice | None:
    """Return the slice of the present study, or None while there is no result."""
    found = state.derived(study_of)
    return None if found is None else _slice(found, slice_of(state))


@lru_cache(maxsize=8)
def _slice(found: Study, s: float) -> Slice:
    """Return the slice of a study; every event of a drag calls this."""
    sheet = sheet_of(found.question.arm, s)
    if found.wrist is not None:
        return _through(sheet, found.wrist)
    assert found.map is not None
    return _on(sheet, found.map.low, found.map.step, found.map.values)


def _through(sheet: Sheet, coverage: Coverage) -> Slice:
    """Return the slice through the voxels of a coverage."""
    step, half = coverage.step, coverage.points.radius + coverage.tool
    middle = sheet.places(coverage.points.centre)
    low = sheet.lowest(middle - half)
    shape = np.ceil((middle + half - low) / step).astype(int)
    places = low + (np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1) + 0.5) * step
    values = coverage.at(sheet.points(places))
    return _on(sheet, low, step, np.where(values > LEAST, values, np.nan))


def _on(sheet: Sheet, low: Floats, step: float, values: Floats) -> Slice:
    corner, right, up = sheet.points(low + np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    return Slice(values, corner, right - corner, up - corner, step)


def body_shown(state: State) -> NDArray[np.bool_] | None:
    """Return the voxels of a spherical wrist's coverage with at least the chosen share of directions, (N, N, N).

    The half in front of the arm is cut away, so that arm and inside are seen, unless too little of it lies behind.
    """
    part, found = state[Dexterous], state.derived(study_of)
    if found is None or found.wrist is None or part.draw != "body":
        return None
    wrist, base = found.wrist, state[Joints].arm.base
    ahead = base[:3, :3] @ [math.cos(FRONT), math.sin(FRONT), 0.0]
    along = wrist.low + (np.arange(wrist.fraction.shape[0])[:, None] + 0.5) * wrist.step - base[:3, 3]
    x, y, z = (along * ahead).T
    behind = x[:, None, None] + y[None, :, None] + z[None, None, :] <= 0.0
    body = np.asarray(wrist.fraction > _threshold(part.share))
    half = body & behind
    return half if half.sum() >= BEHIND * body.sum() else body


def largest_share(found: Coverage) -> float | None:
    """Return the largest of `SHARES` that some voxel has, or None if none has even the least."""
    most = float(found.fraction.max())
    return max((share for share in SHARES if most > _threshold(share)), default=None)


def _threshold(share: float) -> float:
    return ALL if share >= 1.0 else share


@dataclass(frozen=True)
class AtTool:
    """Result at the tool point.

    Attributes
    ----------
    value : float
        Fraction of the orientations, nan where nothing was found; or number of solutions inside the limits, inf of a
        family, with the tool at its place but turned as on the slice.
    of : int
        Directions that were tried; 0 of a number of solutions.
    beside : bool
        Whether the tool is beside the slice, of which nothing is known there.
    """

    value: float
    of: int = 0
    beside: bool = False


def at_tool(state: State) -> AtTool | None:
    """Return the result at the tool point, or None while there is none."""
    found, point = state.derived(study_of), np.array(state[Joints].tool_pose[:3, 3], dtype=np.float64)
    if found is None:
        return None
    if found.wrist is not None:
        return AtTool(coverage_at(found.wrist, point, _TRIED), tried_at(found.wrist, _TRIED))
    assert found.map is not None
    if found.question.method == "count":
        # In the middle of its cell there may be others: at the rim of the workspace, and where the arm is stretched.
        T = transform(np.reshape(found.question.turned, (3, 3)), point)
        return AtTool(count_of(solve_all(found.question.arm, T)).inside)
    if _beside(found.map, point, slice_of(state)):
        return AtTool(math.nan, beside=True)
    cell = found.map.cell(point)
    value = math.nan if cell is None else float(found.map.values[cell])
    return AtTool(value, directions(MOST, found.map.sheet.bins.circle).count)


def _beside(found: SheetMap, point: Floats, s: float) -> bool:
    """Return whether a point is off the surface of a map, which cannot be if joint 1 turns fully."""
    joint = found.sheet.joint
    if joint.planar or joint.full:
        return False
    on = replace(found.sheet, s=s).points(found.sheet.places(point))
    return bool(np.linalg.norm(on - point) > 0.5 * found.step)


_TRIED = 2048
"""Number of directions that are tried at the tool of a spherical wrist."""
