"""Words that benches add to lesson files, found by folder: kinds of actions, and live values as ``{{duration}}``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Protocol, TypeVar

from armlab.content.lesson_fields import Fields
from armlab.content.live_value import LiveValue
from armlab.content.robots import Robot
from armlab.errors import PluginError
from armlab.plugins import discover_in_benches

T = TypeVar("T")


class BenchAction(Protocol):
    """An action of a kind that a bench adds; `armlab.teaching.taught.Taught` tells which commands it is."""

    def says(self) -> str:
        """Return what is to be done, for the solution sheet."""
        ...


@dataclass(frozen=True)
class Vocabulary:
    """The constant ``VOCABULARY`` of the module ``vocabulary`` of a page, which imports what reading a lesson needs.

    Parameters
    ----------
    key : str
        That of the bench in observations; see `armlab.content.observation.Observation.benches`.
    actions : mapping of str to callable
        ``read(entry, robot)`` by the ``kind`` of an action of starts and solutions: takes its fields.
    plays : tuple of str
        Keys of clips that solutions play with a kind of that name, as ``film`` does with any.
    live : mapping of str to LiveValue
        Live values by name, which tell of the bench and need what it says of itself.
    """

    key: str
    actions: Mapping[str, Callable[[Fields, Robot], BenchAction]] = field(default_factory=lambda: MappingProxyType({}))
    plays: tuple[str, ...] = ()
    live: Mapping[str, LiveValue] = field(default_factory=lambda: MappingProxyType({}))


@cache
def vocabularies() -> dict[str, Vocabulary]:
    """Return the words of all benches by their keys."""
    return discover_in_benches("vocabulary", "VOCABULARY", Vocabulary)


def with_added(word: str, own: Mapping[str, T], added: Iterable[Mapping[str, T]]) -> dict[str, T]:
    """Return what there is by name together with what benches add; `PluginError` when a name comes twice.

    ``word`` says what has the name, such as ``"live value"``.
    """
    found = dict(own)
    for each in added:
        if twice := found.keys() & each.keys():
            raise PluginError(f"{word}: {min(twice)!r} comes twice; a bench adds one that is there")
        found.update(each)
    return found
