"""The absolute encoder that is looked at: tracks, code, the sensor that is out of line, and where the disk stands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from armlab.kin.sensors.absolute import CODES, TURN, Disk
from armlab.session.fields import FieldPart, choice, number, text, whole
from armlab.session.state import PartType

CLIP_KEY = "absolute_encoder"

MOST_TRACKS = 12
"""Largest number of tracks that are drawn: 4096 sectors."""

FARTHEST = 2.0
"""Largest distance by which a sensor may be out of line, in sectors."""


@dataclass(frozen=True)
class Absolute(FieldPart):
    """One disk and its sensors, which do not depend on the arm.

    Attributes
    ----------
    tracks : int
    code : "gray" or "binary"
        Which disk is drawn; the page reads both.
    track : int
        Track of the sensor that is out of line, from 1, the coarsest; beyond the last track it is the last.
    offset : float
        How far that sensor is ahead, in sectors.
    angle : float
        Radians, 0 to a turn.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "absolute_encoder"
    leave_example: ClassVar[tuple[str, ...]] = ("example", "angle")

    tracks: int = whole("number of tracks", 4, 1, MOST_TRACKS)
    code: str = choice("code of the disk", "gray", CODES)
    track: int = whole("track of the sensor that is out of line", 1, 1, MOST_TRACKS)
    offset: float = number("", "how far this sensor is ahead, in sectors", 0.0, -FARTHEST, FARTHEST)
    angle: float = number("θ", "angle of the disk", TURN / 32.0, 0.0, TURN, "rad")
    example: str = text("example", "four")

    @property
    def off_track(self) -> int:
        """The track of the sensor that is out of line, which the disk has."""
        return min(self.track, self.tracks)

    @cached_property
    def disks(self) -> dict[str, Disk]:
        """The disk in either code, with the same sensors, by key of the code."""
        width = TURN / 2**self.tracks
        return {code: Disk(self.tracks, code, self.off_track, self.offset * width) for code in CODES}

    @property
    def disk(self) -> Disk:
        """The disk that is drawn."""
        return self.disks[self.code]


PART = PartType(Absolute, order=140)
