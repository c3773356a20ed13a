"""Arguments of commands in files: read by their type annotations, with sentences on mistakes."""

from __future__ import annotations

import dataclasses
import math
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from armlab.content.reader import Table, shown
from armlab.content.robots import read_pose
from armlab.errors import ContentError, InputError, suggestion
from armlab.kin.field import Field
from armlab.kin.task import Task, task_named

FACTORS = {"_deg": math.pi / 180.0, "_mm": 1e-3}
"""Factors of suffixes of argument names, by which a number may be given in degrees or millimetres."""


class Unfit(Exception):
    """A value does not fit an argument; the text says what was expected."""


@dataclass(frozen=True)
class Kind:
    """The form of an argument in a file.

    Attributes
    ----------
    says : str
        The expected value in words, such as ``"a whole number"``.
    read : callable
        ``read(value) -> object``; raises `Unfit`.
    numbers : bool
        Whether it may be written in degrees or millimetres.
    optional : bool
        Whether it may be left out although it has no default: it is None then.
    """

    says: str
    read: Callable[[Any], Any]
    numbers: bool = False
    optional: bool = False


@dataclass(frozen=True)
class Argument:
    """One argument of a command.

    Attributes
    ----------
    name : str
    kind : Kind
    needed : bool
        Whether it has to be there.
    about : str
        Meaning and unit, where they are declared.
    field : Field, optional
        The declared field that it sets.
    """

    name: str
    kind: Kind
    needed: bool
    about: str = ""
    field: Field | None = None


def arguments_of(command: type) -> tuple[Argument, ...] | None:
    """Return the arguments of a command that can be written in a file; None for one whose arguments cannot.

    The following can be written: texts, numbers, true or false, one of some words, lists and tables of these, poses.
    """
    hints = get_type_hints(command)
    found = []
    for field in dataclasses.fields(command):
        kind = kind_of(hints[field.name])
        if kind is None:
            return None
        found.append(Argument(field.name, kind, not kind.optional and not _has_default(field)))
    return tuple(found)


def _has_default(field: dataclasses.Field[Any]) -> bool:
    return field.default is not dataclasses.MISSING or field.default_factory is not dataclasses.MISSING


