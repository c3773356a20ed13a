"""Examples of the absolute encoder, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.absolute.state import CLIP_KEY, Absolute
from armlab.kin.sensors.absolute import resolution
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples, with_clip_closed
from armlab.session.fields import put
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, State

BEFORE_HALF = 7.85 * resolution(4)
"""Angle just before half a turn of sixteen sectors, in radians."""

EXAMPLES = part_examples(
    PartExample(
        "four",
        "Gray code, 4 tracks",
        Absolute(),
        "From each of the 16 sectors to the next one a single bit changes, also from the last to the first.",
    ),
    PartExample(
        "binary",
        "Plain binary, 4 tracks",
        Absolute(code="binary", angle=7.5 * resolution(4)),
        "From sector 7 to sector 8, 0111 becomes 1000: all four bits change, and no four sensors do so at once.",
    ),
    PartExample(
        "glitch",
        "A sensor out of line, plain binary",
        Absolute(code="binary", offset=0.3, angle=BEFORE_HALF),
        "The sensor of track 1 sees the edge 0.3 sectors too early: just before half a turn 0111 reads as 1111, which "
        "is 15 in place of 7: wrong by half a turn.",
    ),
    PartExample(
        "safe",
        "The same sensor, Gray code",
        Absolute(offset=0.3, angle=BEFORE_HALF),
        "The same sensor sees the same edge too early. Only its bit was to change there, so that 8 is read a little "
        "too soon, and never another number.",
    ),
    PartExample(
        "joint",
        "12 tracks, a joint of a robot",
        Absolute(tracks=12, track=1, offset=0.3, angle=2047.85 * resolution(12)),
        "4096 sectors of 0.0879°. Read in plain binary, this sensor would be half a turn wrong for 0.015 % of the "
        "turn: rare, and dangerous.",
    ),
    PartExample(
        "far",
        "A sensor out of line by 1.5 sectors",
        Absolute(tracks=5, track=1, offset=1.5, angle=14.8 * resolution(5)),
        "Gray code forgives up to one sector. Here it is more: a sector and a half before the edge the reading is "
        "mirrored, three sectors too far.",
    ),
)


@dataclass(frozen=True)
class ChooseAbsoluteExample(Command):
    """Load the encoder of an example; its film is closed."""

    key: str
    label: ClassVar[str] = "example of the absolute encoder"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        closed = with_clip_closed(state) if state[Timeline].clip == CLIP_KEY else state
        return put(closed, EXAMPLES[self.key].part)


BENCH = Bench("absolute", 70, EXAMPLES, ChooseAbsoluteExample)
