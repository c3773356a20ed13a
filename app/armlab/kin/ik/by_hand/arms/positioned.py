"""Three joints that place the tool point: an elbow arm, a polar arm.

References
----------
Notes 4.66-4.105, corrected.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.placing import placer_of
from armlab.kin.ik.by_hand.step import Worked
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.ik.screws import screws_of

FORMS = ("elbow", "polar", "positioning")
"""Closed forms of three joints that place a point."""


def fits(arm: Arm) -> bool:
    """Return whether three joints place the tool point in one of the ways that are worked by hand."""
    form = closed_form_of(arm)
    if form is None or form[0].key not in FORMS:
        return False
    s = screws_of(arm)
    return placer_of(s, s.home[:3, 3]) is not None


def write(work: Work) -> None:
    """Write all steps."""
    home = work.s.home[:3, 3]
    placer = placer_of(work.s, home)
    assert placer is not None
    placer(work, home, work.T[:3, 3], "the tool point")


WORKED = Worked("positioned", "Joint 1 turns a plane, and a triangle lies in it", 30, fits, write)
