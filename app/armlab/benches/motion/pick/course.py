"""Where the boxes are at every time of a planned motion: computed once, as spans in which a box rests or is carried."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.pick.table import Point
from armlab.benches.motion.plan.question import Grip, Planned
from armlab.kin.arm import Arm
from armlab.kin.transforms import inverse, transform

Floats = NDArray[np.float64]

GRASP = 0.5
"""Distance of the tool point from the middle of a box, in edges, up to which the gripper takes the box."""

CLOSING = 0.25
"""Time in which the fingers are drawn to close or open, seconds."""


class Span(NamedTuple):
    """From a time on, seconds, a box has a pose (4, 4): in the world, or while it is carried in the tool's frame."""

    start: float
    carried: bool
    pose: Floats


class Try(NamedTuple):
    """The outcome of a gripper that closes.

    Attributes
    ----------
    grip : Grip
    nearest : int or None
        The box whose middle is nearest, from 0; None when there are none.
    distance : float
        Of its middle from the tool point, metres.
    taken : bool
    shut : bool
        Whether the gripper was closed already, so that it could take nothing.
    """

    grip: Grip
    nearest: int | None
    distance: float
    taken: bool
    shut: bool = False


@dataclass(frozen=True, eq=False)
class Course:
    """The boxes of a motion.

    Attributes
    ----------
    spans : tuple of tuple of Span
        Of each box, in the order of time, the first from 0.
    tries : tuple of Try
    grips : tuple of Grip
        When the gripper opens or closes.
    """

    spans: tuple[tuple[Span, ...], ...]
    tries: tuple[Try, ...] = ()
    grips: tuple[Grip, ...] = ()

    def span(self, box: int, time: float) -> Span:
        """Return the span of a box at a time."""
        begun = [span for span in self.spans[box] if span.start <= time + 1e-9]
        return begun[-1] if begun else self.spans[box][0]

    def pose(self, box: int, time: float, tool: Floats) -> Floats:
        """Return the pose of a box in the world, (4, 4), with the tool where it is at that time, (4, 4)."""
        span = self.span(box, time)
        return tool @ span.pose if span.carried else span.pose

    def held(self, time: float) -> int | None:
        """Return the box in the gripper at a time, from 0, or None."""
        return next((k for k in range(len(self.spans)) if self.span(k, time).carried), None)

    def closed(self, time: float) -> float:
        """Return how far the gripper is closed at a time: 0 for open, 1 for closed."""
        share, end = 0.0, 0.0
        for grip in self.grips:
            if grip.time > time + 1e-9:
                break
            share, end = end, float(grip.closes)
            since = min(max((time - grip.time) / CLOSING, 0.0), 1.0)
            share = share + (end - share) * since
        return share


def course(arm: Arm, planned: Planned | None, boxes: Sequence[Point], edge: float) -> Course:
    """Return the course of boxes while a motion runs.

    Parameters
    ----------
    arm : Arm
    planned : Planned or None
        Without a motion the boxes rest.
    boxes : sequence of (float, float, float)
        Their middles before, world, metres.
    edge : float
        Of a box, metres.
    """
    rest = [np.asarray(transform(np.eye(3), np.array(box)), dtype=np.float64) for box in boxes]
    spans = [[Span(0.0, False, pose)] for pose in rest]
    if planned is None or planned.motion is None:
        return Course(tuple(map(tuple, spans)))
    tries: list[Try] = []
    held: int | None = None
    shut = False
    for grip in planned.grips:
        tool = np.asarray(arm.fk(arm.clip(planned.motion.at(grip.time))), dtype=np.float64)
        if grip.closes and held is None:
            tries.append(_try(grip, tool, spans, edge, shut))
            if tries[-1].taken:
                held = tries[-1].nearest
                assert held is not None
                spans[held].append(Span(grip.time, True, np.asarray(inverse(tool) @ spans[held][-1].pose)))
        elif not grip.closes and held is not None:
            spans[held].append(Span(grip.time, False, tool @ spans[held][-1].pose))
            held = None
        shut = grip.closes
    return Course(tuple(map(tuple, spans)), tuple(tries), planned.grips)


def _try(grip: Grip, tool: Floats, spans: Sequence[Sequence[Span]], edge: float, shut: bool) -> Try:
    """Return what comes of closing the gripper, which may be ``shut`` already, with the boxes where they are."""
    apart = [float(np.linalg.norm(each[-1].pose[:3, 3] - tool[:3, 3])) for each in spans]
    if not apart:
        return Try(grip, None, np.inf, False, shut)
    k = int(np.argmin(apart))
    return Try(grip, k, apart[k], apart[k] <= GRASP * edge and not shut, shut)
