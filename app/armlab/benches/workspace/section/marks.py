"""Tool and target on the page of the section: their places in it, and their distances from the boundary."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.section.found import Found
from armlab.benches.workspace.section.state import found_of
from armlab.kin.workspace.boundary import To
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import State

Floats = NDArray[np.float64]

APART = 1e-6
"""Distance, metres, below which the target counts as being at the tool."""


class Measured(NamedTuple):
    """A point and the way from it to the boundary."""

    point: Floats
    to: To


def tool_measured(state: State) -> Measured | None:
    """Return the tool point with its way to the boundary, or None until that is known.

    The arm has its tool in the workspace: a boundary that leaves it outside by no more than its own error, as it cuts
    off corners and is thinner than a cell where it is all there is, goes through it.
    """
    seen, found = found_of(state), _measured(state, np.asarray(state[Joints].tool_pose[:3, 3], dtype=np.float64))
    if seen is None or found is None or found.to.distance >= 0.0 or -found.to.distance > seen.section.blur:
        return found
    return Measured(found.point, To(0.0, found.point))


def target_measured(state: State) -> Measured | None:
    """Return the target with its way to the boundary, or None until that is known, or if it is at the tool."""
    pose = state[Target].pose
    if pose is None or float(np.linalg.norm(pose[:3, 3] - state[Joints].tool_pose[:3, 3])) < APART:
        return None
    return _measured(state, np.asarray(pose[:3, 3], dtype=np.float64))


def _measured(state: State, point: Floats) -> Measured | None:
    found = found_of(state)
    if found is None or not found.finished:
        return None
    to = found.section.distance(point)
    return Measured(point, to) if np.isfinite(to.distance) else None


def silhouette(found: Found, q: NDArray[np.float64]) -> Floats:
    """Return the arm in a configuration seen from the side, a polyline of shape (k, 2) in metres.

    The coordinates are outward towards the tool and along the axis of joint 1, or across it if joint 1 slides; those of
    a planar arm lie in its plane. The line follows the links of the table: along the axis of a joint, then along the
    common normal.
    """
    arm, joint = found.arm, found.section.joint
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    tool = np.asarray(arm.position(q), dtype=np.float64)
    points = [frames[0, :3, 3]]
    for before, after in pairwise(frames):
        z = before[:3, 2] if arm.convention == "standard" else after[:3, 2]
        along = z * float((after[:3, 3] - before[:3, 3]) @ z)
        points += [before[:3, 3] + along if arm.convention == "standard" else after[:3, 3] - along, after[:3, 3]]
    local = (np.array([*points, tool]) - joint.origin) @ joint.axes
    if found.section.grid.flat:
        return np.asarray(local[:, :2] if joint.revolute else local[:, [0, 2]])
    if not joint.revolute:
        return np.asarray(local[:, :2])
    s = joint.split(tool)[2]
    return np.stack([local[:, 0] * np.cos(s) + local[:, 1] * np.sin(s), local[:, 2]], axis=1)
