"""Parts with declared fields: checks, JSON, initial values and the command `Set` follow from the declarations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.checks import finite_floats
from armlab.kin.field import Field
from armlab.registry import known_name
from armlab.session.state import Command, Json, Part, State

Kept = Literal["", "edits", "joints", "always"]
"""Changes that a field survives: none, edits of the table (also joint by joint), or another arm as well."""

DECLARED = "declared"

Table = tuple[tuple[float, ...], ...]
EXAMPLE = "example"
"""Name of the field for the key of the example in place; it is cleared when another field is set."""


def number(
    symbol: str,
    title: str,
    default: float | None,
    low: float = -math.inf,
    high: float = math.inf,
    unit: str = "1",
    above: bool = False,
    kept: Kept = "always",
) -> Any:
    """Declare a number of a part, with the arguments of `Field`. If its default is None, it may be None."""
    return _declared(Field("", symbol, title, "number", default, low, high, above, unit), kept)


def whole(title: str, default: int | None, low: int, high: float = math.inf, kept: Kept = "always") -> Any:
    """Declare a whole number. If its default is None, it may be None."""
    return _declared(Field("", "", title, "whole", default, low, high), kept)


def flag(title: str, default: bool, kept: Kept = "always") -> Any:
    """Declare a truth value."""
    return _declared(Field("", "", title, "flag", default), kept)


def choice(title: str, default: Any, choices: Mapping[Any, str] | Sequence[Any], kept: Kept = "always") -> Any:
    """Declare a choice of a key; a mapping also gives the words for each."""
    words = choices if isinstance(choices, Mapping) else {key: key for key in choices}
    return _declared(Field("", "", title, "choice", default, choices=tuple(words.items())), kept)


def vector(
    symbol: str,
    title: str,
    default: tuple[float, ...] = (),
    low: float = -math.inf,
    high: float = math.inf,
    unit: str = "1",
    kept: Kept = "always",
) -> Any:
    """Declare a tuple of numbers, as many as in the initial part of an arm."""
    return _declared(Field("", symbol, title, "vector", default, low, high, unit=unit), kept)


def text(title: str, default: str = "", longest: int = 200, kept: Kept = "always", under: str = "") -> Any:
    """Declare a text, such as the key of an example."""
    return _declared(Field("", "", title, "text", default, high=longest), kept, under)


def some(title: str, default: Sequence[Any], choices: Sequence[Any], kept: Kept = "always") -> Any:
    """Declare a choice of several keys, a `frozenset`, saved in alphabetical order."""

    def read(data: Json) -> frozenset[str]:
        if isinstance(data, str) or not all(isinstance(each, str) for each in data):
            raise TypeError
        for key in data:
            known_name(title, key, choices)
        return frozenset(data)

    return own(title, frozenset(default), read, sorted, kept=kept)


def table(title: str, default: Table, low: float = -math.inf, high: float = math.inf, kept: Kept = "always") -> Any:
    """Declare a tuple of tuples of numbers, with the shape of the default."""
    shape = len(default), len(default[0])

    def read(data: Json) -> Table:
        values = finite_floats(data, title, shape, f"{shape[0]} rows of {shape[1]} finite numbers")
        if np.any(values < low) or np.any(values > high):
            raise InputError(f"{title}: expected numbers from {low:g} to {high:g}")
        return tuple(tuple(row) for row in values.tolist())

    return own(title, default, read, kept=kept)


def own(
    title: str,
    default: Any,
    read: Callable[[Json], Any],
    write: Callable[[Any], Json] | None = None,
    kept: Kept = "always",
    under: str = "",
    later: bool = False,
) -> Any:
    """Declare a field that is read, and written, in its own way.

    Parameters
    ----------
    title : str
    default : object
        Immutable.
    read : callable
        Returns the value of what was written; takes a value, too. Other errors that it raises are reported as one.
    write : callable, optional
        Tuples and arrays are lists by themselves.
    kept : str
    under : str
        Key of the JSON, where it is not the name of the field.
    later : bool
        Whether the part has had it only since later: it is written only while it has another value than the default,
        so that works saved before are written as they were.
    """
    return _declared(Own("", title, default, read, write or _plain), kept, under, later)


@dataclass(frozen=True)
class Own:
    """A field with its own form of saving; see `own`."""

    key: str
    title: str
    default: Any
    read: Callable[[Json], Any]
    write: Callable[[Any], Json]
    kind: ClassVar[str] = "own"

    def checked(self, value: Any) -> Any:
        """Return a value; `InputError` when it cannot be read."""
        try:
            return self.read(value)
        except InputError:
            raise
        except (TypeError, ValueError, KeyError, IndexError, AttributeError, OverflowError):
            raise InputError(f"{self.key}: not usable: {str(value)[:60]}") from None


@dataclass(frozen=True)
class Declared:
    """Declaration of a field: its kind, the changes it survives, its key in JSON, and whether it came later."""

    spec: Field | Own
    kept: Kept
    under: str
    later: bool = False

    def written(self, value: Any) -> Json:
        """Return a value as JSON."""
        return self.spec.write(value) if isinstance(self.spec, Own) else _plain(value)


def _declared(spec: Field | Own, kept: Kept, under: str = "", later: bool = False) -> Any:
    return dataclasses.field(default=spec.default, metadata={DECLARED: Declared(spec, kept, under, later)})


@dataclass(frozen=True, eq=False)
class FieldPart(Part):
    """A part that is written, read, checked, adapted and changed by the declarations of its fields.

    Subclasses are frozen dataclasses. Fields that are not declared here, such as the arm, are those of `initial`; what
    several fields must fulfil together is said in `check`. The order of the fields is that of the JSON.
    """

    clip: ClassVar[str] = ""
    """Key of the film of the part; if it is open, it starts again when a field is set."""

    leave_example: ClassVar[tuple[str, ...]] = (EXAMPLE,)
    """Fields that may be set while the example stays in place."""

    looks: ClassVar[tuple[str, ...]] = ()
    """Fields that only change what is drawn: they are no step of undo, and leave example and film alone."""

    bare: ClassVar[bool] = False
    """Whether the JSON form is the value of its only field, without a name."""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part with the declared defaults."""
        return cls()

    def check(self) -> None:
        """Raise `InputError` when the values cannot be used together, though each is valid."""

    def for_robot(self, robot: Robot) -> Self:
        """Return the part for another arm; only fields that are always kept keep their values."""
        return self._for(robot, ("always",), ())

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part for an edited table, with the kept fields, and with values of joints where these are now."""
        return self._for(robot, ("always", "edits"), origin)

    def _for(self, robot: Robot, kept: Sequence[Kept], origin: tuple[int | None, ...]) -> Self:
        new, declared = self.initial(robot), declarations(type(self))
        values = {name: getattr(self, name) for name, each in declared.items() if each.kept in kept}
        if origin:
            for name in (name for name, each in declared.items() if each.kept == "joints"):
                fresh, before = getattr(new, name), getattr(self, name)
                values[name] = tuple(fresh[i] if k is None else before[k] for i, k in enumerate(origin))
        try:
            found = new.with_values(values)
        except InputError:
            found = self.for_robot(robot) if origin else new
        # Changes are detected by asking whether it is the same object.
        every = [each.name for each in dataclasses.fields(found)]
        return self if all(_same(getattr(found, name), getattr(self, name)) for name in every) else found

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with some fields set; `UnknownName` or `InputError` when this is not possible."""
        declared = declarations(type(self))
        for name in values:
            if name not in declared:
                raise UnknownName(self.key, name, declared)
        part = replace(self, **{name: self._checked(declared[name].spec, value) for name, value in values.items()})
        part.check()
        return part

    def _checked(self, spec: Field | Own, value: Any) -> Any:
        found = spec.checked(value)
        if spec.kind != "vector":
            return found
        expected = len(getattr(self, spec.key))
        if len(found) != expected:
            raise InputError(f"{spec.key}: expected {expected} numbers, got {len(found)}")
        return tuple(found.tolist())

    def without_example(self) -> Self:
        """Return the part without an example in place, if it has a field for that."""
        kept = fields_of(type(self)).get(EXAMPLE)
        named = kept is not None and kept.kind == "text" and getattr(self, EXAMPLE)
        return replace(self, **{EXAMPLE: ""}) if named else self

    def to_json(self) -> Json:
        """Return the declared fields as JSON."""
        fields = ((each, getattr(self, name)) for name, each in declarations(type(self)).items())
        written = {
            each.under: each.written(value)
            for each, value in fields
            if not (each.later and _same(value, each.spec.default))
        }
        return next(iter(written.values())) if self.bare else written

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON, with defaults for missing fields; `InputError` when it is not usable."""
        if cls.bare:
            return cls.initial(robot).with_values(dict.fromkeys(declarations(cls), data))
        if not isinstance(data, dict):
            raise InputError(f"{cls.key}: expected fields by name, got {type(data).__name__}")
        given = {name: data[each.under] for name, each in declarations(cls).items() if each.under in data}
        return cls.initial(robot).with_values(given)


_DECLARED: dict[type[FieldPart], dict[str, Declared]] = {}
"""Cache of `declarations`."""


def declarations(part: type[FieldPart]) -> dict[str, Declared]:
    """Return the declarations of the fields of a part, by name."""
    if part not in _DECLARED:
        found = ((each.name, each.metadata[DECLARED]) for each in dataclasses.fields(part) if DECLARED in each.metadata)
        _DECLARED[part] = {
            name: replace(each, spec=replace(each.spec, key=name), under=each.under or name) for name, each in found
        }
    return _DECLARED[part]


def fields_of(part: type[FieldPart]) -> dict[str, Field]:
    """Return the fields of a part that can be shown in a form, by name."""
    found = ((name, each.spec) for name, each in declarations(part).items())
    return {name: spec for name, spec in found if isinstance(spec, Field)}


@dataclass(frozen=True)
class Set(Command):
    """Set one field of a part.

    Parameters
    ----------
    part : type
        A `FieldPart`.
    name : str
    value : object
    """

    part: type[FieldPart]
    name: str
    value: Any

    @property
    def label(self) -> str:  # type: ignore[override]
        """The title of the field."""
        declared = declarations(self.part).get(self.name)
        return declared.spec.title if declared else self.part.key

    @property
    def undoable(self) -> bool:  # type: ignore[override]
        """Whether the command is a step of undo: not when only the view changes."""
        return not self.part.kept_by_undo and self.name not in self.part.looks

    def apply(self, state: State) -> State:
        """Return the state with the field set, and without an example in place."""
        return setting(state, self.part, {self.name: self.value})


def setting(state: State, kind: type[FieldPart], values: Mapping[str, Any]) -> State:
    """Return the state with fields of a part set; when one changes, no example is in place any more."""
    part = state[kind]
    changed = part.with_values(values)
    others = [name for name in values if not _same(getattr(changed, name), getattr(part, name))]
    if set(others) <= set(part.looks):
        return state.replace(changed) if others else state
    return _begun(state, changed if set(others) <= {*part.leave_example, *part.looks} else changed.without_example())


def put(state: State, part: FieldPart) -> State:
    """Return the state with a part, and its film, if open, at the start; raises the errors of `FieldPart.check`."""
    part.check()
    return state if part == state[type(part)] else _begun(state, part)


def _begun(state: State, part: FieldPart) -> State:
    films = (each.rewound(part.clip) for each in state) if part.clip else ()
    return state.replace(*films, part)


def _same(one: Any, other: Any) -> bool:
    if one is other:
        return True
    arrays = isinstance(one, np.ndarray) or isinstance(other, np.ndarray)
    return np.array_equal(one, other) if arrays else bool(one == other)


def _plain(value: Any) -> Json:
    if isinstance(value, np.ndarray):
        return value.tolist()
    return [_plain(each) for each in value] if isinstance(value, tuple) else value
