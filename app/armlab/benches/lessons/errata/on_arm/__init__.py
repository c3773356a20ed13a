"""Errata on the arm on the table: for some, the wrong result is drawn beside the right one."""

from __future__ import annotations

from armlab.benches.lessons.errata.on_arm import axes, orientations, solutions, velocities
from armlab.benches.lessons.errata.on_arm.drawn import Drawn, Floats, OnArm, Unfit
from armlab.kin.arm import Arm

__all__ = ["ON_ARM", "Drawn", "Unfit", "on_arm"]

ON_ARM: dict[str, OnArm] = {**orientations.ON_ARM, **axes.ON_ARM, **solutions.ON_ARM, **velocities.ON_ARM}
"""Drawings, by the id of the erratum."""


def on_arm(key: str, arm: Arm, q: Floats) -> Drawn | Unfit | None:
    """Return what is drawn of an erratum at a configuration of an arm; None of one that is no matter of an arm."""
    draw = ON_ARM.get(key)
    return None if draw is None else draw(arm, q)