def read_arguments(known: tuple[Argument, ...], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by the names of arguments; those that are left out and have a default are not there.

    Raises
    ------
    WrongArgument
    """
    keys = {one.name: [one.name, *(one.name + unit for unit in FACTORS if one.kind.numbers)] for one in known}
    for key in given:
        if key not in {each for names in keys.values() for each in names}:
            raise WrongArgument(key, f"unknown argument{suggestion(key, keys)}")
    found = {}
    for argument in known:
        there = [key for key in keys[argument.name] if key in given]
        if len(there) > 1:
            raise WrongArgument(there[1], f"expected one of {' and '.join(there)}")
        if there:
            found[argument.name] = _read(argument, there[0], given[there[0]])
        elif argument.needed:
            raise WrongArgument(argument.name, f"missing; expected {listed(known)}")
        elif argument.kind.optional:
            found[argument.name] = None
    return found


class WrongArgument(Exception):
    """A wrong argument: its key in the file, and the problem."""

    def __init__(self, key: str, problem: str) -> None:
        super().__init__(f"{key}: {problem}")
        self.key, self.problem = key, problem


def listed(known: tuple[Argument, ...]) -> str:
    """Return arguments in words: ``kind (a text), axis (a whole number)``."""
    return ", ".join(f"{one.name} ({one.kind.says}{'' if one.needed else ', or left out'})" for one in known) or "none"


def _read(argument: Argument, key: str, value: Any) -> Any:
    try:
        read = argument.kind.read(value)
        return read if key == argument.name else _scaled(read, FACTORS[key.removeprefix(argument.name)])
    except Unfit as error:
        raise WrongArgument(key, f"expected {error}, got {shown(value)}") from None


def _scaled(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        return tuple(_scaled(each, factor) for each in value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Unfit("a number or a list of numbers")
    return value * factor


def kind_of(hint: Any) -> Kind | None:
    """Return how a value of a type is written; None if it cannot be written."""
    if hint in _PLAIN:
        return _PLAIN[hint]
    origin, inside = _origin(hint), get_args(hint)
    if origin is Literal:
        return one_of(inside)
    if origin in (Union, types.UnionType):
        return _optional(inside)
    if origin is tuple:
        return _tuple(inside)
    if origin is np.ndarray:
        return Kind("a pose: four rows, or a table of position and rpy_deg", _pose)
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return _table(hint)
    return None


def _origin(hint: Any) -> Any:
    """Return what a type is one of; ``NDArray`` is an alias of its own kind since NumPy 2.5."""
    origin = get_origin(hint)
    return get_origin(getattr(origin, "__value__", None)) or origin


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise Unfit("a text")
    return value


def _truth(value: Any) -> bool:
    if not isinstance(value, bool):
        raise Unfit("true or false")
    return value


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < 1e300:
        raise Unfit("a finite number")
    return float(value)


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or value != value // 1 or abs(value) > 2**53:
        raise Unfit("a whole number")
    return int(value)


def _anything(value: Any) -> Any:
    """Return a text, a number or a truth value unchanged, and a list of these as a tuple."""
    if isinstance(value, list):
        return tuple(_anything(each) for each in value)
    if not isinstance(value, (str, bool, int, float)):
        raise Unfit("a text, a number, true or false, or a list of these")
    return value if isinstance(value, (str, bool, int)) else _number(value)


def _task(value: Any) -> Task:
    try:
        return task_named(_text(value))
    except InputError as error:
        raise Unfit(f"the name of a task ({error})") from None


def _pose(value: Any) -> Any:
    try:
        if isinstance(value, dict):
            return read_pose(Table("", value))
    except ContentError as error:
        raise Unfit(f"a pose ({error.key}: {error.problem})") from None
    rows = value if isinstance(value, list) else []
    if [len(row) if isinstance(row, list) else 0 for row in rows] != [4, 4, 4, 4]:
        raise Unfit("four rows of four numbers, or a table of position and rpy_deg")
    return np.array([[_number(entry) for entry in row] for row in rows])


TEXT = Kind("a text", _text)

_PLAIN: dict[Any, Kind] = {
    str: TEXT,
    bool: Kind("true or false", _truth),
    int: Kind("a whole number", _whole),
    float: Kind("a number", _number, numbers=True),
    Any: Kind("a text, a number, or true or false", _anything, numbers=True),
    Task: Kind("the name of a task", _task),
}


def one_of(words: tuple[Any, ...]) -> Kind:
    """Return the form of a choice among words or numbers; a word of digits may also be written as a number."""
    there = " or ".join(map(str, words))

    def read(value: Any) -> Any:
        wanted = str(value) if type(value) is int and value not in words else value
        if isinstance(value, bool) or wanted not in words:
            raise Unfit(there)
        return words[words.index(wanted)]

    return Kind(there, read)


def _optional(inside: tuple[Any, ...]) -> Kind | None:
    others = [each for each in inside if each is not type(None)]
    kind = kind_of(others[0]) if len(others) == 1 else _PLAIN[Any] if set(others) <= {str, bool, int, float} else None
    return None if kind is None else dataclasses.replace(kind, optional=type(None) in inside)


def _tuple(inside: tuple[Any, ...]) -> Kind | None:
    """Return the form of a list with one kind of entries, of any or a fixed length."""
    many = len(inside) == 2 and inside[1] is Ellipsis
    kinds = [kind_of(each) for each in (inside[:1] if many else inside)]
    if not kinds or any(kind is None for kind in kinds):
        return None
    parts = [kind for kind in kinds if kind is not None]
    alike = len({kind.says for kind in parts}) == 1
    bare = parts[0].says.removeprefix("a ").removeprefix("an ").replace("list of", "lists of")
    plural = bare if bare.startswith("lists") else f"{bare}s"
    says = f"a list of {'' if many else f'{len(parts)} '}{plural}"
    if not alike:
        says = f"a list of {' and '.join(kind.says for kind in parts)}"

    def read(value: Any) -> Any:
        if not isinstance(value, list) or (not many and len(value) != len(parts)):
            raise Unfit(says)
        try:
            return tuple((parts[0] if many else parts[i]).read(each) for i, each in enumerate(value))
        except Unfit:
            raise Unfit(says) from None

    return Kind(says, read, numbers=all(kind.numbers for kind in parts))


def _table(hint: type) -> Kind | None:
    """Return the form of a frozen dataclass: a table of its fields."""
    fields = arguments_of(hint)
    if fields is None:
        return None
    says = f"a table of {listed(fields)}"

    def read(value: Any) -> Any:
        if not isinstance(value, dict):
            raise Unfit(says)
        try:
            return hint(**read_arguments(fields, value))
        except WrongArgument as error:
            raise Unfit(f"{says}; {error}") from None

    return Kind(says, read)
