"""One layer on one canvas: built when it is first wanted; its failures stop no other layer."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

from armlab.session.state import State
from armlab.ui.canvas import Canvas
from armlab.ui.drawing import LayerCanvas
from armlab.ui.pace import Pace
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import SKELETON

log = logging.getLogger(__name__)


class Drawing:
    """One layer on one canvas: built when it is first wanted.

    Parameters
    ----------
    layer : Layer
        One with a switch or a panel may lag behind the arm.
    canvas : Canvas
    pace : Pace or None
        Shared by everything that may lag; None holds nothing back.
    """

    def __init__(self, layer: Layer, canvas: Canvas, pace: Pace | None = None) -> None:
        self.layer = layer
        self.canvas = LayerCanvas(canvas, pace if layer.switch or layer.panel else None)
        self._show: Show | None = None
        self._soon = self.canvas.paced(self._show_now)
        self._built = self._is_on = False
        self._shown: State | None = None

    @property
    def seen(self) -> bool:
        """Whether the layer is in the scene now."""
        return self._built and not self.canvas.hidden

    def show(self, state: State, open_panels: frozenset[str], bare: bool, hidden: frozenset[str]) -> None:
        """Show a state if the layer is wanted, else hide it.

        Parameters
        ----------
        state : State
        open_panels : frozenset of str
        bare : bool
            Whether the arm has to be drawn as a skeleton.
        hidden : frozenset of str
            Keys of layers that are in the way of a panel.
        """
        wanted = self._wanted(state, open_panels, bare)
        if self._built and self._is_on and not wanted:
            self.canvas.switch_off()
        self._is_on = wanted
        if self.layer.key in hidden or not wanted:
            if self._built and not self.canvas.hidden:
                self.canvas.hide()
            return
        again = self.canvas.bare != bare or self.canvas.hidden or not self._built
        self.canvas.bare = bare
        if self.canvas.hidden:
            self.canvas.reveal()
        before, self._shown = self._shown, state
        if not self._built:
            self._built = True
            self._show = self._guarded(self.layer.build, self.canvas, state)
        if again or before is None:
            self._show_now(state)
        elif any(state[kind] is not before[kind] for kind in self.layer.watches):
            self._soon(state)

    def _show_now(self, state: State) -> None:
        if not self.canvas.hidden:
            self._guarded(self._show, state)

    def _wanted(self, state: State, open_panels: frozenset[str], bare: bool) -> bool:
        switch = self.layer.switch
        on = switch is None or switch.on(state) or (switch is SKELETON and bare)
        return on and (not self.layer.panels or bool(self.layer.panels & open_panels))

    def _guarded(self, call: Callable[..., Any] | None, *arguments: Any) -> Any:
        """Return the result of a call, or None when it raised; a layer that fails must not stop the others."""
        try:
            return None if call is None else call(*arguments)
        except Exception:
            log.exception("layer %s failed", self.layer.key)
            return None
