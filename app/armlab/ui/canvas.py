"""The scene of one browser and one arm: its parent nodes, and the pose that they show."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.easing import eased
from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.state import Post
from armlab.ui import adapter
from armlab.ui.figure.drawn import Drawn

JUMP = 0.35
"""Largest joint change (rad, or sizes of the arm) that is shown at once, so that nothing lags behind a drag; a larger
one is shown as a short move."""

GLIDE_SPEED = 4.0
GLIDE_SECONDS = (0.12, 0.5)
GLIDE_RATE = 30.0
"""Rate, rad/s, shortest and longest duration, s, and pictures a second of moves made by the lab. A jump to another
solution takes the longest, so that each can be followed by eye."""

PoseListener = Callable[[NDArray[np.float64]], None]


class Canvas:
    """The canvas on which layers draw.

    Attributes
    ----------
    client : viser.ClientHandle
    drawn : Drawn
        The arm's figure.
    post : callable
        Hands in a command.
    number : int
        Another one for each canvas of a browser. The page keeps the pose of a node that is removed and made again
        under its name, so no name may be used twice.
    """

    def __init__(
        self, client: viser.ClientHandle, drawn: Drawn, post: Post, q: NDArray[np.float64], number: int
    ) -> None:
        self.client, self.drawn, self.post, self._number = client, drawn, post, number
        self.scene = client.scene
        self.size = drawn.figure.anatomy.size
        self._scale = np.where(drawn.figure.anatomy.arm.revolute, 1.0, self.size).tolist()
        self._listeners: list[PoseListener] = []
        self._eye_listeners: list[Callable[[], None]] = []
        self._nodes: list[viser.FrameHandle] = []
        self._make_nodes(q)
        self._shown = q
        self._goal = q
        self._slow = False
        self._glide: asyncio.TimerHandle | None = None

    def _make_nodes(self, q: NDArray[np.float64]) -> None:
        anatomy = self.drawn.figure.anatomy
        self._root = self.scene.add_frame(f"/{self._number}", show_axes=False)
        path = self.path("arm")
        root = quaternion_from_rotation(anatomy.root[:3, :3])
        self._nodes.append(self.scene.add_frame(path, show_axes=False, wxyz=root, position=anatomy.root[:3, 3]))
        for i, body in enumerate(anatomy.bodies):
            path += f"/{i + 1}"
            wxyz, position = body.node_wxyz(float(q[i])), body.node_position(float(q[i]))
            self._nodes.append(self.scene.add_frame(path, show_axes=False, wxyz=wxyz, position=position))

    def path(self, name: str) -> str:
        """Return the full name of a node of this canvas."""
        return f"/{self._number}/{name}"

    def node(self, i: int) -> str:
        """Return the name of the node of body i (0 is the base); its children move with the body."""
        return self._nodes[i].name

    def on_pose(self, listener: PoseListener) -> None:
        """Call back with every configuration that is shown, including those of moves."""
        self._listeners.append(listener)

    def on_eye(self, listener: Callable[[], None]) -> None:
        """Call back when the page tells that its eye has moved."""
        self._eye_listeners.append(listener)

    def eye_moved(self) -> None:
        """Tell those who look where the eye is."""
        with self.client.atomic():
            for listener in self._eye_listeners:
                listener()

    @property
    def gliding(self) -> bool:
        """Whether a short move is in progress."""
        return self._glide is not None

    @property
    def shown(self) -> NDArray[np.float64]:
        """The configuration on screen."""
        return self._shown

    def show_pose(self, q: NDArray[np.float64], at_once: bool = False, slow: bool = False) -> None:
        """Show a configuration: at once if it is near or ``at_once`` is set, else by a short move.

        A ``slow`` move takes the longest time, however far it goes; the next begins where the arm is then.
        """
        self._goal, self._slow = q, slow
        if at_once:
            self.stop()
        if self._glide is not None:
            return
        if at_once or (not slow and self._distance() <= JUMP):
            self._write(q)
        else:
            self._begin_glide()

    def remove(self) -> None:
        """Remove everything from the scene."""
        self.stop()
        self._root.remove()

    def stop(self) -> None:
        """Stop a move."""
        if self._glide is not None:
            self._glide.cancel()
            self._glide = None

    def _distance(self) -> float:
        moved = zip(self._goal.tolist(), self._shown.tolist(), self._scale, strict=True)
        return float(max(abs(goal - shown) / scale for goal, shown, scale in moved))

    def _begin_glide(self) -> None:
        start, goal = self._shown, self._goal
        low, high = GLIDE_SECONDS
        duration = high if self._slow else min(max(self._distance() / GLIDE_SPEED, low), high)
        loop = asyncio.get_running_loop()
        began = loop.time()

        def step() -> None:
            s = min((loop.time() - began) / duration, 1.0)
            self._glide = None
            if self._goal is not goal:  # something newer: go on from here
                self._write(start + eased(s) * (goal - start))
                self.show_pose(self._goal, slow=self._slow)
                return
            self._write(goal if s >= 1.0 else start + eased(s) * (goal - start))
            if s < 1.0:
                self._glide = loop.call_later(1.0 / GLIDE_RATE, step)

        self._glide = loop.call_later(0.0, step)

    def _write(self, q: NDArray[np.float64]) -> None:
        bodies = self.drawn.figure.anatomy.bodies
        with self.client.atomic():
            for i, body in enumerate(bodies):
                if q[i] == self._shown[i]:
                    continue
                if body.revolute:
                    adapter.set_wxyz(self._nodes[i + 1], body.node_wxyz(float(q[i])))
                else:
                    adapter.set_position(self._nodes[i + 1], body.node_position(float(q[i])))
            self._shown = q
            for listener in self._listeners:
                listener(q)
