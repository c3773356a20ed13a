"""Three joints place the tool point, whatever their axes are (Pieper).

References
----------
Pieper 1968; the equations are in `armlab.kin.ik.closed._placing`.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._place import places, solve_place
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why three joints position the tool point; None when they do not."""
    return known_structure(arm).why if places(arm) and known_structure(arm).key == "positioning" else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_place(arm, T)


CLOSED = ClosedForm("positioning", "Positioning arm", 90, fits, solve)
