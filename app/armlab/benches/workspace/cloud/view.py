"""The samples of a workspace that are drawn, and the one that is clicked."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import Workspace
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.surface import Surface, near_boundary, surface
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

FRONT = math.radians(-50.0)
"""Azimuth of the first view of an arm, radians: the half that is cut away lies in front of it."""

SLICE = 0.02
"""Half thickness of a slice, in reaches of the arm."""

EDGE = 0.04
"""Largest distance of a point near the boundary, in reaches of the arm."""

AXES = ("x", "y", "z")

NEAR_RAY = 0.012
"""Largest distance of a clicked sample from the line of sight, in reaches of the arm."""


def drawing(state: State) -> str:
    """Return the kind of drawing, a key of `DRAWINGS`: a planar workspace has no surface."""
    draw = state[Workspace].draw
    return "cloud" if draw == "surface" and first_joint(state[Joints].arm).planar else draw


def kept(state: State) -> Mask:
    """Return which of the drawn samples remain after the cut, shape (k,)."""
    found = state[Workspace].found
    if found is None:
        return np.zeros(0, dtype=bool)
    return left_of(state, found.shown.points)


def left_of(state: State, points: ArrayLike) -> Mask:
    """Return which points (k, 3) of the world remain after the cut, and after the choice of points near the boundary.

    While the boundary is being found, all are near it.
    """
    part = state[Workspace]
    if part.found is None:
        return np.zeros(len(np.asarray(points)), dtype=bool)
    left = cut_of(part, part.found, points)
    if part.edge and part.section is not None:
        left &= near_boundary(part.section, points, EDGE * part.found.question.arm.reach)
    return left


def boundary(state: State) -> Surface | None:
    """Return the surface of the workspace that remains after the cut, or None while it is not known."""
    part = state[Workspace]
    if part.found is None or part.section is None:
        return None
    whole = surface(part.section)
    if not len(whole.faces):
        return whole
    left = cut_of(part, part.found, whole.vertices[whole.faces].mean(axis=1)) if part.cut == "front" else ...
    return Surface(whole.vertices, whole.faces[left])


def cut_of(part: Workspace, found: Sampled, points: ArrayLike) -> Mask:
    """Return which points (k, 3) in the world remain after the cut, shape (k,)."""
    arm = found.question.arm
    local = (np.asarray(points, dtype=np.float64) - arm.base[:3, 3]) @ arm.base[:3, :3]
    if part.cut == "front" and not found.planar:
        return np.asarray(local[:, 0] * math.cos(FRONT) + local[:, 1] * math.sin(FRONT) <= 0.0)
    if part.cut in AXES:
        return np.asarray(np.abs(local[:, AXES.index(part.cut)] - part.offset) <= SLICE * arm.reach)
    return np.ones(len(local), dtype=bool)


def pointed_at(state: State, origin: ArrayLike, direction: ArrayLike) -> int | None:
    """Return the clicked sample: the first of those near the line of sight.

    Parameters
    ----------
    state : State
    origin, direction : array_like, shape (3,)
        Of the line of sight, in the world.

    Returns
    -------
    int or None
        Its index among the drawn ones; None where the line meets none that is drawn.
    """
    found = state[Workspace].found
    if found is None:
        return None
    ray = np.asarray(direction, dtype=np.float64)
    length = float(np.linalg.norm(ray))
    if not math.isfinite(length) or length == 0.0:
        return None
    ray = ray / length
    way = found.shown.points - np.asarray(origin, dtype=np.float64)
    along = way @ ray
    aside = np.linalg.norm(way - along[:, None] * ray, axis=1)
    meant = np.flatnonzero(state.derived(kept) & (aside <= NEAR_RAY * found.question.arm.reach) & (along > 0.0))
    return int(meant[np.argmin(along[meant])]) if len(meant) else None
