"""The student's answers in "Spot the error": for each erratum the part pointed at, and the correction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar, Self

from armlab.content.errata_task import Place, Task, task_of, with_tasks
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.state import Json, Part, PartType

LONGEST = 600
"""Longest answer that is kept, in characters."""

MOST_PARTS = 100
"""Bound of the numbers of parts, rows and columns."""


@dataclass(frozen=True)
class Tried:
    """The student's steps in one task.

    Attributes
    ----------
    pointed : Place
        The part pointed at last; empty for none.
    spotted : Place
        A wrong part that was pointed at; empty as long as none was.
    typed : str
        The last correction; empty for none.
    right : str
        A correction that was right; empty as long as none was.
    """

    pointed: Place = ()
    spotted: Place = ()
    typed: str = ""
    right: str = ""


@dataclass(frozen=True)
class Practice(Part):
    """The progress in all tasks. It is the student's own: it goes along to every place, and into no link.

    Attributes
    ----------
    tried : mapping of str to Tried
        By the id of the erratum.
    """

    key: ClassVar[str] = "errata_practice"
    called: ClassVar[str] = "your answers to errata"
    kept_by_undo: ClassVar[bool] = True

    tried: Mapping[str, Tried] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part without answers."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep all answers."""
        return self

    def of(self, key: str) -> Tried:
        """Return what was done in a task."""
        return self.tried.get(key, Tried())

    def pointing(self, key: str, place: Place) -> Self:
        """Return the part with something of what is printed pointed at; `InputError` for a place that is not there."""
        task, tried = _task(key), self.of(key)
        if place not in task.places:
            raise InputError(f"part: expected one of {', '.join(map(str, task.places))}, got {place}")
        spotted = place if place in task.at and not tried.spotted else tried.spotted
        return self._with(key, replace(tried, pointed=place, spotted=spotted))

    def answering(self, key: str, text: str) -> Self:
        """Return the part with a correction."""
        task, tried = _task(key), self.of(key)
        if len(text) > LONGEST:
            raise InputError(f"correction: expected at most {LONGEST} characters, got {len(text)}")
        right = text if not tried.right and task.question.judge(text).right else tried.right
        return self._with(key, replace(tried, typed=text, right=right))

    def without(self, key: str) -> Self:
        """Return the part with a task begun anew."""
        return replace(self, tried=MappingProxyType({each: tried for each, tried in self.tried.items() if each != key}))

    def _with(self, key: str, tried: Tried) -> Self:
        return replace(self, tried=MappingProxyType({**self.tried, key: tried}))

    @cached_property
    def done(self) -> frozenset[str]:
        """The ids of the errata that were spotted and put right; what a file says of it is judged again."""
        return frozenset(key for key, tried in self.tried.items() if is_done(task_of(key), tried))

    def to_json(self) -> Json:
        """Return the answers as JSON."""
        return {key: asdict(each) for key, each in self.tried.items()}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; answers to errata that are not there any more are left out."""
        if not isinstance(data, dict):
            raise InputError(f"{cls.key}: expected answers by erratum, got {type(data).__name__}")
        return cls(MappingProxyType({key: _tried(each) for key, each in data.items() if key in with_tasks()}))


def is_done(task: Task, tried: Tried) -> bool:
    """Return whether a wrong part was pointed at and a right correction given."""
    return tried.spotted in task.at and bool(tried.right) and task.question.judge(tried.right).right


def _task(key: str) -> Task:
    return task_of(known_name("erratum with a task", key, with_tasks()))


def _tried(data: Json) -> Tried:
    texts = [data[name] for name in ("typed", "right")]
    if not all(isinstance(text, str) and len(text) <= LONGEST for text in texts):
        raise InputError(f"{Practice.key}: expected answers of at most {LONGEST} characters")
    return Tried(_place(data["pointed"]), _place(data["spotted"]), *texts)


def _place(data: Json) -> Place:
    fits = isinstance(data, list | tuple) and len(data) <= 2
    if not fits or not all(isinstance(each, int) and 0 < each < MOST_PARTS for each in data):
        raise InputError(f"{Practice.key}: not a part of a formula: {data!r}")
    return tuple(data)


PART = PartType(Practice, order=97)
