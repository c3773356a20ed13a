"""The eye of one page: where it is, its way to another place, and whether a hand has moved it."""

from __future__ import annotations

import asyncio
from collections import deque

import numpy as np
import viser

from armlab.kin.easing import eased
from armlab.ui import adapter
from armlab.ui.eye import FIELD_OF_VIEW, SAME, Eye, between

GLIDE_SECONDS, GLIDE_RATE = 0.45, 30.0
"""Duration, seconds, and pictures a second of the way to another place."""

SENT = 64
"""Number of places by which what a page sends back is known: it comes late, from the midst of a glide."""


class Gaze:
    """The eye of one page.

    Parameters
    ----------
    camera : viser.CameraHandle

    Attributes
    ----------
    still : bool
        Whether the eye jumps, since the person wants few moving pictures.
    goal : Eye or None
        The place to which the lab has put the eye, or where it goes; None where a hand has put it.
    """

    def __init__(self, camera: viser.CameraHandle) -> None:
        self._camera = camera
        self.still = False
        self.goal: Eye | None = None
        self._left: Eye | None = None
        self._sent = deque([self.told], maxlen=SENT)
        self._glide: asyncio.TimerHandle | None = None

    @property
    def told(self) -> Eye:
        """The place that the page has told last, or was sent since."""
        camera = self._camera
        return Eye(np.array(camera.position), np.array(camera.look_at), np.array(camera.up_direction))

    @property
    def present(self) -> Eye:
        """The place where the eye is, or goes to."""
        return self.goal or self.told

    def follows_a_hand(self) -> bool:
        """Return whether a hand has moved the eye since the lab has put it somewhere; it has stopped then.

        Where a hand has put it, another move is told once after each `heed`.
        """
        if self.goal is None:
            moved = self._left is not None and not self.told.near(self._left)
            self._left = None if moved else self._left
            return moved
        if self._is_ours(self.told):
            return False
        self.stop()
        self.goal = None
        return True

    def heed(self) -> None:
        """Tell also of another move of a hand that has put the eye where it is."""
        self._left = self.told if self.goal is None else None

    def _is_ours(self, told: Eye) -> bool:
        """Return whether the lab has put the eye there; of a place on the way the page may have only some messages."""
        known = np.array([[eye.position, eye.look_at, eye.up] for eye in self._sent])
        off = np.abs(known - np.array([told.position, told.look_at, told.up])).max(axis=2)
        return bool(np.all(off.min(axis=0) <= SAME * max(1.0, told.distance)))

    def go(self, eye: Eye, glide: bool = False) -> None:
        """Go to a place at once, or by a short glide."""
        start = self.told
        self.stop()
        self.goal = eye
        if not glide or self.still or start.distance == 0.0 or start.near(eye):
            self._stand(eye)
            return
        loop = asyncio.get_running_loop()
        began = loop.time()

        def step() -> None:
            s = (loop.time() - began) / GLIDE_SECONDS
            self._stand(between(start, eye, eased(s)))
            self._glide = loop.call_later(1.0 / GLIDE_RATE, step) if s < 1.0 else None

        self._glide = loop.call_later(1.0 / GLIDE_RATE, step)

    def stop(self) -> None:
        """Stop on the way."""
        if self._glide is not None:
            self._glide.cancel()
            self._glide = None

    def _stand(self, eye: Eye) -> None:
        self._sent.append(eye)
        adapter.place_camera(self._camera, FIELD_OF_VIEW, eye.position, eye.look_at, eye.up)
