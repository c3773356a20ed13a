"""The motion that playback is measured with: joint 1 tells the time, the others swing."""

import numpy as np
from numpy.typing import NDArray

SPEED = 0.08
"""Of joint 1, rad/s."""

LENGTH, RATE = 40.0, 20.0
"""Seconds, and samples a second."""


def moved(time: float, joints: int = 6) -> NDArray[np.float64]:
    """Return the joints at a time, rad."""
    swing = 0.6 * np.sin((0.5 + 0.1 * np.arange(joints)) * time + np.arange(joints))
    swing[0] = SPEED * time - 1.6
    return swing


def table() -> str:
    """Return the motion as a table of joint samples, as the lab reads it."""
    rows = [[time, *moved(time)] for time in np.arange(0.0, LENGTH, 1.0 / RATE)]
    head = ["time_s", *(f"q{i + 1}_rad" for i in range(6))]
    return "\n".join([",".join(head), *(",".join(f"{value:.6f}" for value in row) for row in rows)])
