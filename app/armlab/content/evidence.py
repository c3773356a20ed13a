"""Reading of evidence, data from a file that anyone may have changed: each function returns valid data or raises."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.checks import wrong
from armlab.kin.transforms import as_pose

LONGEST_NAME, MOST_NAMES = 64, 200
"""Longest name of a switch, panel or film in evidence, in characters, and largest number of names."""

LARGEST = 1e6
"""Largest magnitude of a number in evidence, in m, rad or s."""


def mapping(data: object, where: str, keys: tuple[str, ...], optional: tuple[str, ...] = ()) -> Mapping[str, Any]:
    """Return a table that has all keys, and no others except some of the optional ones."""
    if not isinstance(data, dict) or not set(keys) <= set(data) <= {*keys, *optional}:
        raise wrong(where, f"exactly the fields {', '.join(keys)}", data)
    return data


def number(value: object, where: str) -> float:
    """Return a finite number that is not too large."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= LARGEST:
        raise wrong(where, f"a number up to {LARGEST:g}", value)
    return float(value)


def numbers(value: object, where: str, count: int) -> NDArray[np.float64]:
    """Return ``count`` numbers, shape (count,)."""
    if not isinstance(value, list) or len(value) != count:
        raise wrong(where, f"{count} numbers", value)
    return np.array([number(entry, where) for entry in value])


def matrix(value: object, where: str, shape: tuple[int, int]) -> NDArray[np.float64]:
    """Return a list of rows as an array of that shape."""
    if not isinstance(value, list) or len(value) != shape[0]:
        raise wrong(where, f"{shape[0]} rows", value)
    return np.array([numbers(row, where, shape[1]) for row in value])


def pose(value: object, where: str) -> NDArray[np.float64]:
    """Return a pose, shape (4, 4)."""
    return as_pose(matrix(value, where, (4, 4)), where)


def truth(value: object, where: str) -> bool:
    """Return true or false."""
    if not isinstance(value, bool):
        raise wrong(where, "true or false", value)
    return value


def names(value: object, where: str) -> frozenset[str]:
    """Return a list of names as a set."""
    if not isinstance(value, list) or len(value) > MOST_NAMES:
        raise wrong(where, f"a list of at most {MOST_NAMES} names", value)
    return frozenset(name(entry, where) for entry in value)


def name(value: object, where: str) -> str:
    """Return a short text."""
    if not isinstance(value, str) or len(value) > LONGEST_NAME:
        raise wrong(where, f"a name of at most {LONGEST_NAME} characters", value)
    return value
