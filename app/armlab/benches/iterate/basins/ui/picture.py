"""The map of basins as a picture: one pixel for each start, in the colour of its solution, darker after more steps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.iterate import Basins
from armlab.kin.ik.iterate.basins import FAILED, NOT_YET
from armlab.ui.colours import GREY, JOINTS, Rgb
from armlab.ui.png import indexed_png

FULL = len(JOINTS)
"""Number of solutions with a colour of their own; further ones are grey."""

LEVELS = 24
"""Number of levels of brightness."""

DARKEST = 0.32
"""Brightness of the slowest starts; the quickest have the full colour."""

SPREAD = (0.02, 0.98)
"""Quantiles of the numbers of steps at which the scale begins and ends."""

LEAST_SIDE = 512
"""Least number of pixels along a side of the picture that is saved."""


_EMPTY, _WHITE, _FIRST = 0, 1, 2
"""Entries of the palette: not yet computed (transparent), failed, and the first of the colours."""


def solution_colour(number: int) -> Rgb:
    """Return the colour of a solution (from 0), as in the list of solutions."""
    return JOINTS[number] if number < FULL else GREY


def scale_of(found: Basins) -> tuple[int, int]:
    """Return the numbers of steps at the bright and at the dark end; (0, 0) if nothing is reached."""
    counts = np.cumsum(np.bincount(found.iterations[found.index >= 0]))
    if not len(counts):
        return 0, 0
    low, high = (int(np.searchsorted(counts, part * counts[-1])) for part in SPREAD)
    return low, high


def pixels(found: Basins) -> NDArray[np.uint8]:
    """Return the entry of the palette for each start (rows, columns), the upper row first."""
    low, high = scale_of(found)
    # By tables: the picture is made between the events of those who drag.
    steps = np.arange(int(found.iterations.max()) + 1)
    part = np.clip((steps - low) / max(high - low, 1), 0.0, 1.0)
    shade = np.round(part * (LEVELS - 1)).astype(np.uint8)
    colours = np.minimum(np.arange(max(int(found.index.max()), FULL) + 1), FULL) * LEVELS + _FIRST
    # The last entries are those of the numbers -1 and -2.
    by_number = np.concatenate([colours, np.zeros(2)]).astype(np.uint8)
    by_number[FAILED], by_number[NOT_YET] = _WHITE, _EMPTY
    entries = by_number[found.index] + np.where(found.index >= 0, shade[found.iterations], np.uint8(0))
    return np.asarray(entries[::-1], dtype=np.uint8)


def palette() -> NDArray[np.uint8]:
    """Return the colours of the palette, (k, 3)."""
    brightness = np.linspace(1.0, DARKEST, LEVELS)
    colours = np.array([*JOINTS, GREY], dtype=float)
    shades = (colours[:, None, :] * brightness[None, :, None]).reshape(-1, 3)
    return np.concatenate([[[0, 0, 0], [255, 255, 255]], np.round(shades)]).astype(np.uint8)


def png(entries: NDArray[np.uint8]) -> bytes:
    """Return a picture of entries of the palette as a PNG file; its first entry is transparent."""
    return indexed_png(entries, palette())


def enlarged(entries: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the picture with each pixel repeated until its sides are long enough for a page."""
    times = -(-LEAST_SIDE // max(entries.shape))
    return np.repeat(np.repeat(entries, times, axis=0), times, axis=1)
