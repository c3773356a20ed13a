"""The page of history: the entry that is looked at, the answers on what is a robot, and a situation for the laws."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.robot.history.laws import SIGNS
from armlab.benches.robot.history.things import DEFINITIONS, THINGS, fulfils
from armlab.benches.robot.history.timeline import EVENTS, LANES
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, own, some, text
from armlab.session.state import Command, Json, PartType, State

SHOWN = {"timeline": "1 Timeline", "things": "2 Robot or not?", "laws": "3 Three laws"}

Answers = tuple[tuple[str, bool], ...]
"""Answers, each after ``definition/thing``, in alphabetical order."""


def _read(data: Json) -> Answers:
    found = {}
    for name, answer in dict(data).items():
        definition, _, thing = str(name).partition("/")
        known_name("definition", definition, DEFINITIONS)
        known_name("thing", thing, THINGS)
        if not isinstance(answer, bool):
            raise InputError(f"answers: expected true or false for {name}, got {str(answer)[:40]!r}")
        found[str(name)] = answer
    return _sorted(found)


def _sorted(answers: dict[str, bool]) -> Answers:
    return tuple(sorted(answers.items()))


@dataclass(frozen=True, eq=False)
class History(FieldPart):
    """Choices of the page.

    Attributes
    ----------
    shown : "timeline", "things" or "laws"
    lane, event : str
        Group of the timeline that is listed, and the entry that is looked at.
    definition : str
    answers : tuple of (str, bool)
        Whether a person has said of a thing that it fulfils a definition, after ``definition/thing``.
    holds : frozenset of str
        What is true of the action that the laws are asked about, of `SIGNS`.
    example : str
    """

    key: ClassVar[str] = "history"
    looks: ClassVar[tuple[str, ...]] = ("shown", "lane", "event", "definition")

    shown: str = choice("what is shown of the history", "timeline", SHOWN)
    lane: str = choice("group of the timeline", "factory", LANES)
    event: str = choice("entry of the timeline", "unimate", tuple(EVENTS))
    definition: str = choice("definition", "iso", tuple(DEFINITIONS))
    answers: Answers = own("answers on what is a robot", (), _read, dict)
    holds: frozenset[str] = some("what is true of the action", (), tuple(SIGNS))
    example: str = text("example")

    @property
    def judged(self) -> dict[str, bool]:
        """The answers to the present definition, thing to answer."""
        start = f"{self.definition}/"
        return {name.removeprefix(start): said for name, said in self.answers if name.startswith(start)}

    @property
    def right(self) -> int:
        """Number of right answers to the present definition."""
        return sum(said == fulfils(thing, self.definition) for thing, said in self.judged.items())


PART = PartType(History, order=41)


@dataclass(frozen=True)
class LookAt(Command):
    """Look at an entry of the timeline, and list the group it belongs to."""

    event: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the entry."""
        return state.replace(
            state[History].with_values({"shown": "timeline", "event": self.event, "lane": EVENTS[self.event].lane})
        )


@dataclass(frozen=True)
class Judge(Command):
    """Say whether a thing fulfils the present definition.

    Parameters
    ----------
    thing : str
        Key of a thing.
    says : bool
    """

    thing: str
    says: bool
    label: ClassVar[str] = "answer on what is a robot"

    def apply(self, state: State) -> State:
        """Return the state with the answer."""
        part = state[History]
        known_name("thing", self.thing, THINGS)
        answers = _sorted({**dict(part.answers), f"{part.definition}/{self.thing}": self.says})
        return state.replace(replace(part, answers=answers, example=""))


@dataclass(frozen=True)
class JudgeAnew(Command):
    """Take all answers to the present definition back."""

    label: ClassVar[str] = "answers on what is a robot"

    def apply(self, state: State) -> State:
        """Return the state without answers to the present definition."""
        part = state[History]
        kept = tuple(each for each in part.answers if not each[0].startswith(f"{part.definition}/"))
        return state.replace(replace(part, answers=kept, example=""))


@dataclass(frozen=True)
class Suppose(Command):
    """Suppose that something is true of the action that the laws are asked about, or no longer."""

    flag: str
    on: bool
    label: ClassVar[str] = "situation"

    def apply(self, state: State) -> State:
        """Return the state with the situation."""
        part = state[History]
        known_name("situation", self.flag, SIGNS)
        holds = part.holds | {self.flag} if self.on else part.holds - {self.flag}
        return state.replace(replace(part, holds=frozenset(holds), example=""))
