"""The numbers of the list beside the ghosts, at corners that are far apart."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.scene._strokes import add_name

Floats = NDArray[np.float64]

TOGETHER = 0.06
"""Distance, in sizes of the arm, below which numbers share a label."""

MOST = 16
"""Largest number of labels; with more ghosts there are none."""


class Names:
    """The labels of the ghosts."""

    def __init__(self, canvas: LayerCanvas, path: str) -> None:
        self._canvas, self._path = canvas, path
        self._labels: list[viser.LabelHandle] = []

    def show(self, corners: Floats, arm: Floats, places: Sequence[int]) -> None:
        """Show the numbers in the list, from 1, of ghosts with corners (k, c, 3), beside an arm with corners (c, 3)."""
        groups: list[tuple[Floats, list[int]]] = []
        if 0 < len(corners) <= MOST:
            for point, place in zip(bends(corners, arm), places, strict=True):
                near = (group for at, group in groups if np.linalg.norm(at - point) < TOGETHER * self._canvas.size)
                found = next(near, None)
                if found is None:
                    groups.append((point, [place]))
                else:
                    found.append(place)
        for k, (point, group) in enumerate(groups):
            text = ranges(sorted(group))
            if k < len(self._labels):
                write(self._labels[k], text)
                move(self._labels[k], point)
            else:
                name = f"{self._path}/{k}"
                self._labels.append(add_name(self._canvas.scene, name, text, point, "center-center"))
        for k, label in enumerate(self._labels):
            seen(label, k < len(groups))


def bends(corners: Floats, arm: Floats) -> Floats:
    """Return the corner of each of k polylines (k, c, 3) that is farthest from that of the arm (c, 3), shape (k, 3)."""
    far = np.linalg.norm(corners - arm, axis=2)
    return np.asarray(corners[np.arange(len(corners)), np.argmax(far, axis=1)])


def ranges(numbers: Sequence[int]) -> str:
    """Return rising numbers in short, such as ``"1–3, 5"``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{run[0]}–{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs)
