"""The request for a sampled workspace, and the samples so far."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.cloud import Samples, samples
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.voxels import Voxels, voxels_for

Floats = NDArray[np.float32]

SHOWN = 26_000
"""Number of points that are drawn, the first of the samples: more would hide the arm and one another."""

VOXELS = 32
"""Voxels along a side of the cube that holds the workspace."""

REMEMBERED = 6
"""Number of workspaces that are kept for the next request."""

FOUND_OUT = 97
"""Quantile of the values, in percent, at which the scale of colours ends, so that outliers do not compress it."""


NOTHING = 0.02
"""Share of the end of a scale; if the scale would begin below it, it begins at 0."""


@dataclass(frozen=True)
class Question:
    """All arguments of a sampled workspace; arms are compared by identity.

    Attributes
    ----------
    arm : Arm
    measure : str
        Key of the measure that colours it.
    count : int
        Samples.
    seed : int
    """

    arm: Arm
    measure: str
    count: int
    seed: int


@dataclass(frozen=True, eq=False)
class Sampled:
    """A workspace with the samples so far.

    Attributes
    ----------
    question : Question
    done : int
        Samples so far.
    shown : Samples
        The first of them, those that are drawn.
    voxels : Voxels
        How many samples lie where, and the mean of the measure there.
    farthest : float
        Largest distance of a sample from the origin of frame 0, metres.
    low, high : float
        Ends of the scale of the measure.
    """

    question: Question
    done: int
    shown: Samples
    voxels: Voxels
    farthest: float
    low: float
    high: float

    @property
    def planar(self) -> bool:
        """Whether the tool point stays in a plane."""
        return first_joint(self.question.arm).planar

    @property
    def finished(self) -> bool:
        """Whether all samples have been taken."""
        return self.done >= self.question.count

    @property
    def part(self) -> float:
        """The share of the samples that has been taken, 0 to 1."""
        return self.done / self.question.count


class _Memory:
    """Results for a request, kept for the next one that is equal."""

    found: Sampled | None = None


@lru_cache(maxsize=REMEMBERED)
def _memory(question: Question) -> _Memory:
    return _Memory()


def sampling(question: Question) -> Iterator[Sampled | None]:
    """Yield the workspace as it grows, or at once the whole one if it is remembered."""
    memory = _memory(question)
    if memory.found is not None:
        yield memory.found
        return
    voxels, shown = voxels_for(question.arm, VOXELS), None
    done, farthest, base = 0, 0.0, question.arm.base[:3, 3].astype(np.float32)
    found: Sampled | None = None
    for piece in samples(question.arm, question.count, question.seed, question.measure):
        voxels.add(piece.points, piece.values)
        done += len(piece.points)
        farthest = max(farthest, float(np.linalg.norm(piece.points - base, axis=1).max()))
        grew = shown is None or len(shown.points) < min(SHOWN, question.count)
        if shown is None or grew:
            shown = joined(shown, piece)
        low, high = scale_of(shown.values) if grew or found is None else (found.low, found.high)
        found = Sampled(question, done, shown, voxels.copy(), farthest, low, high)
        yield found
    memory.found = found


def joined(before: Samples | None, piece: Samples) -> Samples:
    """Return the drawn samples with more of them appended, `SHOWN` at most."""
    if before is None:
        return Samples(piece.q[:SHOWN], piece.points[:SHOWN], piece.values[:SHOWN])
    left = SHOWN - len(before.points)
    return Samples(
        np.concatenate([before.q, piece.q[:left]]),
        np.concatenate([before.points, piece.points[:left]]),
        np.concatenate([before.values, piece.values[:left]]),
    )


def scale_of(values: Floats) -> tuple[float, float]:
    """Return the values at which the scale of colours begins and ends."""
    if not len(values):
        return 0.0, 1.0
    low, high = float(values.min()), float(np.percentile(values, FOUND_OUT))
    if low < NOTHING * high:
        low = 0.0
    return low, high


def whole(question: Question) -> Sampled:
    """Return the workspace with all its samples, for tests and for callers that can wait."""
    found = [each for each in sampling(question) if each is not None]
    return replace(found[-1])
