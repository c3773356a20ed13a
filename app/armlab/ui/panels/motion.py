"""Motion: waypoints, the moves between them, and what becomes of them."""

from __future__ import annotations

from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the list of waypoints."""
    gui.html("")
    return lambda state: None


PANEL = Panel("motion", "Motion", "ROUTE", 39, (Joints,), build, page="Plan")
