"""What a panel and a layer of the scene are: each is one file, found by folder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from armlab.plugins import discover
from armlab.session.state import Command, Part, State
from armlab.ui.widgets import Gui

if TYPE_CHECKING:
    from armlab.ui.canvas import Canvas

Post = Callable[[Command], None]
Show = Callable[[State], None]


@dataclass(frozen=True)
class Panel:
    """The constant ``PANEL`` of a module in `armlab.ui.panels`.

    Parameters
    ----------
    key, title : str
    icon : str
        Name of one of `viser.Icon`, such as ``"ROBOT"``.
    order : int
        Place among the tabs.
    watches : tuple of part types
        ``show`` is called when one of these parts has changed, at most some eight times a second.
    build : callable
        ``build(gui, state, post) -> show``: makes the controls, returns the function that shows a state, which is
        called at once. Called anew when another arm is chosen.
    """

    key: str
    title: str
    icon: str
    order: int
    watches: tuple[type[Part], ...]
    build: Callable[[Gui, State, Post], Show]


@dataclass(frozen=True)
class Layer:
    """The constant ``LAYER`` of a module in `armlab.ui.layers`: something drawn in the scene.

    Parameters
    ----------
    key : str
    order : int
        Layers are built in this order; nodes of the arm come first.
    watches : tuple of part types
        ``show`` is called at once when one of these parts has changed.
    build : callable
        ``build(canvas, state) -> show``; ``show`` is called at once. Called anew when another arm is chosen.
    """

    key: str
    order: int
    watches: tuple[type[Part], ...]
    build: Callable[[Canvas, State], Show]


@cache
def panels() -> dict[str, Panel]:
    """Return all panels in order."""
    from armlab.ui import panels as folder

    return discover(folder, "PANEL", Panel)


@cache
def layers() -> dict[str, Layer]:
    """Return all layers in order."""
    from armlab.ui import layers as folder

    return discover(folder, "LAYER", Layer)
