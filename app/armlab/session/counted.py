"""Numbers of components as commands count them, from 0: only authors of lessons and scripts write them."""

from __future__ import annotations

import numpy as np

from armlab.errors import InputError


def refuse_beyond(index: object, count: int, where: str) -> None:
    """Refuse what is no number from 0 to below ``count``.

    >>> refuse_beyond(3, 3, "component")
    Traceback (most recent call last):
    armlab.errors.InputError: component (counted from 0): expected 0 to 2, got 3
    """
    if isinstance(index, bool) or not isinstance(index, (int, np.integer)) or not 0 <= index < count:
        raise InputError(f"{where} (counted from 0): expected 0 to {count - 1}, got {index!r}")
