"""A move of the plan, or every move, has a given space, path or law."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, get_args

from armlab.benches.motion.plan.seen_motion import KEY, MOST_WAYPOINTS, NOT_PLANNED, SeenMotion, SeenMove, motion_in
from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.lesson_fields import Fields
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot
from armlab.kin.motion import law_types, path_types
from armlab.kin.motion.path_types import Space


@dataclass(frozen=True)
class MoveIs:
    """Properties of the move to waypoint ``to`` (from 2), or of all moves for 0; empty ones do not count."""

    observes: ClassVar[tuple[str, ...]] = (KEY,)

    to: int = 0
    space: str = ""
    path: str = ""
    law: str = ""

    def is_met(self, observation: Observation) -> bool:
        """Return whether there is such a move and it, or every move, has the properties."""
        motion = motion_in(observation)
        return motion is not None and bool(self._asked(motion)) and not any(self._mistakes(motion))

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first move that differs."""
        motion = motion_in(observation)
        if motion is None:
            return NOT_PLANNED
        if not self._asked(motion):
            return f"There is no waypoint {self.to}." if self.to and motion.moves else "There is no move."
        return next(self._mistakes(motion), "The moves are as they should be.")

    def _asked(self, motion: SeenMotion) -> dict[int, SeenMove]:
        """Return the moves in question by the waypoint to which they lead, from 2."""
        moves = dict(enumerate(motion.moves, start=2))
        return {k: move for k, move in moves.items() if self.to in (0, k)}

    def _mistakes(self, motion: SeenMotion) -> Iterator[str]:
        for k, move in self._asked(motion).items():
            name = f"The move {k - 1} → {k}"
            if self.space and move.space != self.space:
                yield f"{name} is {_in(move.space)}; one {_in(self.space)} is required."
            if self.path and move.path != self.path:
                yield f"{name} has the path “{_path(move.path)}”; “{_path(self.path)}” is required."
            if self.law and move.law != self.law:
                yield f"{name} has the law “{_law(move.law)}”; “{_law(self.law)}” is required."


def _in(space: str) -> str:
    return {"joint": "in joint space", "cartesian": "in Cartesian space"}.get(space, space)


def _path(key: str) -> str:
    return path_types()[key].title if key in path_types() else key


def _law(key: str) -> str:
    return law_types()[key].title if key in law_types() else key


def read(table: Table, robot: Robot) -> MoveIs:
    """Read ``to``, the waypoint at the end of the move (all when left out), ``space``, ``path`` and ``law``."""
    to = Fields.of(table).whole("to", 2, MOST_WAYPOINTS) if table.has("to") else 0
    kinds = {"space": get_args(Space), "path": path_types(), "law": law_types()}
    wanted = {key: table.choice(key, options) for key, options in kinds.items() if table.has(key)}
    if not wanted:
        raise table.fail("space", "missing; expected some of space, path, law")
    _refuse_impossible(table, wanted)
    return MoveIs(to, **wanted)


def _refuse_impossible(table: Table, wanted: dict[str, str]) -> None:
    """Raise an error when a path does not exist in the given space."""
    if "path" not in wanted or "space" not in wanted:
        return
    spaces = path_types()[wanted["path"]].spaces
    if wanted["space"] not in spaces:
        raise table.fail("space", f"the path {wanted['path']!r} is in {' and '.join(spaces)} space only")


CHECK = CheckType("move_is", 72, read)
