"""The approximate memory of a part of the state, by which undo is limited."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from typing import Any

import numpy as np

from armlab.kin.arm import Arm
from armlab.session.state import Part

OBJECT = 64
"""Size in bytes of a number, a name, or the shell of a container."""

ARM = 50_000
"""Size in bytes of an arm with its compiled formulas, measured over some hundred edits of a table."""

MOST_LOOKED_AT = 100_000
"""Largest number of objects that are counted; a part with more counts as heavy."""


def weight(parts: Iterable[Part], shared: Iterable[object] = ()) -> int:
    """Return the size of parts in bytes, without derived results and without anything that others hold as well.

    Parameters
    ----------
    parts : iterable of Part
    shared : iterable of object
        Objects that are not counted when the parts refer to them, such as the arm.
    """
    total, seen, waiting = 0, {id(value) for value in shared}, list[Any](parts)
    while waiting and len(seen) < MOST_LOOKED_AT:
        value = waiting.pop()
        if id(value) in seen:
            continue
        seen.add(id(value))
        total += OBJECT
        if isinstance(value, np.ndarray):
            total += int(value.nbytes)
        elif isinstance(value, (str, bytes)):
            total += len(value)
        elif isinstance(value, Arm):
            total += ARM
        elif isinstance(value, Mapping):
            waiting += [*value.keys(), *value.values()]
        elif isinstance(value, (tuple, list, set, frozenset)):
            waiting += value
        elif is_dataclass(value) and not isinstance(value, type):
            waiting += [getattr(value, field.name) for field in fields(value)]
    return total


def forget_derived(part: Part) -> None:
    """Forget results computed from a part; they are computed again when needed."""
    for name in [name for name in vars(part) if isinstance(getattr(type(part), name, None), cached_property)]:
        vars(part).pop(name, None)
