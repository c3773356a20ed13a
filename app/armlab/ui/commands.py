"""The command palette (Ctrl+K) and the keyboard shortcuts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from typing import Any, Literal, Protocol, cast

import viser

from armlab.session.pages import pages
from armlab.session.parts.display import Show
from armlab.session.parts.joints import RandomPose, TakePose
from armlab.session.parts.target import TargetToTool
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import Command
from armlab.ui import adapter
from armlab.ui.camera import Camera
from armlab.ui.format import lowered
from armlab.ui.plugin import switches
from armlab.ui.switches import Switch


class Page(Protocol):
    """The page of a browser, on which an entry acts."""

    client: viser.ClientHandle
    camera: Camera
    session: Session

    def post(self, command: Command) -> None:
        """Post a command."""

    def open_tab(self, key: str) -> None:
        """Bring a panel to the front."""


@dataclass(frozen=True)
class Shortcut:
    """One entry of the palette.

    Parameters
    ----------
    label : str
    key : str or None
        viser's name of the key; None for an entry without one.
    shown : str
        The key in its usual notation.
    act : callable
        Gets the view.
    modifier : str or None
    """

    label: str
    key: str | None
    shown: str
    act: Callable[[Page], None]
    modifier: Literal["cmd/ctrl", "cmd/ctrl+shift"] | None = None


_FIXED: tuple[Shortcut, ...] = (
    Shortcut("Help", "H", "H", lambda view: view.open_tab("help")),
    Shortcut("Undo", "Z", "Ctrl+Z", lambda view: view.post(Undo()), "cmd/ctrl"),
    Shortcut("Redo", "Z", "Ctrl+Shift+Z", lambda view: view.post(Redo()), "cmd/ctrl+shift"),
    Shortcut("Home pose", "O", "O", lambda view: view.post(TakePose(next(iter(view.session.robot.poses))))),
    Shortcut("Zero pose", "0", "0", lambda view: view.post(TakePose("zero"))),
    Shortcut("Random pose", "R", "R", lambda view: view.post(RandomPose())),
    Shortcut("Target back to the tool", "B", "B", lambda view: view.post(TargetToTool())),
    Shortcut("Look from home", "C", "C", lambda view: view.camera.look_from("Home")),
    Shortcut("Look from the front", None, "", lambda view: view.camera.look_from("Front")),
    Shortcut("Look from the side", None, "", lambda view: view.camera.look_from("Side")),
    Shortcut("Look from the top", None, "", lambda view: view.camera.look_from("Top")),
)


def _toggle(switch: Switch) -> Shortcut:
    def act(view: Page) -> None:
        view.post(Show(switch.name, not switch.on(view.session.state)))

    return Shortcut(f"Show or hide: {lowered(switch.title)}", switch.key or None, switch.key, act)


def _open(key: str, title: str) -> Shortcut:
    return Shortcut(f"Open {title}", None, "", lambda view: view.open_tab(key))


@cache
def shortcuts() -> tuple[Shortcut, ...]:
    """Return all entries: the fixed ones, one for each switch of the picture, one for each panel."""
    toggles = (_toggle(switch) for switch in switches())
    return (*_FIXED, *toggles, *(_open(panel.key, panel.title) for panel in pages().values()))


def register(view: Page) -> None:
    """Add all entries to the palette of a browser."""
    for shortcut in shortcuts():
        handle = view.client.gui.add_command(shortcut.label, hotkey=cast(Any, shortcut.key), modifier=shortcut.modifier)
        adapter.on_event(handle, "on_trigger", partial(_do, shortcut, view))


def _do(shortcut: Shortcut, view: Page, _: object) -> None:
    shortcut.act(view)
