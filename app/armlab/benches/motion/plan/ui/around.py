"""Points and layers around the arm on the pages of a plan: those inside the picture, and those that are hidden."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.plugin import Points

HANDLE = ("gizmo", "gap")
"""Layers of the handle of the arm."""


def way_around(state: State) -> Points:
    """Return the waypoints and the path between them, (k, 3), world."""
    part, arm, planned = state[Plan], state[Joints].arm, last_planned(state)
    ways = [] if planned is None else [leg.points for leg in planned.legs]
    return np.vstack([*(point.wanted(arm)[:3, 3] for point in part.waypoints), *ways])


def in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers that the motion hides while waypoints have handles or the motion plays: the arm's handle."""
    return HANDLE if state[Plan].handled else while_on(state)


def while_on(state: State) -> tuple[str, ...]:
    """Return the layers that the motion hides while it plays: the arm's handle."""
    return HANDLE if state[Timeline].clip == CLIP_KEY else ()
