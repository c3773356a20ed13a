"""Waypoints and their times, checked; messages give the number of the waypoint, counted from 1."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong
from armlab.kin.field import Field

Floats = NDArray[np.float64]

SAME = 1e-9
"""Distance, relative to the largest coordinate, below which two waypoints are the same: a path as short as that has no
direction that could be told from rounding, so that a corner there would not be seen."""

UNTIMED = (("times", (None,)),)
"""Condition for options on how time is divided: they are used only when no times are given."""

TIMES = (
    Field("times", "t_k", "times of the waypoints; left out: by the way below", "list", unit="s"),
    Field(
        "duration",
        "T",
        "time for all, when no times are given",
        "number",
        1.0,
        low=0.0,
        above=True,
        unit="s",
        only=UNTIMED,
    ),
    Field(
        "spacing",
        "",
        "how the time is shared out",
        "choice",
        "chord",
        choices=(("chord", "by distance"), ("centripetal", "by the root of distance"), ("uniform", "evenly")),
        only=UNTIMED,
    ),
)
"""Options of a path whose waypoints have times."""


def checked_knots(knots: ArrayLike, title: str, least: int, most: int | None, apart: bool) -> Floats:
    """Return waypoints (N, m); see `armlab.kin.motion.path_types.PathType.path`."""
    points = _numbers(knots)
    count = len(points)
    if count < least or (most is not None and count > most):
        number = f"exactly {least}" if most == least else f"at least {least}" if most is None else f"{least} to {most}"
        raise InputError(f"waypoints: {title} takes {number}, got {count}")
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(bad):
        raise InputError(f"waypoint {bad[0] + 1}: expected finite numbers, got {points[bad[0]].tolist()}")
    if apart:
        refuse_same(points)
    return points


def _numbers(knots: ArrayLike) -> Floats:
    try:
        points = np.array(knots, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise _culprit(knots) from None
    if points.ndim == 1:
        points = points[:, None]
    if points.ndim != 2 or points.shape[1] == 0:
        raise wrong("waypoints", "a list of points, each a list of as many numbers", knots)
    return points


def _culprit(knots: Any) -> InputError:
    """Return the error for the waypoint that has another form than the first."""
    try:
        rows = list(knots)
        width = np.shape(np.array(rows[0], dtype=float))
    except (TypeError, ValueError, IndexError):
        return wrong("waypoint 1", "numbers", knots)
    for k, row in enumerate(rows):
        try:
            fits = np.shape(np.array(row, dtype=float)) == width
        except (TypeError, ValueError, OverflowError):
            fits = False
        if not fits:
            numbers = f"{width[0]} numbers as in waypoint 1" if width else "a number as waypoint 1"
            return wrong(f"waypoint {k + 1}", numbers, row)
    return wrong("waypoints", "points of as many numbers each", knots)


def refuse_same(points: Floats) -> None:
    """Raise `InputError` when two neighbouring waypoints are the same."""
    steps = np.abs(np.diff(points, axis=0)).max(axis=1)
    same = np.flatnonzero(steps <= SAME * np.abs(points).max())
    if len(same):
        k = int(same[0]) + 1
        raise InputError(f"waypoint {k + 1}: the same as waypoint {k}; move or remove one of them")


def knot_times(points: Floats, options: dict[str, Any]) -> Floats:
    """Return the times of waypoints (N,) from the options `TIMES`.

    Raises
    ------
    InputError
        Not as many as waypoints, not increasing (the text names the waypoint), or two waypoints the same where the
        time is shared out by distance.
    """
    times, count = options["times"], len(points)
    if times is not None:
        return checked_times(times, count)
    spacing, duration = options["spacing"], options["duration"]
    if spacing == "uniform":
        steps = np.ones(count - 1)
    else:
        refuse_same(points)
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1) ** (1.0 if spacing == "chord" else 0.5)
    shares = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(duration * shares / shares[-1])


def checked_times(times: ArrayLike, count: int, where: str = "times") -> Floats:
    """Return increasing times (N,), one for each waypoint, seconds; `InputError` names the waypoint."""
    values = as_floats(times, where, f"{count} numbers")
    if values.shape != (count,):
        raise InputError(f"{where}: expected {count}, one for each waypoint, got {values.size}")
    steps = np.diff(values)
    late = np.flatnonzero(~(steps > 0.0))
    if len(late):
        k = int(late[0]) + 2
        raise InputError(
            f"waypoint {k}: its time {values[k - 1]:g} s must be later than the {values[k - 2]:g} s of waypoint {k - 1}"
        )
    return values
