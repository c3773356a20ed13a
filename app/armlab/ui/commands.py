"""The command palette (Ctrl+K) and the keys."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import RandomPose, TakePose
from armlab.session.parts.target import TargetToTool
from armlab.session.session import Redo, Undo
from armlab.ui import adapter

if TYPE_CHECKING:
    from armlab.ui.view import View


@dataclass(frozen=True)
class Shortcut:
    """One entry of the palette.

    Parameters
    ----------
    label : str
    key : str or None
        viser's name of the key; None for an entry without one.
    shown : str
        The key as people write it.
    act : callable
        Gets the view.
    modifier : str or None
    """

    label: str
    key: str | None
    shown: str
    act: Callable[[View], None]
    modifier: Literal["cmd/ctrl", "cmd/ctrl+shift"] | None = None


def _toggle(name: str) -> Callable[[View], None]:
    return lambda view: view.post(Show(name, not getattr(view.session.state[Display], name)))


SHORTCUTS: tuple[Shortcut, ...] = (
    Shortcut("Help", "H", "H", lambda view: view.open_tab("Help")),
    Shortcut("Undo", "Z", "Ctrl+Z", lambda view: view.post(Undo()), "cmd/ctrl"),
    Shortcut("Redo", "Z", "Ctrl+Shift+Z", lambda view: view.post(Redo()), "cmd/ctrl+shift"),
    Shortcut("Home pose", "O", "O", lambda view: view.post(TakePose(next(iter(view.session.robot.poses))))),
    Shortcut("Zero pose", "0", "0", lambda view: view.post(TakePose("zero"))),
    Shortcut("Random pose", "R", "R", lambda view: view.post(RandomPose())),
    Shortcut("Target back to the tool", "B", "B", lambda view: view.post(TargetToTool())),
    Shortcut("Show or hide frames", "F", "F", _toggle("frames")),
    Shortcut("Show or hide joint names", "N", "N", _toggle("names")),
    Shortcut("Skeleton or bodies", "K", "K", _toggle("skeleton")),
    Shortcut("Trace of the tool on or off", "T", "T", _toggle("trace")),
    Shortcut("Light or dark theme", "L", "L", _toggle("dark")),
    Shortcut("Look from home", "C", "C", lambda view: view.camera.look_from("Home")),
    Shortcut("Look from the front", None, "", lambda view: view.camera.look_from("Front")),
    Shortcut("Look from the side", None, "", lambda view: view.camera.look_from("Side")),
    Shortcut("Look from the top", None, "", lambda view: view.camera.look_from("Top")),
    Shortcut("Open Robot", None, "", lambda view: view.open_tab("Robot")),
    Shortcut("Open Joints", None, "", lambda view: view.open_tab("Joints")),
    Shortcut("Open Target", None, "", lambda view: view.open_tab("Target")),
    Shortcut("Open View", None, "", lambda view: view.open_tab("View")),
)


def register(view: View) -> None:
    """Add all entries to the palette of a browser."""
    for shortcut in SHORTCUTS:
        handle = view.client.gui.add_command(shortcut.label, hotkey=shortcut.key, modifier=shortcut.modifier)
        adapter.on_event(handle, "on_trigger", lambda _, act=shortcut.act: act(view))
