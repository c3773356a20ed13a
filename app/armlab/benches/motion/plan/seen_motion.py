"""The planned motion as checks of lessons see it, its form as evidence, and common words of the checks."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Self

from armlab.content import evidence
from armlab.content.check import signed
from armlab.content.observation import Observation
from armlab.errors import InputError
from armlab.kin.checks import wrong

KEY = "motion"
"""The key of the planned motion in observations."""

NOT_PLANNED = "The motion has not been planned yet."
"""Sentence for a motion that is not planned yet, or is being planned."""

MOST_WAYPOINTS = 100
"""Largest number of waypoints of a motion in lessons."""

_TRUTHS = ("planned", "whole", "within", "played")
_FOLLOWS = ("trouble", "raised")
_SIZES = ("duration", "fastest", "velocity", "acceleration", "deviation")


@dataclass(frozen=True)
class SeenMove:
    """The move of the arm from one waypoint to the next.

    Attributes
    ----------
    space : str
        ``"joint"`` or ``"cartesian"``.
    path, law : str
        Keys of `armlab.kin.motion.path_types` and `armlab.kin.motion.law_types`.
    """

    space: str
    path: str
    law: str


@dataclass(frozen=True)
class SeenMotion:
    """The planned motion at present.

    Attributes
    ----------
    waypoints : int
        0 for a motion from a file.
    moves : tuple of SeenMove
        moves[k] comes to waypoint k + 1, both from 0.
    planned : bool
        Whether it is planned already; before that, the attributes below are those of a motion that cannot be run.
    whole : bool
        Whether it can be run to its end.
    within : bool
        Whether it keeps all limits that are set.
    duration : float
        Duration of the part that can be run, seconds.
    fastest : float
        Least duration within the limits, seconds; 0 when it cannot be run, or not within them.
    velocity, acceleration : float
        Largest fraction of the limits of the joints, 1 at a limit.
    deviation : float
        Largest distance of the tool from its Cartesian path, between samples of the inverse kinematics, metres.
    played : bool
        Whether it was played to its end, in its present form, since the step was shown.
    time : float or None
        Time of its playback, seconds; None while it is not open.
    trouble : str
        Why it cannot be run; empty when it can. Not kept as evidence.
    raised : str
        The joint limit that was set higher than the arm's own; empty when none was. Not kept as evidence.
    """

    waypoints: int = 0
    moves: tuple[SeenMove, ...] = ()
    planned: bool = False
    whole: bool = False
    within: bool = False
    duration: float = 0.0
    fastest: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0
    deviation: float = 0.0
    played: bool = False
    time: float | None = None
    trouble: str = ""
    raised: str = ""

    @property
    def runs(self) -> bool:
        """Whether the motion can be run to its end within all limits."""
        return self.planned and self.whole and self.within and not self.raised

    def to_json(self) -> dict[str, Any]:
        """Return the motion as plain data."""
        data = {key: value for key, value in asdict(self).items() if key not in _FOLLOWS}
        return {**data, "moves": [[move.space, move.path, move.law] for move in self.moves]}

    @classmethod
    def from_json(cls, data: object, where: str) -> Self:
        """Read evidence back.

        Raises
        ------
        InputError
            A missing or unknown field, a wrong type or size.
        """
        fields = evidence.mapping(data, where, tuple(cls().to_json()))
        moves, time, waypoints = fields["moves"], fields["time"], _positive(fields["waypoints"], f"{where}.waypoints")
        if not isinstance(moves, list) or len(moves) > MOST_WAYPOINTS:
            raise wrong(f"{where}.moves", f"a list of at most {MOST_WAYPOINTS} moves", moves)
        if waypoints != int(waypoints):
            raise wrong(f"{where}.waypoints", "a whole number", waypoints)
        truths = {key: evidence.truth(fields[key], f"{where}.{key}") for key in _TRUTHS}
        sizes = {key: _positive(fields[key], f"{where}.{key}") for key in _SIZES}
        given: dict[str, Any] = {**truths, **sizes}
        return cls(
            waypoints=int(waypoints),
            moves=tuple(_move(move, f"{where}.moves[{k}]") for k, move in enumerate(moves, start=1)),
            time=None if time is None else _positive(time, f"{where}.time"),
            **given,
        )


def motion_in(observation: Observation) -> SeenMotion | None:
    """Return the planned motion of an observation; None where nothing has asked for it."""
    found = observation.benches.get(KEY)
    return found if isinstance(found, SeenMotion) else None


def seconds(value: float) -> str:
    """Return a time with two decimals and its unit."""
    return f"{signed(value, 2)} s"


def percent(share: float) -> str:
    """Return a fraction as a percentage with at most one decimal."""
    return f"{round(100.0 * share, 1):g} %"


def _positive(value: object, where: str) -> float:
    found = evidence.number(value, where)
    if found < 0.0:
        raise InputError(f"{where}: expected a number not below zero, got {found:g}")
    return found


def _move(data: object, where: str) -> SeenMove:
    if not isinstance(data, list) or len(data) != 3:
        raise wrong(where, "a list of space, path and law", data)
    space, path, law = (evidence.name(entry, where) for entry in data)
    return SeenMove(space, path, law)
