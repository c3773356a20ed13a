"""Declared fields of parts as arguments of a command in files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.session.arguments import Argument, Kind, kind_of, one_of
from armlab.session.fields import EXAMPLE, FieldPart, Own, declarations, setting
from armlab.session.state import Command, State

KINDS: dict[str, Any] = {
    "number": float,
    "whole": int,
    "flag": bool,
    "text": str,
    "vector": tuple[float, ...],
    "own": Any,
}
"""Type of the argument for each kind of field."""


def field_arguments(part: type[FieldPart]) -> tuple[Argument, ...]:
    """Return the fields of a part as arguments, all optional. The field for the example cannot be set."""
    specs = (each.spec for each in declarations(part).values())
    found = ((field, _kind(field)) for field in specs if field.key != EXAMPLE)
    return tuple(
        Argument(field.key, kind, False, _about(field), field if isinstance(field, Field) else None)
        for field, kind in found
        if kind is not None
    )


def _kind(field: Field | Own) -> Kind | None:
    if isinstance(field, Field) and field.kind == "choice":
        return one_of(tuple(key for key, _ in field.choices))
    return kind_of(KINDS[field.kind]) if field.kind in KINDS else None


def _about(field: Field | Own) -> str:
    unit = field.unit if isinstance(field, Field) else ""
    return field.title if unit in ("", "1") else f"{field.title}, {unit}"


@dataclass(frozen=True)
class SetFields(Command):
    """Set some fields of a part at once.

    Parameters
    ----------
    part : type
    values : tuple of (str, object)
        Name and value of each.
    """

    part: type[FieldPart]
    values: tuple[tuple[str, Any], ...]

    @classmethod
    def of(cls, part: type[FieldPart], **values: Any) -> SetFields:
        """Return the command; `InputError` when there is nothing to set."""
        if not values:
            raise InputError(f"expected some of {', '.join(each.name for each in field_arguments(part))}")
        return cls(part, tuple(values.items()))

    @property
    def label(self) -> str:  # type: ignore[override]
        """The key of the part."""
        return self.part.key

    @property
    def undoable(self) -> bool:  # type: ignore[override]
        """Whether the command is a step of undo: not when only the view changes."""
        return not self.part.kept_by_undo and any(name not in self.part.looks for name, _ in self.values)

    def apply(self, state: State) -> State:
        """Return the state with the fields set, and without an example in place."""
        return setting(state, self.part, dict(self.values))
