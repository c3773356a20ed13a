"""What another process computes: in a module that it can import, since functions are sent by name."""

from __future__ import annotations

from typing import Any

import numpy as np


def computed(arm: Any, q: Any, motion: Any, seen: Any) -> tuple[Any, ...]:
    """Return a pose, Jacobians, a place of a motion and what a section fills."""
    return arm.fk(q), arm.jacobian(np.tile(q, (5, 1))), motion.at([0.5]), float(seen.filled.sum())
