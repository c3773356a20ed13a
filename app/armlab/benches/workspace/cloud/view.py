"""The samples of a workspace that are drawn, and the one that is clicked."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.workspace.cloud.cuts import AXES, cut_of, left_by_cut
from armlab.benches.workspace.cloud.state import Workspace
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.surface import Surface, near_boundary, surface
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

EDGE = 0.04
"""Largest distance of a point near the boundary, in reaches of the arm."""

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
    left = left_by_cut(part, part.found, points)
    if part.edge and part.section is not None:
        left &= near_boundary(part.section, points, EDGE * part.found.question.arm.reach)
    return left


def boundary(state: State) -> Surface | None:
    """Return the surface of the workspace that remains after the cut, or None while it is not known."""
    part = state[Workspace]
    if part.found is None or part.section is None:
        return None
    whole = surface(part.section)
    if not len(whole.faces) or cut_of(part) != "front":
        return whole
    return Surface(whole.vertices, whole.faces[left_by_cut(part, part.found, whole.vertices[whole.faces].mean(axis=1))])


def in_the_picture(state: State) -> Floats:
    """Return points (k, 3) of the world around all that is drawn, wherever a slice is moved; none where nothing is."""
    found, draw = state[Workspace].found, drawing(state)
    if found is None:
        return np.zeros((0, 3))
    if cut_of(state[Workspace]) in AXES:
        return found.shown.points.astype(np.float64)
    if draw == "surface" and (drawn := state.derived(boundary)) is not None:
        return np.asarray(drawn.vertices[np.unique(drawn.faces)], dtype=np.float64)
    if draw == "voxels":
        filled = found.voxels.count > 0
        centres = found.voxels.centres(filled)
        centres = centres[left_of(state, centres)]
        half = 0.5 * found.voxels.step
        return np.concatenate([centres - half, centres + half]).astype(np.float64)
    return found.shown.points[state.derived(kept)].astype(np.float64)


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
