"""One curve in space with its law, and one turn between two orientations, for the page of geometry."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, Literal, get_args

from armlab.benches.motion.chosen import Chosen, Kind
from armlab.benches.motion.space_curve.formula import FARTHEST
from armlab.benches.motion.space_curve.laid import FORMULA, Laid, Moment, Point, Question, kinds, laid, moment
from armlab.benches.motion.space_curve.turn import Triple, Turned, TurnQuestion, turned
from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.euler import SEQUENCES
from armlab.kin.motion import free_law_types
from armlab.session.fields import FieldPart, choice, flag, number, own, text
from armlab.session.parts.timeline import Timeline
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Json, PartType, State

CLIP_KEY = "space_curve"

Shown = Literal["curve", "turn"]

MOST_POINTS = 24
"""Largest number of points of a curve, which can be typed and read in a panel."""

POINTS: tuple[Point, ...] = ((-0.6, -0.1, 0.25), (-0.4, -0.25, 0.6), (-0.15, -0.1, 0.35), (-0.3, 0.15, 0.6))
"""Initial points."""

NOTES: tuple[str, str, str] = ("6s+2", "5s^2", "-8s")
"""Curve of the notes, 6.142."""

START: Triple = (0.0, math.radians(60.0), 0.0)
END: Triple = (math.radians(120.0), math.radians(60.0), math.radians(-120.0))
"""Two initial orientations to turn between, as three angles each, radians."""


def _chosen(known: Callable[[], Mapping[str, Kind]], data: Json) -> Chosen:
    return Chosen.from_json(data.to_json() if isinstance(data, Chosen) else data, known())


def _three(where: str, most: float, says: str, data: Json) -> tuple[float, float, float]:
    x, y, z = finite_floats(data, where, (3,), "three finite numbers").tolist()
    if max(abs(x), abs(y), abs(z)) > most:
        raise InputError(f"{where}: expected {says}")
    return x, y, z


def _points(data: Json) -> tuple[Point, ...]:
    says = f"coordinates of at most {FARTHEST:g} m"
    return tuple(_three(f"waypoint {k}", FARTHEST, says, point) for k, point in enumerate(data, start=1))


def _angles(name: str, data: Json) -> Triple:
    return _three(f"angles of {name}", MOST_TURNED, "at most ten turns", data)


def _formulas(data: Json) -> tuple[str, str, str]:
    """Return three texts, which are parsed when the curve is computed."""
    x, y, z = data
    if isinstance(data, str) or not all(isinstance(each, str) for each in data):
        raise TypeError
    return x, y, z


@dataclass(frozen=True)
class SpaceCurve(FieldPart):
    """Choices of the page.

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
        Key of the loaded example; empty if it has been changed or there is none.
    """

    key: ClassVar[str] = "space_curve"
    clip: ClassVar[str] = CLIP_KEY
    looks: ClassVar[tuple[str, ...]] = ("frame", "arrows")

    shown: Shown = choice("what is shown", "curve", get_args(Shown))
    curve: Chosen = own("kind of curve", Chosen(FORMULA), partial(_chosen, kinds), Chosen.to_json)
    points: tuple[Point, ...] = own("waypoints", POINTS[:3], _points)
    formula: tuple[str, str, str] = own("formula of the curve", NOTES, _formulas)
    by_length: bool = flag("parameter of the curve", False)
    law: Chosen = own("timing law", Chosen("cubic"), partial(_chosen, free_law_types), Chosen.to_json)
    duration: float = number("T", "duration", 4.0, unit="s")
    frame: bool = flag("Frenet frame", True)
    arrows: bool = flag("velocity and acceleration", False)
    axes: str = choice("sequence of angles", "zxz", SEQUENCES)
    fixed: bool = flag("whether the axes stay", False)
    start: Triple = own("angles of A", START, partial(_angles, "A"))
    end: Triple = own("angles of B", END, partial(_angles, "B"))
    other_way: bool = flag("way round", False)
    example: str = text("example", "frenet")

    def check(self) -> None:
        """Refuse settings that cannot be computed or drawn; the text names the fault."""
        if self.curve.key != FORMULA and len(self.points) > MOST_POINTS:
            raise InputError(f"waypoints: expected at most {MOST_POINTS} here, got {len(self.points)}")
        turned(self.turn_question)
        laid(self.question)

    @property
    def question(self) -> Question:
        """Arguments of the curve."""
        points = () if self.curve.key == FORMULA else self.points
        formula = self.formula if self.curve.key == FORMULA else ("0", "0", "0")
        return Question(self.curve, points, formula, self.by_length, self.law, self.duration)

    @property
    def turn_question(self) -> TurnQuestion:
        """Arguments of the turn."""
        return TurnQuestion(self.axes, self.fixed, self.start, self.end, self.other_way)


PART = PartType(SpaceCurve, order=99)


def curve_of(state: State) -> Laid:
    """Return the curve and its motion."""
    return laid(state[SpaceCurve].question)


def turn_of(state: State) -> Turned:
    """Return the two turns."""
    return turned(state[SpaceCurve].turn_question)


def time_of(state: State) -> float:
    """Return the time of the clip, seconds; 0 while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def moment_of(state: State) -> Moment:
    """Return the quantities of the curve at the time of the clip."""
    return moment(state.derived(curve_of), time_of(state))


def turn_place(state: State) -> tuple[float, float]:
    """Return s and s-dot of the turn at the time of the clip."""
    s, rate = state.derived(curve_of).law.derivatives(time_of(state), (0, 1))
    return min(max(float(s), 0.0), 1.0), float(rate)
