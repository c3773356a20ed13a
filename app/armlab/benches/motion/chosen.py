"""A chosen kind of path or law with its options, as it is held in the state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, Self

import numpy as np

from armlab.errors import InputError
from armlab.kin.field import Field, seen_fields
from armlab.registry import known_name
from armlab.session.state import Json

Value = Any
"""Value of an option: a number, a truth value, a text, or numbers in tuples or rows."""


class Kind(Protocol):
    """A type with options: `armlab.kin.motion.PathType`, `armlab.kin.motion.LawType`."""

    @property
    def fields(self) -> tuple[Field, ...]:
        """The options of this kind."""


@dataclass(frozen=True)
class Chosen:
    """A kind by its key, with those options that are not at their defaults.

    Attributes
    ----------
    key : str
    given : tuple of (str, value)
        Options in the order of their keys; lists and tables are tuples.
    """

    key: str
    given: tuple[tuple[str, Value], ...] = ()

    @classmethod
    def of(cls, kinds: Mapping[str, Kind], key: str, **options: Value) -> Self:
        """Return a choice with options.

        Raises
        ------
        InputError
            No such kind or option, or a wrong value.
        """
        known_name("kind", key, kinds)
        chosen = cls(key)
        for name, value in options.items():
            chosen = chosen._set(kinds[key], name, value)
        return chosen

    @property
    def options(self) -> dict[str, Value]:
        """The options by key, as makers of paths and laws take them."""
        return dict(self.given)

    def with_option(self, kind: Kind, name: str, value: Value) -> Self:
        """Return the choice with one option set; None restores its default.

        Those given before that cannot be used with it fall, and those that would be in another unit.

        Raises
        ------
        InputError
            No such option, or a wrong value.
        """
        changed = self._set(kind, name, value)
        before, after = (_seen(kind, each) for each in (self, changed))
        kept = tuple(
            (key, given)
            for key, given in changed.given
            if key == name or (key in after and (key not in before or before[key].unit == after[key].unit))
        )
        return type(self)(self.key, kept)

    def _set(self, kind: Kind, name: str, value: Value) -> Self:
        """Return the choice with one option set, even if the others do not allow it."""
        known = {field.key: field for field in kind.fields}
        known_name(f"option of {self.key}", name, known)
        others = {key: given for key, given in self.given if key != name}
        if value is not None:
            others[name] = _frozen(known[name].checked(value))
        return type(self)(self.key, tuple(sorted(others.items())))

    def to_json(self) -> Json:
        """Return kind and options as JSON."""
        return {"key": self.key, **({"options": self.options} if self.given else {})}

    @classmethod
    def from_json(cls, data: Json, kinds: Mapping[str, Kind]) -> Self:
        """Return the choice in JSON data; `InputError` when it is not usable."""
        if not isinstance(data, dict) or not isinstance(data.get("key"), str):
            raise InputError(f"kind: expected a key and options, got {str(data)[:60]}")
        key, options = data["key"], data.get("options", {})
        renamed = {field.was: field.key for field in kinds[key].fields if field.was} if key in kinds else {}
        return cls.of(kinds, key, **{renamed.get(name, name): value for name, value in options.items()})


def _seen(kind: Kind, chosen: Chosen) -> dict[str, Field]:
    return {field.key: field for field in seen_fields(kind.fields, chosen.options)}


def _frozen(value: Value) -> Value:
    """Return lists and arrays as tuples, since a state is never changed in place."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return tuple(_frozen(each) for each in value) if isinstance(value, list) else value
