"""Figures prepared for the page, one for each arm, kept for the next student who opens it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from armlab.content.robots import Robot
from armlab.kin.arm import Arm
from armlab.ui.figure.figure import Figure, build_figure
from armlab.ui.figure.marks import symbols_of

KEPT = 64
"""Number of figures that are kept, each of half a megabyte, and of small pictures, each of ten kilobytes."""


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
    """A store that makes each figure, and each small picture, once. It is safe to use from several threads.

    It makes one after the other: each thread that computes holds up the event loop once more.

    Parameters
    ----------
    crowded : callable
        Whether others use the lab: then it rests after each picture for as long as that has taken.

    Attributes
    ----------
    painter : ThreadPoolExecutor
        Where pictures are to be painted, one at a time: a class that looks at all arms holds up no other work.
    """

    def __init__(self, crowded: Callable[[], bool] = lambda: False) -> None:
        self._crowded = crowded
        self.painter = ThreadPoolExecutor(1, "armlab-pictures")
        self._ready: dict[Arm, Drawn] = {}
        self._pictures: dict[Arm, bytes] = {}
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
                _make_room(self._ready)
                self._ready[arm] = drawn
            return self._ready[arm]

    def picture(self, robot: Robot) -> bytes:
        """Return a small picture of an arm at home, a PNG file; call this outside the event loop."""
        from armlab.ui.figure.picture import picture_of  # the first page needs none

        arm, began = robot.arm, time.perf_counter()
        with self._making:
            if arm not in self._pictures:
                known = self._ready.get(arm)
                figure = build_figure(arm) if known is None else known.figure
                picture = picture_of(figure, robot.home, robot.camera)
                _make_room(self._pictures)
                self._pictures[arm] = picture
            picture = self._pictures[arm]
        if self._crowded():
            time.sleep(time.perf_counter() - began)
        return picture


def _make_room(kept: dict[Arm, Drawn] | dict[Arm, bytes]) -> None:
    """Forget the oldest of what is kept, if there is no room for one more."""
    while len(kept) >= KEPT:
        del kept[next(iter(kept))]
