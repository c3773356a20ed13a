"""Panels and layers of the scene: each is one file, found by its folder."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.errors import PluginError
from armlab.plugins import constant_of, discover_in_benches
from armlab.session.pages import pages
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Part, Post, State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.camera import Wish
from armlab.ui.drawing import LayerCanvas
from armlab.ui.eye import Facing
from armlab.ui.switches import GENERAL, Switch
from armlab.ui.widgets import Gui

Points = NDArray[np.float64]
Show = Callable[[State], None]

OF_THE_ROOM = frozenset({"stage"})
"""Keys of layers that exist without the arm, too."""

OF_THE_ARM = ("arm", "skeleton", "names", "frames", "symbols", "angles", "lengths", "projections", "trace", "swept")
"""Keys of the layers that draw the arm and its details, for pages in whose way it would be."""

NOTHING: Points = np.zeros((0, 3))


@dataclass(frozen=True)
class Panel:
    """The constant ``PANEL`` of the module ``ui.page`` of a page.

    It is imported and built when the page is first opened, and shown only while it is open.

    Parameters
    ----------
    watches : tuple of part types
        ``show`` is called when one of these parts has changed, at most some eight times a second.
    build : callable
        ``build(gui, state, post) -> show``: makes the controls, returns the function that shows a state, which is
        called at once.
    rebuilds : tuple of part types
        ``build`` is called again when one of these has changed: another arm, other units.
    see_through : bool
        Whether the arm is drawn as a skeleton while the panel is open, because what it shows lies inside.
    hides : tuple of str
        Keys of layers that would be in its way while it is open.
    hides_then : callable
        ``hides_then(state)`` returns keys of layers that are in its way in this state, besides ``hides``.
    around : callable
        ``around(state)`` returns points (k, 3) of the scene that belong in the picture beside the arm while the panel
        is open.
    faces : callable
        ``faces(state)`` returns a plane that is to be looked at square while the panel is open, or None. The view that
        a person had comes back when it is left, as with points.
    looks : callable
        ``looks(state)`` returns what there is to look at, such as the choice of a cut: the camera looks again for
        points and plane when this is another, and not already when they move along with the arm.
    outside : callable
        ``outside()`` returns what it shows besides the state; ``show`` is called also when this is another object.
    waits : callable
        ``waits()`` returns a sentence that stands in place of the page as long as what it shows is not there yet.
    apart : bool
        Whether it has nothing to do with the arm, which stands in the scene all the same.
    """

    watches: tuple[type[Part], ...]
    build: Callable[[Gui, State, Post], Show]
    rebuilds: tuple[type[Part], ...] = (RobotPart, Notation)
    see_through: bool = False
    hides: tuple[str, ...] = ()
    hides_then: Callable[[State], tuple[str, ...]] = lambda state: ()
    around: Callable[[State], Points] = lambda state: NOTHING
    faces: Callable[[State], Facing | None] = lambda state: None
    looks: Callable[[State], Hashable] = lambda state: None
    outside: Callable[[], object] = lambda: None
    waits: Callable[[], str] = lambda: ""
    apart: bool = False


def without_the_arm(opened: Collection[Panel]) -> bool:
    """Return whether there are open panels, and none of them has to do with the arm."""
    return bool(opened) and all(panel.apart for panel in opened)


def wish_of(state: State, opened: Iterable[Panel]) -> Wish:
    """Return what open panels want of the camera in a state; of several planes the first is looked at."""
    opened = tuple(opened)
    faced = (facing for panel in opened if (facing := panel.faces(state)) is not None)
    points = np.vstack([NOTHING, *(panel.around(state) for panel in opened)])
    return Wish(points, next(faced, None), len(points) > 0 and any("arm" in panel.hides for panel in opened))


@dataclass(frozen=True)
class Layer:
    """The constant ``LAYER`` of a module in `armlab.ui.scene`: a part of the scene.

    Parameters
    ----------
    key : str
    order : int
        Layers are built in this order; nodes of the arm come first.
    watches : tuple of part types
        ``show`` is called at once when one of these parts has changed.
    build : callable
        ``build(canvas, state) -> show``; ``show`` is called at once. Called again when the arm has changed. The nodes
        that it adds to ``canvas.scene`` are shown, hidden and removed as a whole.
    switch : Switch or None
        The switch that shows or hides it; it is built when first switched on, and not shown while it is off.
    panel : str or tuple of str
        Keys of the panels with which it comes and goes; empty when it does not.
    hides : tuple of str
        Keys of layers that say the same in fewer words, and are hidden while its switch is on.
    silent : bool
        Whether it tells no numbers and shows no results, and may stay while a question of a lesson hides the values.
    """

    key: str
    order: int
    watches: tuple[type[Part], ...]
    build: Callable[[LayerCanvas, State], Show]
    switch: Switch | None = None
    panel: str | tuple[str, ...] = ""
    hides: tuple[str, ...] = ()
    silent: bool = False

    @property
    def panels(self) -> frozenset[str]:
        """The panels with which the layer is shown."""
        return frozenset(filter(None, (self.panel,) if isinstance(self.panel, str) else self.panel))


def panel(key: str) -> Panel:
    """Return the panel of a page, which is imported now; `PluginError` if it is broken."""
    found = _imported(key)
    if isinstance(found, PluginError):
        raise found
    return found


def whole_panel(key: str) -> Panel | None:
    """Return the panel of a page, or None if it is broken, which the page says."""
    found = _imported(key)
    return found if isinstance(found, Panel) else None


@cache
def _imported(key: str) -> Panel | PluginError:
    """Return a panel, or the error of its import; a broken one stays so until the lab is restarted."""
    try:
        found = constant_of(f"{pages()[key].package}.ui.page", "PANEL", Panel)
        _refuse_unknown(key, found.hides)
    except PluginError as error:
        return error
    return found


def panels() -> None:
    """Import all panels; `PluginError` with the name of the first broken one."""
    for key in pages():
        panel(key)


@cache
def layers() -> dict[str, Layer]:
    """Return all layers in order."""
    from armlab.ui import scene

    found = discover_in_benches("ui.scene", "LAYER", Layer, scene)
    names = [switch.name for switch in GENERAL] + [layer.switch.name for layer in found.values() if layer.switch]
    for name in names:
        if names.count(name) > 1:
            raise PluginError(f"two switches are called {name!r}")
    for layer in found.values():
        for key in layer.panels:
            if key not in pages():
                raise PluginError(f"layer {layer.key}: there is no page {key!r}")
        _refuse_unknown(layer.key, layer.hides, found)
    return found


@cache
def _hiding() -> tuple[Layer, ...]:
    return tuple(layer for layer in layers().values() if layer.hides)


def hidden_layers(state: State, opened: Iterable[Panel]) -> frozenset[str]:
    """Return the keys of layers that are hidden by a prediction, an open panel, or a layer that is switched on."""
    predicted = state[LessonPart].hides
    if "arm" in predicted:
        return frozenset(layers()) - OF_THE_ROOM
    of_panels = frozenset(key for panel in opened for key in (*panel.hides, *panel.hides_then(state)))
    if predicted:
        return of_panels.union(key for key, layer in layers().items() if not layer.silent)
    return of_panels.union(*(layer.hides for layer in _hiding() if layer.switch is not None and layer.switch.on(state)))


def _refuse_unknown(key: str, hides: tuple[str, ...], known: Collection[str] | None = None) -> None:
    for hidden in hides:
        if hidden not in (layers() if known is None else known):
            raise PluginError(f"{key}: there is no layer {hidden!r} to hide")


def switches() -> tuple[Switch, ...]:
    """Return all switches of the picture in order: those of layers, then the general ones."""
    return (*(layer.switch for layer in layers().values() if layer.switch), *GENERAL)
