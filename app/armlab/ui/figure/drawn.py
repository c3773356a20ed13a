"""Figures prepared for the page, one for each arm, kept for the next student who opens it."""

from __future__ import annotations

import threading
from dataclasses import dataclass

from armlab.kin.arm import Arm
from armlab.ui.figure.figure import Figure, build_figure
from armlab.ui.figure.marks import symbols_of

KEPT = 64
"""Number of figures that are kept, each of half a megabyte."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """A figure and its GLB files.

    Attributes
    ----------
    figure : Figure
    glbs : list of bytes or None
        For bodies 0 to n.
    symbols : list of bytes
        Textbook symbols of joints 1 to n.
    """

    figure: Figure
    glbs: list[bytes | None]
    symbols: list[bytes]


class Gallery:
    """A store that makes each figure once. It is safe to use from several threads."""

    def __init__(self) -> None:
        self._ready: dict[Arm, Drawn] = {}
        self._making = threading.Lock()

    def ready(self, arm: Arm) -> Drawn | None:
        """Return the figure if it has been made."""
        return self._ready.get(arm)

    def make(self, arm: Arm) -> Drawn:
        """Return the figure, which is made if it is new; call this outside the event loop."""
        with self._making:
            if arm not in self._ready:
                figure = build_figure(arm)
                drawn = Drawn(figure, figure.glbs(), symbols_of(figure.anatomy))
                while len(self._ready) >= KEPT:
                    del self._ready[next(iter(self._ready))]
                self._ready[arm] = drawn
            return self._ready[arm]
