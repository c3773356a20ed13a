"""Things by name: what is found by folder, examples, and whatever else a person or a file chooses by a word."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Protocol, TypeVar, cast

from armlab.errors import PluginError, UnknownName


class Keyed(Protocol):
    """An entry of a registry."""

    @property
    def key(self) -> str:
        """A unique short name."""
        ...


K = TypeVar("K", bound=Keyed)
N = TypeVar("N", bound=str)


class Registry(dict[str, K]):
    """Things by their keys, in order: no key comes twice, and for one that is unknown a sentence lists those there are.

    Parameters
    ----------
    word : str
        What one of them is called in that sentence, such as ``"law"``.
    things : iterable
    origins : iterable of str, optional
        Where each of them comes from, for the sentence about a key that comes twice.

    Attributes
    ----------
    origin : dict of str to str
        Where each comes from, by key.

    Raises
    ------
    PluginError
        A key comes twice.

    Examples
    --------
    >>> from armlab.kin.motion import law_types
    >>> law_types()["cubik"]
    Traceback (most recent call last):
    armlab.errors.UnknownName: law: unknown name 'cubik'; did you mean 'cubic'? Available: ...
    """

    def __init__(self, word: str, things: Iterable[K], origins: Iterable[str] = ()) -> None:
        super().__init__()
        self.word: str = word
        self.origin: dict[str, str] = {}
        wheres = iter(origins)
        for thing in things:
            where = next(wheres, word)
            if thing.key in self:
                raise PluginError(f"{where}: the key {thing.key!r} is already used by {self.origin[thing.key]}")
            self[thing.key], self.origin[thing.key] = thing, where

    def __getitem__(self, key: object) -> K:
        """Return a thing by its key; `UnknownName` when there is none."""
        return super().__getitem__(known_name(self.word, key, self))


def known_name(word: str, name: object, names: Collection[N]) -> N:
    """Return a name that is one of those there are; `UnknownName` for any other, and for what is no text at all.

    Parameters
    ----------
    word : str
        What it names, for the sentence.
    name : object
    names : collection of str
    """
    if isinstance(name, str) and name in names:
        return cast(N, name)
    raise UnknownName(word, name, names)
