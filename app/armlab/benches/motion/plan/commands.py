"""Commands for the moves of a plan. One that makes the plan impossible is refused, and the old plan stays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from armlab.benches.motion.chosen import Chosen, Value
from armlab.benches.motion.plan.moves import (
    LINE,
    Move,
    Stretch,
    as_laid,
    checked_space,
    checked_turning,
    resting,
)
from armlab.benches.motion.plan.paths import joint_path, refuse_coincident, tool_path
from armlab.benches.motion.plan.state import (
    Plan,
)
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import law_types, path_type, path_types
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State

FEWER = {"times": 0, "velocities": 0, "blend": 0, "speed": 1, "amount": 2}
"""Options of paths that list values for each waypoint, line or corner, with how many fewer these are than waypoints."""

ONE_FOR_ALL = {"blend", "speed", "amount"}
"""Those of them in which one value stands for all."""


def with_plan(state: State, part: Plan) -> State:
    """Return the state with a changed plan, after a check that its paths exist.

    Raises
    ------
    InputError
        They cannot; the text names the move or the waypoint.
    """
    refuse_pathless(state[Joints].arm, part)
    return state.replace(part)


def refuse_pathless(arm: Arm, part: Plan) -> None:
    """Raise `InputError` if there is no path through the waypoints of a stretch."""
    refuse_coincident(arm, part.waypoints, part.parts)
    for stretch in part.parts:
        _refuse_pathless(arm, part, stretch)


def _refuse_pathless(arm: Arm, part: Plan, stretch: Stretch) -> None:
    points = part.waypoints[stretch.first : stretch.last + 1]
    if stretch.move.space == "joint":
        joint_path(arm, stretch, np.array([point.q for point in points]))
    else:
        tool_path(arm, stretch, np.array([point.wanted(arm) for point in points]))


def edited(part: Plan, **changes: object) -> Plan:
    """Return an edited part, which is no longer an example and has no recorded motion in place of the waypoints."""
    return replace(part, **{"example": "", "recorded": None, **changes})  # type: ignore[arg-type]


class PlanCommand(Command):
    """A change of the plan."""

    label: ClassVar[str] = "change of the plan"


@dataclass(frozen=True)
class SetMove(PlanCommand):
    """Choose how the arm comes to a waypoint; None leaves a choice unchanged.

    In a stretch through several waypoints all moves change.

    Parameters
    ----------
    k : int
        The waypoint, from 0; the first has no move.
    space, path, law, turning : str, optional
        Keys.
    stop : bool, optional
        Whether the arm rests at this waypoint; of this move alone.
    apart : bool, optional
        Whether each joint goes by itself in a straight joint move.
    """

    k: int
    space: str | None = None
    path: str | None = None
    law: str | None = None
    turning: str | None = None
    stop: bool | None = None
    apart: bool | None = None
    label: ClassVar[str] = "kind of move"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Plan]
        first, last = _moves_of(part, self.k) if self.path is None else self._reached(part)
        # Half an arc is shown as a straight line, and only that can have another path, or go on at its ends.
        shown = part.laid if self.path is not None or self.law == "constant" else part.moves
        chosen = tuple(map(self._changed, shown[first:last]))
        moves = (*part.moves[:first], *chosen, *part.moves[last:])
        # Half an arc before them would make a whole one of their first move.
        if self.path is not None and as_laid(moves, part.waypoints)[first:last] != chosen:
            moves = (*part.laid[:first], *chosen, *part.laid[last:])
        if self.stop is not None:
            stops = replace(moves[self.k - 1], stop=self.stop)
            moves = (*moves[: self.k - 1], stops, *moves[self.k :])
        if moves == part.moves:
            return state
        return with_plan(state, refitted(state[Joints].arm, edited(part, moves=moves)))

    def _reached(self, part: Plan) -> tuple[int, int]:
        """Return the moves that get a new path: those of the stretch, and as many beside it as the path needs.

        Through any number of waypoints it goes where moves like this one follow each other.
        """
        first, last = _moves_of(part, self.k)
        kind = path_type(str(self.path))
        like = part.laid[first].through()
        most = len(part.moves) if kind.most is None else max(kind.least - 1, 1)
        # A path through three or more is not that path any more where the arm rests between them.
        inner = range(1, len(part.moves)) if kind.least > 2 else ()
        rests = {k for k in inner if part.moves[k - 1].stop or part.waypoints[k].rests}

        def goes_on(k: int, i: int) -> bool:
            return last - first < most and k not in rests and part.laid[i].through() == like

        while last < len(part.moves) and goes_on(last, last):
            last += 1
        while first > 0 and goes_on(first, first - 1):
            first -= 1
        if last - first < kind.least - 1:
            resting_at = min(rests & {first, last}, default=None)
            instead = "" if resting_at is None else f", or take the rest at waypoint {resting_at + 1} away"
            raise InputError(
                f"move {first + 1} → {last + 1}: {kind.title} takes {kind.least} waypoints with moves of one kind "
                f"between them, and there are {last - first + 1}. Add waypoints, or make the moves alike first{instead}"
            )
        if kind.most is not None and kind.least > 2:
            first, last = self._window(first, last, kind.most - 1)
        return first, last

    def _window(self, first: int, last: int, count: int) -> tuple[int, int]:
        """Return the ``count`` moves, counted off from the first one, with that of the command among them."""
        before = (self.k - 1 - first) // count * count
        first = max(first, min(first + before, last - count))
        return first, min(first + count, last)

    def _changed(self, move: Move) -> Move:
        if self.space is not None and self.space != move.space:
            space = checked_space(self.space)
            if space in move.kind.spaces:
                move = replace(move, space=space, path=Chosen(move.path.key))
            else:
                move = replace(move, space=space, path=LINE, law=resting(move.law))
        if self.path is not None and self.path != move.path.key:
            path = Chosen.of(path_types(), self.path)
            if move.space not in path_types()[path.key].spaces:
                raise InputError(f"path: {path_types()[path.key].title} is not available in {move.space} space")
            # A path that has its own time, and rests at its ends, keeps it: the parameter runs evenly.
            kind = path_types()[path.key]
            own = kind.rests and "duration" in {field.key for field in kind.fields}
            move = replace(move, path=path, law=Chosen("constant") if own else resting(move.law))
        if self.law is not None and self.law != move.law.key:
            move = replace(move, law=Chosen.of(law_types(), self.law))
        if self.apart is not None:
            move = replace(move, apart=self.apart)
        return move if self.turning is None else replace(move, turning=checked_turning(self.turning))


@dataclass(frozen=True)
class SetMoveOption(PlanCommand):
    """Set one option of the path or the law of the move to a waypoint; None restores its default."""

    k: int
    of: Literal["path", "law"]
    name: str
    value: Value
    label: ClassVar[str] = "option of a move"

    def apply(self, state: State) -> State:
        """Return the state with the option set in the whole stretch."""
        part = state[Plan]
        first, last = _moves_of(part, self.k)
        kinds = path_types() if self.of == "path" else law_types()
        moves = list(part.moves)
        for i in range(first, last):
            chosen: Chosen = getattr(part.laid[i], self.of)
            changed = chosen.with_option(kinds[chosen.key], self.name, self.value)
            moves[i] = replace(moves[i], path=changed) if self.of == "path" else replace(moves[i], law=changed)
        return with_plan(state, edited(part, moves=tuple(moves)))


@dataclass(frozen=True)
class AllMovesLike(PlanCommand):
    """Make all moves like the one to a waypoint."""

    k: int
    label: ClassVar[str] = "kind of all moves"

    def apply(self, state: State) -> State:
        """Return the state with equal moves, without stops where the path can pass through."""
        part = state[Plan]
        first, _ = _moves_of(part, self.k)
        like = part.laid[first].through()
        return with_plan(state, refitted(state[Joints].arm, edited(part, moves=(like,) * len(part.moves))))


def checked_index(part: Plan, k: int) -> int:
    """Return the index of a waypoint; `InputError` if there is none."""
    if not 0 <= k < len(part.waypoints):
        raise InputError(f"waypoint: expected 1 to {len(part.waypoints)}, got {k + 1}")
    return k


def _moves_of(part: Plan, k: int) -> tuple[int, int]:
    """Return the first move, and the one after the last, of the stretch that ends at a waypoint."""
    if checked_index(part, k) == 0:
        raise InputError("waypoint 1: the motion begins there, and no move leads to it")
    stretch = part.stretch_to(k)
    return stretch.first, stretch.last


def refitted(arm: Arm, part: Plan) -> Plan:
    """Return a plan without the options of paths that list values for other waypoints."""
    moves = list(part.moves)
    for stretch in part.parts:
        for i in range(stretch.first, stretch.last):
            moves[i] = _refitted(arm, part, replace(stretch, move=moves[i]))
    return part if tuple(moves) == part.moves else replace(part, moves=tuple(moves))


def _refitted(arm: Arm, part: Plan, stretch: Stretch) -> Move:
    """Return the move of a stretch without the options that do not fit its waypoints."""
    count = stretch.last - stretch.first + 1
    move = _without(stretch.move, [name for name, value in stretch.move.path.given if not _fits(name, value, count)])
    # Whether other lists fit, such as the times of virtual knots, depends on more than their length.
    plain = _without(move, [field.key for field in move.kind.fields if field.kind == "list" and field.key not in FEWER])
    if plain == move or not _refused(arm, part, replace(stretch, move=move)):
        return move
    # Where these waypoints give no path at all, those lists are not to blame.
    return move if _refused(arm, part, replace(stretch, move=plain)) else plain


def _without(move: Move, names: Sequence[str]) -> Move:
    """Return a move without some options of its path."""
    return replace(move, path=Chosen(move.path.key, tuple(each for each in move.path.given if each[0] not in names)))


def _refused(arm: Arm, part: Plan, stretch: Stretch) -> bool:
    try:
        _refuse_pathless(arm, part, stretch)
    except InputError:
        return True
    return False


def _fits(name: str, value: Value, count: int) -> bool:
    """Return whether an option can be that of a path through so many waypoints."""
    return name not in FEWER or len(value) == count - FEWER[name] or (name in ONE_FOR_ALL and len(value) == 1)
