"""One curve in space with its law, and one turn between two orientations: the laboratory of geometry."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal, Self

import numpy as np

from armlab.benches.motion.space_curve.formula import FARTHEST
from armlab.benches.motion.space_curve.laid import FORMULA, Laid, Moment, Point, Question, kinds, laid, moment
from armlab.benches.motion.space_curve.turn import Triple, Turned, TurnQuestion, turned
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.euler import SEQUENCES
from armlab.kin.motion import free_law_types
from armlab.session.chosen import Chosen
from armlab.session.parts.timeline import Timeline
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Json, Part, PartType, State

CLIP_KEY = "space_curve"

Shown = Literal["curve", "turn"]

MOST_POINTS = 24
"""Of a curve: what can be typed and read in a panel."""

POINTS: tuple[Point, ...] = ((-0.6, -0.1, 0.25), (-0.4, -0.25, 0.6), (-0.15, -0.1, 0.35), (-0.3, 0.15, 0.6))
"""Where points are put that nobody has typed."""

NOTES: tuple[str, str, str] = ("6s+2", "5s^2", "-8s")
"""The curve of the notes, 6.142."""


@dataclass(frozen=True)
class SpaceCurve(Part):
    """What is looked at.

    Attributes
    ----------
    shown : "curve" or "turn"
        Which of both.
    curve : Chosen
        Kind of the curve and its options.
    points : tuple of (float, float, float)
        Waypoints, metres.
    formula : tuple of str
        x(s), y(s), z(s) in metres, for the typed curve.
    by_length : bool
        Whether the curve is parametrised by its length.
    law : Chosen
        Timing law and its options; for curve and turn.
    duration : float
        Seconds.
    frame, arrows : bool
        Whether the Frenet frame, and velocity and acceleration are drawn.
    axes : str
        The sequence in which the orientations are typed.
    fixed : bool
        Whether its axes stay.
    start, end : (float, float, float)
        Angles of R_A and R_B, radians.
    other_way : bool
        Whether the turn about one axis goes the long way.
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    """

    key: ClassVar[str] = "space_curve"

    shown: Shown = "curve"
    curve: Chosen = field(default_factory=lambda: Chosen(FORMULA))
    points: tuple[Point, ...] = POINTS[:3]
    formula: tuple[str, str, str] = NOTES
    by_length: bool = False
    law: Chosen = field(default_factory=lambda: Chosen("cubic"))
    duration: float = 4.0
    frame: bool = True
    arrows: bool = False
    axes: str = "zxz"
    fixed: bool = False
    start: Triple = (0.0, math.radians(60.0), 0.0)
    end: Triple = (math.radians(120.0), math.radians(60.0), math.radians(-120.0))
    other_way: bool = False
    example: str = "frenet"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the example of the notes."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    def to_json(self) -> Json:
        """Write everything."""
        return {
            "shown": self.shown,
            "curve": self.curve.to_json(),
            "points": [list(point) for point in self.points],
            "formula": list(self.formula),
            "by_length": self.by_length,
            "law": self.law.to_json(),
            "duration": self.duration,
            "frame": self.frame,
            "arrows": self.arrows,
            "axes": self.axes,
            "fixed": self.fixed,
            "start": list(self.start),
            "end": list(self.end),
            "other_way": self.other_way,
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when nothing can be computed with it."""
        opened = cls()
        x, y, z = (str(each) for each in data.get("formula", opened.formula))
        part = cls(
            shown="turn" if data.get("shown") == "turn" else "curve",
            curve=Chosen.from_json(data.get("curve", opened.curve.to_json()), kinds()),
            points=tuple(point_of(each, f"waypoint {k + 1}") for k, each in enumerate(data.get("points", POINTS[:3]))),
            formula=(x, y, z),
            by_length=bool(data.get("by_length", False)),
            law=Chosen.from_json(data.get("law", opened.law.to_json()), free_law_types()),
            duration=float(data.get("duration", opened.duration)),
            frame=bool(data.get("frame", True)),
            arrows=bool(data.get("arrows", False)),
            axes=str(data.get("axes", opened.axes)),
            fixed=bool(data.get("fixed", False)),
            start=point_of(data.get("start", opened.start), "angles of A"),
            end=point_of(data.get("end", opened.end), "angles of B"),
            other_way=bool(data.get("other_way", False)),
            example=str(data.get("example", "")),
        )
        check(part)
        return part

    @property
    def question(self) -> Question:
        """What the curve follows from."""
        points = () if self.curve.key == FORMULA else self.points
        formula = self.formula if self.curve.key == FORMULA else ("0", "0", "0")
        return Question(self.curve, points, formula, self.by_length, self.law, self.duration)

    @property
    def turn_question(self) -> TurnQuestion:
        """What the turn follows from."""
        return TurnQuestion(self.axes, self.fixed, self.start, self.end, self.other_way)


PART = PartType(SpaceCurve, order=99)


def curve_of(state: State) -> Laid:
    """Return the curve and its motion."""
    return laid(state[SpaceCurve].question)


def turn_of(state: State) -> Turned:
    """Return the two turns."""
    return turned(state[SpaceCurve].turn_question)


def time_of(state: State) -> float:
    """Return where its clip stands, seconds; 0 while it is not on."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def moment_of(state: State) -> Moment:
    """Return what holds on the curve where the clip stands."""
    return moment(state.derived(curve_of), time_of(state))


def turn_place(state: State) -> tuple[float, float]:
    """Return s and s-dot of the turn where the clip stands."""
    s, rate = state.derived(curve_of).law.derivatives(time_of(state), (0, 1))
    return min(max(float(s), 0.0), 1.0), float(rate)


def point_of(values: Sequence[float], where: str) -> Point:
    """Return three finite numbers; `InputError` when they are not."""
    found = tuple(float(value) for value in values)
    if len(found) != 3:
        raise InputError(f"{where}: expected three numbers, got {len(found)}")
    if not np.isfinite(found).all():
        raise InputError(f"{where}: expected finite numbers, got {list(found)}")
    return found


def check(part: SpaceCurve) -> None:
    """Refuse what nothing can be computed or drawn with; the text names the waypoint, the formula, or the angle."""
    if part.curve.key != FORMULA and len(part.points) > MOST_POINTS:
        raise InputError(f"waypoints: expected at most {MOST_POINTS} here, got {len(part.points)}")
    for k, point in enumerate(part.points):
        if not all(abs(value) <= FARTHEST for value in point):
            raise InputError(f"waypoint {k + 1}: expected coordinates of at most {FARTHEST:g} m")
    if part.axes not in SEQUENCES:
        raise UnknownName("axes", part.axes, SEQUENCES)
    for name, angles in (("A", part.start), ("B", part.end)):
        if not all(abs(angle) <= MOST_TURNED for angle in angles):
            raise InputError(f"angles of {name}: expected at most ten turns")
    turned(part.turn_question)
    laid(part.question)


def changed(state: State, part: SpaceCurve) -> State:
    """Return the state with another curve or turn, and the film, if it is on, at its beginning."""
    if part == state[SpaceCurve]:
        return state
    check(part)
    timeline = state[Timeline]
    rewound = replace(timeline, time=0.0, playing=False) if timeline.clip == CLIP_KEY else timeline
    return state.replace(part, rewound)
