"""The reading of a written plan, with errors that name the place."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from armlab.benches.motion.plan.moves import MOST_WAYPOINTS, Move, Waypoint
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.state import Json

Read = TypeVar("Read")

DAMAGED = (TypeError, ValueError, KeyError, AttributeError, OverflowError)
"""Exceptions that a value of the wrong kind may raise."""

SHOWN = 30
"""Largest number of characters of such a value that are shown."""


def route_from(data: Json, arm: Arm) -> tuple[tuple[Waypoint, ...], tuple[Move, ...]]:
    """Return waypoints and moves.

    Raises
    ------
    InputError
        They are missing, too many, not as many as belong together, or one is not usable; the text names it.
    """
    if not isinstance(data, dict):
        raise InputError(f"plan: expected waypoints and moves by name, got {_shown(data)}")
    for name in ("waypoints", "moves"):
        if name not in data:
            raise InputError(f"plan: {name} are missing")
        if not isinstance(data[name], list):
            raise InputError(f"plan, {name}: expected a list, got {_shown(data[name])}")
    count, between = len(data["waypoints"]), len(data["moves"])
    if count > MOST_WAYPOINTS:
        raise InputError(too_many(f"{count}"))
    if not 1 <= count == between + 1:
        raise InputError(
            f"plan: expected 1 to {MOST_WAYPOINTS} waypoints and a move between each two, got {count} and {between}"
        )
    points = tuple(_waypoint(each, arm, k) for k, each in enumerate(data["waypoints"], start=1))
    return points, tuple(_move(each, k) for k, each in enumerate(data["moves"], start=1))


def too_many(count: str) -> str:
    """Return the error for a plan with too many waypoints."""
    return f"plan: it has {count} waypoints; at most {MOST_WAYPOINTS} are taken (a table may have more rows)"


def entry(data: Json, name: str, default: object, read: Callable[..., Read]) -> Read:
    """Return another entry of a plan, checked by ``read``; `InputError` if it is not usable."""
    value = data.get(name, default)
    try:
        return read(value)
    except InputError:
        raise
    except DAMAGED:
        raise InputError(f"plan, {name}: not usable: {_shown(value)}") from None


def _waypoint(data: Json, arm: Arm, k: int) -> Waypoint:
    """Return waypoint k (from 1)."""
    try:
        q = np.array(data["q"], dtype=float)
    except DAMAGED:
        q = np.zeros(0)
    if q.shape != (arm.n,) or not np.isfinite(q).all():
        raise InputError(f"waypoint {k}: expected {arm.n} finite joint values")
    try:
        return Waypoint.from_json(data, arm)
    except InputError as refusal:
        raise InputError(f"waypoint {k}: {refusal}") from None
    except DAMAGED:
        raise InputError(f"waypoint {k}, pose: expected 16 numbers") from None


def _move(data: Json, k: int) -> Move:
    """Return move k (from 1)."""
    try:
        return Move.from_json(data)
    except InputError as refusal:
        raise InputError(f"move {k}: {refusal}") from None
    except DAMAGED:
        raise InputError(f"move {k}: not usable: {_shown(data)}") from None


def _shown(data: Json) -> str:
    """Return a value as text, cut short."""
    return "nothing" if data is None else str(data)[:SHOWN]
