"""How much memory a part of the state holds, roughly: what undo keeps of one student has to end somewhere."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from typing import Any

import numpy as np

from armlab.kin.arm import Arm
from armlab.session.state import Part

OBJECT = 64
"""Bytes of a number, a name, or the shell of what holds others."""

ARM = 50_000
"""Bytes of an arm with its compiled formulas, measured over some hundred edits of a table."""

MOST_LOOKED_AT = 100_000
"""Objects that are looked at; a part with more is heavy, however much more."""


def weight(parts: Iterable[Part], shared: Iterable[object] = ()) -> int:
    """Return the bytes that parts hold, without what follows from them and without what others hold as well.

    Parameters
    ----------
    parts : iterable of Part
    shared : iterable of object
        What is left out where the parts refer to it, such as the arm.
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
    """Forget what was computed from a part; it is computed again where it is asked for."""
    for name in [name for name in vars(part) if isinstance(getattr(type(part), name, None), cached_property)]:
        vars(part).pop(name, None)
