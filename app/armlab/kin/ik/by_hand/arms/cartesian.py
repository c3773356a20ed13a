"""Slides alone: every joint value is a length along its slide.

References
----------
Notes, section 1.7.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.placing import along_slides
from armlab.kin.ik.by_hand.step import Worked
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed_form import closed_form_of


def fits(arm: Arm) -> bool:
    """Return whether the arm has slides alone, as many as coordinates to control."""
    form = closed_form_of(arm)
    return form is not None and form[0].key == "cartesian"


def write(work: Work) -> None:
    """Write all steps."""
    s, coordinates = work.s, work.arm.task.coordinates
    along_slides(work, s.z.T[coordinates], s.home[:3, 3], work.T[:3, 3], "the tool", coordinates)


WORKED = Worked("cartesian", "Prismatic joints only: each length is read off", 10, fits, write)
