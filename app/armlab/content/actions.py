"""The actions that solve a step, in order, as they are written in lesson files."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from armlab.content import robots
from armlab.content.bench_words import BenchWord, read_word
from armlab.content.check import JOINT_VALUES, configuration
from armlab.content.lesson_fields import Fields, example_name
from armlab.content.reader import Table, shown
from armlab.content.robots import Catalogue, Robot, read_pose
from armlab.content.vocabulary import BenchAction, vocabularies, with_added
from armlab.errors import ContentError, UnknownName, suggestion

MOST_ACTIONS = 100
LONGEST_WAIT = 600.0
"""Longest wait, seconds."""


@dataclass(frozen=True, eq=False)
class Move:
    """Move the arm to q, shape (n,), in rad and m."""

    q: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MoveTarget:
    """Place the handle of the target at a pose in the world, shape (4, 4)."""

    T: NDArray[np.float64]


@dataclass(frozen=True)
class SetCell:
    """Write one cell of the table.

    Attributes
    ----------
    row : int
        Index from 0, as in commands; lesson files count from 1.
    field : "a", "alpha", "d" or "theta"
    value : float
        Metres or radians.
    """

    row: int
    field: str
    value: float


@dataclass(frozen=True)
class TakeRobot:
    """Choose an arm from the catalogue."""

    key: str


@dataclass(frozen=True)
class SetSwitch:
    """Set a switch of the picture."""

    name: str
    on: bool


@dataclass(frozen=True)
class TakeExample:
    """Put an example of a bench in place, such as ``"motion/corner_fly"``."""

    name: str


@dataclass(frozen=True)
class PlayFilm:
    """Play a whole film or run of the timeline; without a name the film of the table."""

    name: str = "film"


@dataclass(frozen=True)
class Wait:
    """Let time pass."""

    seconds: float


@dataclass(frozen=True)
class TypeAnswer:
    """Answer the question of the step with this text."""

    text: str


Action = (
    Move
    | MoveTarget
    | SetCell
    | TakeRobot
    | SetSwitch
    | TakeExample
    | PlayFilm
    | Wait
    | TypeAnswer
    | BenchWord
    | BenchAction
)


def read_solution(table: Table, robot: Robot, catalogue: Catalogue | None = None) -> tuple[Action, ...]:
    """Read the table of a solution: joint values, or tables ``do``, each of a kind or with a command of a bench.

    Parameters
    ----------
    table : Table
    robot : Robot
        The arm of the lesson; after an action of kind "robot" joint values are those of the arm it takes.
    catalogue : Catalogue, optional
        The robots there are; those of the lab when left out.

    Raises
    ------
    ContentError
    """
    fields = Fields.of(table)
    if any(fields.has(key) for key in JOINT_VALUES):
        if fields.has("do"):
            raise fields.fail("do", "expected either joint values or tables [[do]], not both")
        actions: tuple[Action, ...] = (_move(fields, robot),)
        fields.done()
        return actions
    entries = fields.tables("do")
    fields.done()
    if not 1 <= len(entries) <= MOST_ACTIONS:
        raise table.fail(
            "do", f"expected q_deg, q_m or q_deg_m, or 1 to {MOST_ACTIONS} tables [[do]], got {len(entries)}"
        )
    found: list[Action] = []
    for entry in entries:
        action = _action(Fields.of(entry), robot, catalogue or robots.catalogue(), (*_readers(), "robot"))
        if isinstance(action, TakeRobot):
            robot = (catalogue or robots.catalogue())[action.key]
        found.append(action)
    return tuple(found)


def read_begin(table: Table, robot: Robot) -> tuple[Action, ...]:
    """Take tables ``do`` of what is put in place at a start, each of a kind or with a command of a bench; may be none.

    Raises
    ------
    ContentError
    """
    entries = table.tables("do")
    if len(entries) > MOST_ACTIONS:
        raise table.fail("do", f"expected at most {MOST_ACTIONS} tables [[do]], got {len(entries)}")
    kinds = (*AT_START, *(kind for each in vocabularies().values() for kind in each.actions))
    return tuple(_action(Fields.of(entry), robot, robots.catalogue(), kinds) for entry in entries)


def _action(entry: Fields, robot: Robot, catalogue: Catalogue, kinds: Iterable[str]) -> Action:
    if entry.has("command"):
        return read_word(entry)
    if not entry.has("kind"):
        raise entry.fail("kind", f"missing; expected one of {', '.join(kinds)}, or command, a word of a bench")
    kind = entry.choice("kind", kinds)
    action = _take_robot(entry, catalogue) if kind == "robot" else _readers()[kind](entry, robot)
    entry.done()
    return action


def _move(entry: Fields, robot: Robot) -> Move:
    return Move(configuration(entry, robot))


def _move_target(entry: Fields, robot: Robot) -> MoveTarget:
    del robot
    entry.numbers("position", 3)
    T = read_pose(entry)
    T.setflags(write=False)
    return MoveTarget(T)


def _set_cell(entry: Fields, robot: Robot) -> SetCell:
    row = entry.whole("row", 1, robot.arm.n) - 1
    name, value = entry.choice("field", ("a", "alpha_deg", "d", "theta_deg")), entry.number("value")
    if name.endswith("_deg"):
        return SetCell(row, name.removesuffix("_deg"), float(np.radians(value)))
    return SetCell(row, name, value)


def _take_robot(entry: Fields, catalogue: Catalogue) -> TakeRobot:
    return TakeRobot(known_robot(entry, "key", catalogue).key)


def known_robot(table: Table, key: str, catalogue: Catalogue) -> Robot:
    """Take the key of a robot in the catalogue."""
    name = table.text(key)
    try:
        return catalogue[name]
    except UnknownName:
        raise table.fail(key, f"unknown robot {name!r}{suggestion(name, catalogue.robots)}") from None
    except ContentError as error:
        raise table.fail(key, f"its file cannot be used: {error}") from None


def _set_switch(entry: Fields, robot: Robot) -> SetSwitch:
    del robot
    return SetSwitch(entry.text("name"), entry.boolean("on", True))


def _take_example(entry: Fields, robot: Robot) -> TakeExample:
    del robot
    return TakeExample(example_name(entry, "name"))


def _play_film(entry: Fields, robot: Robot) -> PlayFilm:
    del robot
    return PlayFilm(entry.text("name", "film"))


def _wait(entry: Fields, robot: Robot) -> Wait:
    del robot
    seconds = entry.number("seconds")
    if not 0.0 < seconds <= LONGEST_WAIT:
        raise entry.fail("seconds", f"expected more than 0 and at most {LONGEST_WAIT:g}, got {seconds:g}")
    return Wait(seconds)


def _type_answer(entry: Fields, robot: Robot) -> TypeAnswer:
    """Take a text, or a number that may be given by an expression of the variant."""
    del robot
    typed = entry.value("text")
    if isinstance(typed, (int, float)) and not isinstance(typed, bool):
        return TypeAnswer(f"{entry.number('text'):.12g}")
    if not isinstance(typed, str) or not typed.strip():
        raise entry.fail("text", f"expected the answer as typed, got {shown(typed)}")
    return TypeAnswer(typed)


_READERS: dict[str, Callable[[Fields, Robot], Action]] = {
    "move": _move,
    "target": _move_target,
    "cell": _set_cell,
    "switch": _set_switch,
    "film": _play_film,
    "wait": _wait,
    "answer": _type_answer,
    "example": _take_example,
}

AT_START = ("move", "target", "switch", "example")
"""Kinds of actions allowed at a start, besides those of benches: to play, wait, answer or change the arm is not."""


@cache
def _readers() -> Mapping[str, Callable[[Fields, Robot], Action]]:
    """Return the readers of all kinds of actions."""
    found = vocabularies().values()
    plays = {key: partial(_play, key) for each in found for key in each.plays}
    return with_added("kind of action", _READERS, (plays, *(each.actions for each in found)))


def _play(key: str, entry: Fields, robot: Robot) -> PlayFilm:
    del entry, robot
    return PlayFilm(key)
