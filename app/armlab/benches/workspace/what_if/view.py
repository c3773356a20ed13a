"""The drawn points of two workspaces in three groups: kept, gained and lost."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.cuts import behind, opens
from armlab.benches.workspace.what_if.state import WhatIf
from armlab.kin.workspace.first_joint import first_joint
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Points = NDArray[np.float32]


class Parts(NamedTuple):
    """Points (k, 3) in the world, metres.

    Attributes
    ----------
    kept : ndarray
        Of the arm as it is; once both workspaces are known, of what is in both.
    thought : ndarray
        Of the arm as it is thought to be, as long as it is not known which of them are new.
    gained, lost : ndarray
        What could not be reached before, and what cannot be reached any more.
    """

    kept: Points
    thought: Points
    gained: Points
    lost: Points


def parts_of(state: State) -> Parts:
    """Return the drawn points, without the half in front, which would hide the arm, where enough are left then."""
    found, nothing = state[WhatIf].found, np.zeros((0, 3), np.float32)
    if found is None:
        return Parts(nothing, nothing, nothing, nothing)
    old, new = found.old.points, found.new.points
    if found.same:
        parts = Parts(old, nothing, nothing, nothing)
    elif found.lost is None or found.gained is None or not found.told_apart:
        parts = Parts(old, new, nothing, nothing)
    else:
        parts = Parts(old[~found.lost], nothing, new[found.gained], old[found.lost])
    arm = found.before
    if first_joint(arm).planar or not opens(arm, old):
        return parts
    return Parts(*(each[behind(arm, each)] for each in parts))


def thought_pose(state: State) -> NDArray[np.float64] | None:
    """Return the joint values (n,) at which the supposed arm is drawn, or None without changes.

    They are the present ones, moved inside the limits it would have.
    """
    part = state[WhatIf]
    if part.other is part.arm:
        return None
    return np.asarray(part.other.clip(state[Joints].q), dtype=np.float64)
