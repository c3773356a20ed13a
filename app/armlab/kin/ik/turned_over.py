"""Targets whose tool is turned over, for arms that turn it only about z of frame 0.

Where a task controls the angle φ alone, the other two angles of a target are ignored up to a quarter turn: beyond that
the projections of the axes, from which φ is read, run the other way round.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.screws import screws_of
from armlab.kin.transforms import inverse

Floats = NDArray[np.float64]

TURNED_OVER = "in the target the tool is turned over, and this arm turns it only about z of frame 0"

ALONG = 1e-9
"""Largest component across z of a joint axis that counts as along z, and margin to a quarter turn."""


def is_turned_over(arm: Arm, T: Floats) -> bool:
    """Return whether no joint values reach a pose (4, 4) of the world because its tool is turned over."""
    row = _third_row(arm)
    if row is None:
        return False
    wanted = inverse(arm.base)[2, :3] @ T[:3, :3]
    return float(wanted @ row) < -ALONG


@lru_cache(maxsize=64)
def _third_row(arm: Arm) -> Floats | None:
    """Return the z components of the tool's axes (3,) in frame 0, where no joint changes them and φ counts; or None."""
    screws = screws_of(arm)
    across = screws.z[arm.revolute][:, :2]
    if arm.task.rotation != "phi" or not len(across) or float(np.abs(across).max()) > ALONG:
        return None
    return np.asarray(screws.home[2, :3], dtype=np.float64)
