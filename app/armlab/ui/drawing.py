"""The drawing of one layer, which is shown, hidden and removed as a whole without any code in the layer."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.session.state import Post, State
from armlab.ui import adapter
from armlab.ui.canvas import Canvas, PoseListener
from armlab.ui.figure.drawn import Drawn
from armlab.ui.pace import Pace, Paced


class LayerCanvas:
    """The canvas that a layer shares with the others, and a scene that remembers the nodes that the layer has added.

    Attributes
    ----------
    scene : viser.SceneApi
        Every node must be added through it.
    client : viser.ClientHandle
    drawn : Drawn
        The arm's figure.
    post : callable
        Hands in a command.
    size : float
        Of the arm, in metres.
    bare : bool
        Whether the arm has to be drawn as a skeleton now.
    """

    def __init__(self, canvas: Canvas, pace: Pace | None = None) -> None:
        self._canvas, self._pace = canvas, pace
        self._paced: list[Paced] = []
        self._nodes = _Remembered(canvas.client.scene)
        self._on_hide: list[Callable[[], None]] = []
        self._on_off: list[Callable[[], None]] = []
        self.hidden = False
        self.bare = False
        self.client: viser.ClientHandle = canvas.client
        self.drawn: Drawn = canvas.drawn
        self.post: Post = canvas.post
        self.size = canvas.size

    @property
    def scene(self) -> viser.SceneApi:
        """The scene; what is added to it belongs to this layer."""
        return cast(viser.SceneApi, self._nodes)

    def path(self, name: str) -> str:
        """Return the full name of a node of this canvas."""
        return self._canvas.path(name)

    def node(self, i: int) -> str:
        """Return the name of the node of body i (0 is the base); its children move with the body."""
        return self._canvas.node(i)

    def show_pose(self, q: NDArray[np.float64], at_once: bool = False, slow: bool = False) -> None:
        """Show a configuration; see `Canvas.show_pose`."""
        self._canvas.show_pose(q, at_once, slow)

    def on_pose(self, listener: PoseListener) -> None:
        """Call back with every configuration that is shown, including those of moves, while the layer is not hidden.

        A layer that may lag gets fewer of them when a class needs the time, and always the last.
        """
        self._canvas.on_pose(self.paced(lambda q: None if self.hidden else listener(q)))

    def on_eye(self, listener: Callable[[], None]) -> None:
        """Call back when the eye of the page has moved, while the layer is not hidden."""
        paced = self.paced(lambda _: None if self.hidden else listener())
        self._canvas.on_eye(lambda: paced(None))

    def follow(self, state: State, draw: Callable[[State, NDArray[np.float64]], None]) -> Callable[[State], None]:
        """Return the ``show`` of a layer: ``draw(state, q)`` is called for a state and each configuration of a move."""
        present = state

        def show(state: State) -> None:
            nonlocal present
            present = state
            draw(state, self.shown_pose)

        self.on_pose(lambda q: draw(present, q))
        return show

    def paced(self, call: Callable[[Any], None]) -> Callable[[Any], None]:
        """Return a function that calls the given one, less often when time is short, if the layer may lag."""
        if self._pace is None:
            return call
        paced = Paced(call, self._pace)
        self._paced.append(paced)
        return paced

    @property
    def shown_pose(self) -> NDArray[np.float64]:
        """The configuration on screen, which may differ from that of the state during a short move."""
        return self._canvas.shown

    def on_hide(self, listener: Callable[[], None]) -> None:
        """Call back when the layer is hidden: switched off, or in the way of what a page shows."""
        self._on_hide.append(listener)

    def on_off(self, listener: Callable[[], None]) -> None:
        """Call back when the layer is switched off, also while it is hidden."""
        self._on_off.append(listener)

    def switch_off(self) -> None:
        """Tell those who wait for it that the layer is switched off."""
        for listener in self._on_off:
            listener()

    def hide(self) -> None:
        """Make all nodes of the layer invisible."""
        self.hidden = True
        for listener in self._on_hide:
            listener()
        self._nodes.hide()

    def letter(self, size: float) -> None:
        """Give all labels of the layer another size, relative to the usual one."""
        self._nodes.letter(size)

    def reveal(self) -> None:
        """Make the nodes visible again that were visible before."""
        self.hidden = False
        self._nodes.reveal()

    def remove(self) -> None:
        """Remove all nodes of the layer."""
        if not self.hidden:
            for listener in self._on_hide:
                listener()
        self.hidden = True
        for paced in self._paced:
            paced.stop()
        self._nodes.remove()


class _Remembered:
    """A scene that remembers the nodes added through it."""

    def __init__(self, scene: viser.SceneApi) -> None:
        self._scene, self._lettering = scene, 1.0
        self._labels: dict[str, float] = {}
        self._made: dict[str, Any] = {}
        self._hidden: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        attribute = getattr(self._scene, name)
        if not name.startswith("add_"):
            return attribute

        def add(*arguments: Any, **options: Any) -> Any:
            if name == "add_label":
                size = options.get("font_screen_scale", 1.0)
                options["font_screen_scale"] = size * self._lettering
            handle = attribute(*arguments, **options)
            if name == "add_label":
                self._labels[handle.name] = size
            self._made[handle.name] = handle
            return handle

        return add

    def letter(self, size: float) -> None:
        self._lettering = size
        for handle in self._present():
            if handle.name in self._labels:
                handle.font_screen_scale = size * self._labels[handle.name]

    def _present(self) -> list[Any]:
        self._made = {name: handle for name, handle in self._made.items() if not adapter.is_removed(handle)}
        return list(self._made.values())

    def hide(self) -> None:
        self._hidden = [handle for handle in self._present() if handle.visible]
        for handle in self._hidden:
            handle.visible = False

    def reveal(self) -> None:
        for handle in self._hidden:
            if not adapter.is_removed(handle):
                handle.visible = True
        self._hidden = []

    def remove(self) -> None:
        for handle in self._present():
            if not adapter.is_removed(handle):  # a parent may have taken it along
                handle.remove()
        self._made.clear()
