"""The disk of an incremental encoder: its tracks unrolled, and as a solid."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.absolute.ui.strip import Track, Window, below_tracks, tracks_markup
from armlab.benches.sensor.absolute.ui.wheel import disk_glb, radii
from armlab.benches.sensor.incremental.counting import quarter_at
from armlab.benches.sensor.incremental.state import Incremental
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import levels_of
from armlab.ui import svg
from armlab.ui.html import Markup

Floats = NDArray[np.float64]

PERIODS = 4
"""Largest number of periods that are seen in the strip."""

FINEST = 400
"""Largest number of periods whose windows are drawn one by one on the disk."""

NAMES = ("A", "B", "Z")
"""Tracks from the outermost one, as they stand in the strip from the top."""

DARK = {"A": (3, 5), "B": (0, 2)}
"""Quarters of a period in which the tracks let no light through: begin and end."""


def window_of(part: Incremental) -> Window:
    """Return what is seen of the tracks."""
    return Window(min(PERIODS, part.pulses) * TURN / part.pulses)


def seen(part: Incremental, angle: float) -> tuple[bool, bool, bool]:
    """Return whether A, B and Z see light at an angle."""
    quarter = quarter_at(part, angle)
    a, b = levels_of(quarter).tolist()
    return bool(a), bool(b), quarter % (4 * part.pulses) == 0


def strip(part: Incremental, angle: float) -> Markup:
    """Return the picture of the tracks around the sensors."""
    window, lit = window_of(part), seen(part, angle)
    tracks = [Track(name, _dark(part, name, angle, window), 0.0, on) for name, on in zip(NAMES, lit, strict=True)]
    levels = ", ".join(f"{name} {'high' if on else 'low'}" for name, on in zip(NAMES, lit, strict=True))
    return tracks_markup(tracks, window, f"Tracks around the sensors: {levels}", _periods(part, angle, window))


def _quarters(part: Incremental, angle: float, window: Window) -> tuple[float, int, int]:
    """Return the angle of a quarter, and the first and the last one in the picture."""
    quarter = TURN / (4 * part.pulses)
    return quarter, math.floor((angle - window.half) / quarter), math.ceil((angle + window.half) / quarter)


def _dark(part: Incremental, name: str, angle: float, window: Window) -> list[tuple[float, float]]:
    quarter, first, last = _quarters(part, angle, window)
    if name == "Z":
        turn = 4 * part.pulses
        turns = range(math.floor(first / turn) - 1, math.floor(last / turn) + 1)
        # All but one quarter of a turn.
        return [(quarter * (k * turn + 1) - angle, quarter * (k + 1) * turn - angle) for k in turns]
    begin, end = DARK[name]
    periods = range(math.floor(first / 4) - 1, math.floor(last / 4) + 1)
    return [(quarter * (4 * k + begin) - angle, quarter * (4 * k + end) - angle) for k in periods]


def _periods(part: Incremental, angle: float, window: Window) -> list[Markup]:
    """Return marks of electrical angle below the tracks: whole periods, with their numbers."""
    quarter, first, last = _quarters(part, angle, window)
    y, found = below_tracks(len(NAMES)), []
    for k in range(math.floor(first / 4), math.ceil(last / 4) + 1):
        at = 4 * k * quarter - angle
        if abs(at) < 0.97 * window.half:
            found.append(svg.text("ab-number", window.x(at), y, str(k % part.pulses), "middle"))
    return found


def arcs(pulses: int) -> Floats:
    """Return the dark pieces of the disk, or whole dark tracks where its periods are too fine; see `plates`."""
    (z_low, z_high), (b_low, b_high), (a_low, a_high) = radii(len(NAMES)).tolist()
    quarter = TURN / (4 * pulses)
    z = [[quarter, TURN, z_low, z_high]]
    if pulses > FINEST:
        return np.array([[0.0, TURN, a_low, a_high], [0.0, TURN, b_low, b_high], *z])
    period = 4.0 * np.arange(pulses)[:, None]
    found = [
        np.concatenate([quarter * (period + DARK[name]), np.tile([low, high], (pulses, 1))], axis=1)
        for name, low, high in (("A", a_low, a_high), ("B", b_low, b_high))
    ]
    return np.concatenate([*found, z])


@lru_cache(maxsize=12)
def incremental_glb(pulses: int) -> bytes:
    """Return the disk."""
    return disk_glb(arcs(pulses), len(NAMES))
