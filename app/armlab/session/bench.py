"""Benches whose examples a lesson can use, found by folder: ``"motion/corner_fly"``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

from armlab.errors import InputError
from armlab.plugins import discover_in_benches
from armlab.registry import Registry, known_name
from armlab.session.pages import pages
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Bench:
    """The constant ``BENCH`` of ``examples.py`` of a page.

    Parameters
    ----------
    key : str
        The part before the slash in lesson files.
    order : int
        Place in lists.
    examples : mapping of str to object
        Examples by key; when one brings its arm, ``robot`` is the key of that.
    choose : callable
        ``choose(key) -> Command``, which puts the example in place.
    """

    key: str
    order: int
    examples: Mapping[str, Any]
    choose: Callable[[str], Command]


@cache
def benches() -> Registry[Bench]:
    """Return all benches by key."""
    return discover_in_benches("examples", "BENCH", Bench)


def _found(name: str) -> tuple[Bench, str]:
    bench, _, key = name.partition("/")
    found = benches()[bench]
    return found, known_name(f"example of the bench {bench!r}", key, found.examples)


def page_of(name: str) -> str:
    """Return the key of the page to which an example belongs; `UnknownName` as of `choosing`."""
    bench, _ = _found(name)
    module = benches().origin[bench.key]
    return next(key for key, page in pages().items() if module.startswith(f"{page.package}."))


def choosing(name: str) -> Command:
    """Return the command that puts an example in place.

    Raises
    ------
    UnknownName
        There is no such bench, or no such example of it; the text lists those there are.
    """
    bench, key = _found(name)
    return bench.choose(key)


def robot_of(name: str) -> str:
    """Return the key of the arm that an example brings; empty where it brings none.

    Raises
    ------
    UnknownName
        As of `choosing`.
    """
    bench, key = _found(name)
    return str(getattr(bench.examples[key], "robot", ""))


@dataclass(frozen=True)
class PutInPlace(Command):
    """Put an example of a bench in place, by its name in lessons."""

    name: str
    label: ClassVar[str] = "example"

    def apply(self, state: State) -> State:
        """Return the state with the example; `UnknownName` when there is no such example."""
        return choosing(self.name).apply(state)


def with_example(state: State, name: str, robot: str) -> State:
    """Return the state with an example in place, on the arm that is there.

    Raises
    ------
    UnknownName
        As of `choosing`.
    InputError
        It is of another arm.
    """
    refuse_other_arm(name, robot)
    return choosing(name).apply(state)


def refuse_other_arm(name: str, robot: str) -> None:
    """Raise `InputError` when an example uses another arm than this; `UnknownName` when there is no such example."""
    brought = robot_of(name)
    if brought not in ("", robot):
        raise InputError(f"the example {name!r} is of the arm {brought!r}, not {robot!r}; write robot = {brought!r}")
