"""Parts whose fields are declared once: checks, JSON, first values and the command that sets one follow from it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.field import Field
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, State

Kept = Literal["", "edits", "joints", "always"]
"""What a field survives: nothing, edits of the table, those joint by joint, also another arm."""

SPEC, KEPT = "spec", "kept"
EXAMPLE = "example"
"""Name of the text that holds the key of the example in place; empty as soon as another field is set."""


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
    """Declare a number of a part; see `Field` for what is said of it. One whose default is None may be None."""
    return _declared(Field("", symbol, title, "number", default, low, high, above, unit), kept)


def whole(title: str, default: int, low: int, high: float = math.inf, kept: Kept = "always") -> Any:
    """Declare a whole number."""
    return _declared(Field("", "", title, "whole", default, low, high), kept)


def flag(title: str, default: bool, kept: Kept = "always") -> Any:
    """Declare a truth value."""
    return _declared(Field("", "", title, "flag", default), kept)


def choice(title: str, default: str, choices: Mapping[Any, str] | Sequence[Any], kept: Kept = "always") -> Any:
    """Declare one of some keys; as a mapping with the words of each."""
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
    """Declare a tuple of numbers, as many as in the part an arm opens with."""
    return _declared(Field("", symbol, title, "vector", default, low, high, unit=unit), kept)


def text(title: str, default: str = "", longest: int = 200, kept: Kept = "always") -> Any:
    """Declare a text, such as the key of an example."""
    return _declared(Field("", "", title, "text", default, high=longest), kept)


def _declared(spec: Field, kept: Kept) -> Any:
    return dataclasses.field(default=spec.default, metadata={SPEC: spec, KEPT: kept})


@dataclass(frozen=True, eq=False)
class FieldPart(Part):
    """A part that is written, read, checked, adapted and changed by the declarations of its fields.

    Subclasses are frozen dataclasses. Fields that are not declared here, such as the arm, are those of `initial`; what
    several fields must fulfil together is said in `check`. The order of the fields is that of the JSON.
    """

    clip: ClassVar[str] = ""
    """Key of the film of the part; where it is on, it begins again as soon as a field is set."""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part with the values declared."""
        return cls()

    def check(self) -> None:
        """Raise `InputError` when the values, each fine by itself, cannot be used together."""

    def for_robot(self, robot: Robot) -> Self:
        """Return the part for another arm, with the fields that are kept always."""
        return self._for(robot, ("always",), ())

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part for an edited table, with the fields that are kept, and values of joints where these are."""
        return self._for(robot, ("always", "edits"), origin)

    def _for(self, robot: Robot, kept: Sequence[Kept], origin: tuple[int | None, ...]) -> Self:
        new, declared = self.initial(robot), declarations(type(self))
        values = {name: getattr(self, name) for name, (_, survives) in declared.items() if survives in kept}
        if origin:
            for name in (name for name, (_, survives) in declared.items() if survives == "joints"):
                fresh, before = getattr(new, name), getattr(self, name)
                values[name] = tuple(fresh[i] if k is None else before[k] for i, k in enumerate(origin))
        try:
            return new.with_values(values)
        except InputError:
            return new

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with some fields set; `UnknownName` or `InputError` when it cannot be."""
        declared = declarations(type(self))
        for name in values:
            if name not in declared:
                raise UnknownName(self.key, name, declared)
        part = replace(self, **{name: self._checked(declared[name][0], value) for name, value in values.items()})
        part.check()
        return part

    def _checked(self, spec: Field, value: Any) -> Any:
        found = spec.checked(value)
        if not isinstance(found, np.ndarray):
            return found
        expected = len(getattr(self, spec.key))
        if len(found) != expected:
            raise InputError(f"{spec.key}: expected {expected} numbers, got {len(found)}")
        return tuple(found.tolist())

    def to_json(self) -> Json:
        """Write the fields declared."""
        return {name: _plain(getattr(self, name)) for name in declarations(type(self))}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back; what is missing is as it opens. Raises `InputError` when it is not usable."""
        if not isinstance(data, dict):
            raise InputError(f"{cls.key}: expected fields by name, got {type(data).__name__}")
        return cls.initial(robot).with_values({name: data[name] for name in declarations(cls) if name in data})


_DECLARED: dict[type[FieldPart], dict[str, tuple[Field, Kept]]] = {}
"""What was looked up already."""


def declarations(part: type[FieldPart]) -> dict[str, tuple[Field, Kept]]:
    """Return what is declared of the fields of a part, by name."""
    if part in _DECLARED:
        return _DECLARED[part]
    found = ((each.name, each.metadata) for each in dataclasses.fields(part))
    _DECLARED[part] = {name: (replace(data[SPEC], key=name), data[KEPT]) for name, data in found if SPEC in data}
    return _DECLARED[part]


def fields_of(part: type[FieldPart]) -> dict[str, Field]:
    """Return the fields of a part, by name, as forms want them."""
    return {name: spec for name, (spec, _) in declarations(part).items()}


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
        spec = fields_of(self.part).get(self.name)
        return spec.title if spec else self.part.key

    @property
    def undoable(self) -> bool:  # type: ignore[override]
        """Whether the part is work, and not only what is being looked at."""
        return not self.part.kept_by_undo

    def apply(self, state: State) -> State:
        """Return the state with the field set, and no example in place any more."""
        part = state[self.part]
        changed = part.with_values({self.name: self.value})
        if getattr(changed, self.name) == getattr(part, self.name):
            return state
        example = fields_of(self.part).get(EXAMPLE)
        if example is not None and example.kind == "text" and self.name != EXAMPLE:
            changed = replace(changed, **{EXAMPLE: ""})
        return put(state, changed)


def put(state: State, part: FieldPart) -> State:
    """Return the state with a part, and its film, if it is on, at its beginning; raises what `FieldPart.check` does."""
    part.check()
    if part == state[type(part)]:
        return state
    timeline = state[Timeline]
    if part.clip and timeline.clip == part.clip:
        return state.replace(part, replace(timeline, time=0.0, playing=False))
    return state.replace(part)


def _plain(value: Any) -> Json:
    return [_plain(each) for each in value] if isinstance(value, tuple) else value
