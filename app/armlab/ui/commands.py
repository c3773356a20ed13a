"""Commands of a page, with their keys: what the search finds and the keyboard does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from typing import Any, Literal, Protocol, cast

import viser

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
    """The page of a browser, on which a command acts."""

    client: viser.ClientHandle
    camera: Camera
    session: Session
    language: str

    def post(self, command: Command) -> None:
        """Post a command."""

    def open_tab(self, key: str) -> None:
        """Bring a panel to the front."""


@dataclass(frozen=True)
class Shortcut:
    """One command.

    Parameters
    ----------
    label : str
    key : str or None
        viser's name of the key; None for a command without one.
    shown : str
        The key in its usual notation.
    act : callable
        Gets the view.
    modifier : str or None
    name : str
        Under which the search finds it; empty for what it finds as something else: a page, a switch.
    about : tuple of str
        Other words by which it is found.
    """

    label: str
    key: str | None
    shown: str
    act: Callable[[Page], None]
    modifier: Literal["cmd/ctrl", "cmd/ctrl+shift"] | None = None
    name: str = ""
    about: tuple[str, ...] = ()


def _look(place: str, label: str, name: str, *about: str, key: str | None = None) -> Shortcut:
    words = ("camera", "view", *about)
    return Shortcut(label, key, key or "", lambda view: view.camera.look_from(place), name=name, about=words)


_FIXED: tuple[Shortcut, ...] = (
    Shortcut("Help", "H", "H", lambda view: view.open_tab("help")),
    Shortcut("Undo", "Z", "Ctrl+Z", lambda view: view.post(Undo()), "cmd/ctrl", "undo", ("take back", "step back")),
    Shortcut("Redo", "Z", "Ctrl+Shift+Z", lambda view: view.post(Redo()), "cmd/ctrl+shift", "redo", ("do again",)),
    Shortcut(
        "Home pose",
        "O",
        "O",
        lambda view: view.post(TakePose(next(iter(view.session.robot.poses)))),
        name="home",
        about=("reset the joints", "start pose", "ready"),
    ),
    Shortcut(
        "Zero pose",
        "0",
        "0",
        lambda view: view.post(TakePose("zero")),
        name="zero",
        about=("all joints zero", "reset the joints"),
    ),
    Shortcut(
        "Random pose", "R", "R", lambda view: view.post(RandomPose()), name="random", about=("random joint values",)
    ),
    Shortcut(
        "Reset the target to the tool",
        "B",
        "B",
        lambda view: view.post(TargetToTool()),
        name="target_to_tool",
        about=("reset the target", "handle"),
    ),
    _look("Home", "Look from home", "look_home", "reset the view", "zoom to fit", "fit", key="C"),
    _look("Front", "Look from the front", "look_front", "front view"),
    _look("Side", "Look from the side", "look_side", "side view"),
    _look("Top", "Look from the top", "look_top", "top view", "plan view", "above"),
)


def toggle(switch: Switch) -> Shortcut:
    """Return the command that switches a part of the picture on or off."""

    def act(view: Page) -> None:
        view.post(Show(switch.name, not switch.on(view.session.state)))

    return Shortcut(f"Show or hide: {lowered(switch.title)}", switch.key or None, switch.key, act)


@cache
def shortcuts() -> tuple[Shortcut, ...]:
    """Return all commands: the fixed ones, and one for each switch of the picture."""
    return (*_FIXED, *map(toggle, switches()))


def register(view: Page) -> None:
    """Let the keys of a browser do their commands."""
    for shortcut in shortcuts():
        if shortcut.key is not None:
            handle = view.client.gui.add_command(
                shortcut.label, hotkey=cast(Any, shortcut.key), modifier=shortcut.modifier
            )
            adapter.on_event(handle, "on_trigger", partial(_do, shortcut, view))


def _do(shortcut: Shortcut, view: Page, _: object) -> None:
    shortcut.act(view)
