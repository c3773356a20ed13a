"""The palette. Colour carries meaning, but never alone; values are sRGB, 0 to 255."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Rgb = tuple[int, int, int]

BLUE: Rgb = (0, 114, 178)
ORANGE: Rgb = (230, 159, 0)
GREEN: Rgb = (0, 158, 115)
PURPLE: Rgb = (204, 121, 167)
SKY: Rgb = (86, 180, 233)
VERMILLION: Rgb = (213, 94, 0)
YELLOW: Rgb = (240, 228, 66)

JOINTS: tuple[Rgb, ...] = (BLUE, ORANGE, GREEN, PURPLE, SKY, VERMILLION, YELLOW)
"""Colours of the joints in order (Okabe and Ito, distinct also for the colour-blind); they repeat after seven."""

AXES: dict[str, Rgb] = {"x": (213, 66, 30), "y": GREEN, "z": BLUE}

GREY: Rgb = (128, 137, 150)

INK: dict[bool, Rgb] = {False: (52, 60, 72), True: (205, 212, 222)}
AXIS_INK: dict[bool, Rgb] = {False: (84, 93, 106), True: (205, 212, 222)}
FINE_INK: dict[bool, Rgb] = {False: (92, 102, 116), True: (168, 178, 192)}
"""Colours of lines without a meaning of colour, by whether the theme is dark: plain ones, joint axes, auxiliary
ones."""

VERDICT: dict[str, Rgb] = {"ok": (0, 115, 90), "warn": (184, 120, 0), "no": (196, 60, 10)}


def joint_colour(i: int) -> Rgb:
    """Return the colour of joint i (0-based)."""
    return JOINTS[i % len(JOINTS)]


def css(rgb: Rgb) -> str:
    """Return the colour in CSS, ``rgb(r,g,b)``."""
    return f"rgb({rgb[0]},{rgb[1]},{rgb[2]})"


def line_colour(rgb: Rgb) -> Rgb:
    """Return the colour to give to arrows, and to lines coloured point by point, so that this colour is seen.

    The page takes these as linear light; a line of one colour, as everything else, it takes as it is.
    """
    r, g, b = (round(255.0 * float(value)) for value in linear(rgb))
    return r, g, b


def linear(rgb: ArrayLike) -> NDArray[np.float64]:
    """Return linear light, 0 to 1, for GLB materials and viser's line segments."""
    c = np.asarray(rgb, dtype=float) / 255.0
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


_VIRIDIS = np.array(
    [
        (68, 1, 84), (72, 40, 120), (62, 74, 137), (49, 104, 142), (38, 130, 142),
        (31, 158, 137), (53, 183, 121), (109, 205, 89), (180, 222, 44), (253, 231, 37),
    ],
    dtype=float,
)  # fmt: skip
"""Colours in equal steps of lightness, also for the colour-blind and in grey (van der Walt and Smith, 2015)."""


def viridis(parts: ArrayLike) -> NDArray[np.uint8]:
    """Return the colours (..., 3) of numbers from 0, dark, to 1, bright; numbers outside are clipped."""
    at = np.clip(np.asarray(parts, dtype=float), 0.0, 1.0) * (len(_VIRIDIS) - 1)
    steps = np.arange(len(_VIRIDIS))
    return np.stack([np.interp(at, steps, _VIRIDIS[:, k]) for k in range(3)], axis=-1).round().astype(np.uint8)


VIRIDIS_CSS = f"linear-gradient(90deg, {', '.join(css((round(r), round(g), round(b))) for r, g, b in _VIRIDIS)})"
"""The same colours from left to right, as CSS."""


RUN_COLOURS: tuple[Rgb, ...] = (BLUE, VERMILLION, GREEN, PURPLE)
"""Colours of runs, by `Run.colour`."""
