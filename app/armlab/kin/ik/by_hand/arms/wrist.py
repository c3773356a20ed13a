"""Six joints with a spherical wrist, or the wrist alone: the wrist centre is placed first, then the hand is turned.

References
----------
Pieper 1968; notes, section 4.3.2; Siciliano et al., *Robotics*, 2.12.3-2.12.5.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.euler import Turns, three_turns
from armlab.kin.ik.by_hand.placing import placer_of
from armlab.kin.ik.by_hand.step import Line, Point, Quantity, Segment, Vector, Worked
from armlab.kin.ik.by_hand.work import Work, triple
from armlab.kin.ik.closed._turning import RIGHT
from armlab.kin.ik.closed._wrist import wrist_centre
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.ik.screws import Screws, screws_of


def fits(arm: Arm) -> bool:
    """Return whether the hand turns about one point, and the other joints place it in a way worked by hand."""
    form = closed_form_of(arm)
    if form is None or form[0].key not in ("spherical_wrist", "wrist"):
        return False
    s = screws_of(arm)
    right = abs(float(s.z[-3] @ s.z[-2])) <= RIGHT and abs(float(s.z[-2] @ s.z[-1])) <= RIGHT
    return right and (arm.n == 3 or placer_of(s, wrist_centre(s)) is not None)


@lru_cache(maxsize=64)
def _centre(s: Screws) -> Vector:
    return wrist_centre(s)


def write(work: Work) -> None:
    """Write all steps."""
    s, n = work.s, work.arm.n
    home = _centre(s)
    centre = work.carried(home) if n == 6 else home
    if n == 6:
        go_back(work, home, centre, "p_w", "the wrist centre", "The wrist centre does not move when the wrist rotates")
        placer = placer_of(s, home)
        assert placer is not None
        placer(work, home, centre, "the wrist centre")
    before = np.eye(3)
    for i in range(n - 3):
        before = before @ s.turn(i, work.q[i])
    three_turns(
        work,
        Turns(
            (s.z[-3], s.z[-2], s.z[-1]),
            before,
            before.T @ work.H[:3, :3],
            centre,
            (n - 3, n - 2, n - 1),
            r"{}^3R_6" if n == 6 else "R",
            r"{}^0R_3^{\mathsf T}\;{}^0R_6" if n == 6 else "R",
            (f"axis {n - 2}", f"axis {n}"),
        ),
    )


def go_back(work: Work, home: Vector, place: Vector, symbol: str, name: str, why: str) -> None:
    """Write the step from the tool to a point that is fixed in it, given where it is at q = 0 and at the target."""
    s: Screws = work.s
    hand = np.asarray(s.home[:3, :3].T @ (s.home[:3, 3] - home))
    tool = work.T[:3, 3]
    values = {
        "p": Quantity(r"\mathbf{p}", triple(tool)),
        "hand": Quantity(r"{}^e\mathbf{t}", triple(hand)),
        "back": Quantity(r"R\,{}^e\mathbf{t}", triple(tool - place)),
        "c": Quantity(rf"\mathbf{{{symbol[0]}}}{symbol[1:]}", triple(place)),
    }
    work.add(
        symbol,
        symbol,
        f"{why}: go back from the tool along the hand",
        "go back along the last link",
        values,
        (Line("c", "<p> - <back>"),),
        shapes=(
            Segment(place, tool, "", "given"),
            Point(place, name, "found"),
            Point(tool, "", "wanted"),
        ),
    )


WORKED = Worked("wrist", "Wrist centre first, then the orientation", 40, fits, write)
