"""The section as pixels, transparent where nothing is reached."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.ui import measured
from armlab.benches.workspace.section.found import Found
from armlab.ui.colours import SKY, viridis


def pixels(
    found: Found, reached: NDArray[np.bool_], values: NDArray[np.float64] | None, opacity: float = 1.0
) -> NDArray[np.uint8]:
    """Return red, green, blue and opacity (rows, columns, 4), the upper row first.

    Parameters
    ----------
    found : Found
        Whose scale of colours.
    reached : ndarray, shape (rows, columns)
        The lower row first.
    values : ndarray, shape (rows, columns), or None
        None for one colour.
    opacity : float
        Of what is reached.
    """
    picture = np.zeros((*reached.shape, 4), dtype=np.uint8)
    picture[..., :3] = SKY
    if values is not None:
        parts = measured.parts_of(found.colour, found.low, found.high, values)
        picture[..., :3] = viridis(np.nan_to_num(parts))
    picture[..., 3] = np.where(reached, round(255.0 * opacity), 0)
    return picture[::-1]
