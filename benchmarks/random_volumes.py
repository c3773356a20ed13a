"""Random arms of many kinds, for sizes of workspaces."""

import math
from collections.abc import Callable

import numpy as np

from armlab import Arm

Draw = Callable[[np.random.Generator], Arm]


def _turn(rng: np.random.Generator, least: float, most: float) -> list[float]:
    """Return the limits of a joint that turns by so much, anywhere."""
    span, middle = rng.uniform(least, most), rng.uniform(-math.pi, math.pi)
    return [middle - 0.5 * span, middle + 0.5 * span]


def _slide(rng: np.random.Generator) -> list[float]:
    low = rng.uniform(-0.2, 0.4)
    return [low, low + rng.uniform(0.2, 0.8)]


def _drawn(kinds: str, planar: bool, first: str, tight: float, rng: np.random.Generator) -> Arm:
    """Return an arm; ``first`` is "full" or "limited", ``tight`` how often one of the other joints is limited."""
    rows, limits = [], []
    for i, kind in enumerate(kinds):
        if planar:
            # A joint that slides does so in the plane: it stands between two quarter turns.
            after = i + 1 < len(kinds) and kinds[i + 1] == "P"
            alpha = {"R": -math.pi / 2 if after else 0.0, "P": math.pi / 2}[kind]
            rows.append((kind, 0.0 if kind == "P" else rng.uniform(0.2, 1.0), alpha, 0.0, 0.0))
        else:
            alpha = rng.choice([0.0, math.pi / 2, -math.pi / 2, rng.uniform(-math.pi, math.pi)])
            shrink = 1.0 if i < 3 else 0.4
            rows.append((kind, shrink * rng.uniform(0.0, 0.8), alpha, shrink * rng.uniform(-0.4, 0.4), 0.0))
        if kind == "P":
            limits.append(_slide(rng))
        elif i == 0:
            limits.append([-math.pi, math.pi] if first == "full" else _turn(rng, 0.5, 6.0))
        else:
            limits.append(_turn(rng, 0.5, 5.5) if rng.random() < tight else [-math.pi, math.pi])
    return Arm.from_dh(rows, limits=limits, task="xyz")


KINDS: dict[str, tuple[str, bool, str, float]] = {
    "planar 3R": ("RRR", True, "full", 0.7),
    "planar 4R": ("RRRR", True, "full", 0.7),
    "planar RPR": ("RPR", True, "full", 0.5),
    "planar 3R, joint 1 limited": ("RRR", True, "limited", 0.7),
    "3R": ("RRR", False, "full", 0.5),
    "3R, joint 1 limited": ("RRR", False, "limited", 0.5),
    "RRP": ("RRP", False, "limited", 0.5),
    "4R, joint 1 limited": ("RRRR", False, "limited", 0.5),
    "6R": ("RRRRRR", False, "full", 0.5),
    "6R, joint 1 limited": ("RRRRRR", False, "limited", 0.5),
    "PRR": ("PRR", False, "limited", 0.5),
}
"""Types of joints, whether planar, joint 1, and how often another joint is limited."""


def drawn(kind: str, seed: int) -> Arm:
    """Return a random arm of a kind."""
    index = list(KINDS).index(kind)
    return _drawn(*KINDS[kind], np.random.default_rng([index, seed]))
