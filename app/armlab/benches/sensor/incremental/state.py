"""The incremental encoder that is looked at: its periods, how it is turned, and how its edges are counted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import DECODERS, Decoder, Motion, Signals
from armlab.session.fields import FieldPart, choice, flag, number, own, text, whole
from armlab.session.parts.timeline import Timeline
from armlab.session.state import PartType, State

CLIP_KEY = "incremental_encoder"

RULES = {"opposite": "opposite", "same": "equal"}
"""Directions for which the two orders of the edges are taken."""

MOST_MOVES, MOST_EDGES = 100, 20_000
"""Largest numbers of moves, and of edges that come by in all of them."""

LONGEST = 600.0
"""Largest duration of all moves, in seconds."""

FARTHEST = 100.0 * TURN
"""Largest angle of a move, radians."""


def _moves(data: Any) -> tuple[float, ...]:
    if len(data) > MOST_MOVES:
        raise InputError(f"moves: expected at most {MOST_MOVES}, got {len(data)}")
    values = finite_floats(data, "moves", (len(data),), "angles")
    if (abs(values) > FARTHEST).any():
        raise InputError(f"moves: expected angles of at most {FARTHEST / TURN:g} turns")
    return tuple(values.tolist())


@dataclass(frozen=True)
class Incremental(FieldPart):
    """One encoder and how it is turned, which do not depend on the arm.

    Attributes
    ----------
    pulses : int
        PPR, periods in a turn.
    decoder : str
        Key of `DECODERS`.
    rule : str
        Some of `RULES`.
    start : float
        Angle at the start, where the counter is 0; radians.
    moves : tuple of float
        Angles of the moves, one after the other, radians.
    speed : float
        rad/s.
    shakes : int
        How often the disk trembles to and fro after the moves.
    shake : float
        How far it trembles, electrical radians.
    index : bool
        Whether Z sets the counter to 0.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "incremental_encoder"
    clip: ClassVar[str] = CLIP_KEY

    pulses: int = whole("periods in a turn, PPR", 8, 1, 100_000)
    decoder: str = choice("rule of counting", "x4", {key: each.title for key, each in DECODERS.items()})
    rule: str = choice("directions of A before B and of B before A", "opposite", RULES)
    start: float = number("θ_0", "angle at the start", 0.0, -FARTHEST, FARTHEST, "rad")
    moves: tuple[float, ...] = own("moves", tuple(map(math.radians, (100.0, -50.0, 20.0, -70.0))), _moves)
    speed: float = number("ω", "speed of the moves", 0.5 * math.pi, 1e-3, 1e4, "rad/s")
    shakes: int = whole("times to and fro in the end", 0, 0, 50)
    shake: float = number("", "electrical angle of the trembling", 0.0, 0.0, TURN, "rad")
    index: bool = flag("Z sets the count to 0", False)
    example: str = text("example", "reversals")

    @cached_property
    def motion(self) -> Motion:
        """All moves, those to and fro included."""
        by = self.shake / self.pulses
        return Motion(self.start, (*self.moves, *(by, -by) * (self.shakes if by else 0)), self.speed)

    @cached_property
    def signals(self) -> Signals:
        """A and B over time."""
        return self.motion.signals(self.pulses)

    def decoder_of(self, key: str) -> Decoder:
        """Return a rule of counting, with both orders of the edges taken for what was chosen."""
        decoder = DECODERS[key]
        return decoder.one_way() if self.rule == "same" else decoder

    def check(self) -> None:
        """Refuse moves that last too long, or during which too many edges come by."""
        if self.motion.duration > LONGEST:
            raise InputError(
                f"moves: they last {self.motion.duration:.4g} s at this speed, expected at most {LONGEST:g} s"
            )
        edges = self.motion.edges(self.pulses)
        if edges > MOST_EDGES:
            raise InputError(f"moves: {edges} edges of A and B come by, expected at most {MOST_EDGES}")


PART = PartType(Incremental, order=141)


def present_time(state: State) -> float:
    """Return the time of the film in seconds; the end of all moves while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else state[Incremental].motion.duration
