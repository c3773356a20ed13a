"""A layer that reacts to clicks in the scene, but only while it has something to show."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.ui import adapter
from armlab.ui.drawing import LayerCanvas


class SceneClicks:
    """Clicks that no node takes; while somebody listens, the pointer over the scene tells so.

    Parameters
    ----------
    canvas : LayerCanvas
        When it is hidden, nobody listens until the next `listen`.
    clicked : callable
        Called with viser's event of the click.
    """

    def __init__(self, canvas: LayerCanvas, clicked: Callable[[Any], None]) -> None:
        self._client, self._clicked = canvas.client, clicked
        self._deaf: Callable[[], None] | None = None
        canvas.on_hide(lambda: self.listen(False))

    def listen(self, on: bool) -> None:
        """Start or stop listening."""
        if on and self._deaf is None:
            self._deaf = adapter.on_scene_click(self._client, self._clicked)
        elif not on and self._deaf is not None:
            self._deaf()
            self._deaf = None
