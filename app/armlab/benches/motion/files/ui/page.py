"""Files of a motion: samples, a script, a recording, the plan itself; and motions and plans read from files."""

from __future__ import annotations

import asyncio
import logging
import math
from collections.abc import Callable
from typing import Any, cast

from armlab.benches.motion.files.commands import MOST_MADE, BackToWaypoints, By, MakeWaypoints, reading
from armlab.benches.motion.files.read import RATE, checked_rate, motion_csv, plan_json, refuse_long
from armlab.benches.motion.files.script import motion_script
from armlab.benches.motion.files.table import MOST_BYTES
from armlab.benches.motion.files.ui.markup import Shown, export_markup, import_markup
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.ui.around import way_around, while_on
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Post, State, guard
from armlab.ui import recording
from armlab.ui.file_names import file_name
from armlab.ui.format import number
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import plain_number
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

MADE = 8
"""Number of waypoints that are made from a motion unless another is typed."""


class MotionFiles:
    """The page of the files of a motion.

    Files that take longer than a student should wait are made by a thread of its own; until then its buttons are off.

    Parameters
    ----------
    gui : Gui
    state : State
    post : callable
    """

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._post = gui, state, post
        self._shown = Shown(RATE, MADE)
        self._waiting: str | None = None  # text of a file that came while another was made or read: the last one counts
        self._export, self._import = gui.form(post), gui.form(post, MOST_BYTES)

    def show(self, state: State) -> None:
        """Show the files that can be saved, and the result of reading."""
        self._state = state
        self._export.show(export_markup(self._export, state, self._shown, self))
        self._import.show(import_markup(self._import, state, self._shown, self))

    # -- what a person does --------------------------------------------------------------------------------------

    def set_rate(self, text: str) -> None:
        """Set the samples a second of the next table."""
        self._clear()
        self._shown = self._shown.but(rate=checked_rate(plain_number(text, "samples a second")))

    def set_count(self, text: str) -> None:
        """Set the number of waypoints to be made."""
        self._clear()
        self._shown = self._shown.but(count=_checked_count(text))

    def make(self, by: By) -> Command:
        """Request waypoints from the motion, in the number that was typed last."""
        self._clear()
        return MakeWaypoints(self._shown.count, by)

    def back(self) -> Command:
        """Request the earlier waypoints."""
        self._clear()
        return BackToWaypoints()

    def _clear(self) -> None:
        """Remove the result of the last file."""
        self._shown = self._shown.but(saved="", refused="")

    # -- files ---------------------------------------------------------------------------------------------------

    def save(self, kind: str) -> None:
        """Make a file and let the browser save it."""
        self._clear()
        state, name = self._state, f"{file_name(self._state[RobotPart].robot.name)}_motion"
        make = (lambda: plan_json(state)) if kind == "json" else self._making(kind, _runs(state), name)
        ending = {"python": "py"}.get(kind, kind)
        self._shown = self._shown.but(busy=kind)
        self._begin(make, lambda content: self._saved(f"{name}.{ending}", content), "export")

    def _making(self, kind: str, planned: Planned, name: str) -> Callable[[], str | bytes]:
        """Return the function that makes a file of the motion; `InputError` if the file would be too large."""
        state, rate, motion = self._state, self._shown.rate, planned.motion
        assert motion is not None
        if kind in ("html", "viser"):
            recording.refuse_long(motion.duration)
            view = self._gui.camera.as_view()
            eye = (math.radians(view.azimuth_deg), math.radians(view.elevation_deg))
            return lambda: recording.record(recording.Scenario(state, motion, *eye), cast(recording.Kind, kind))
        refuse_long(motion.duration, rate)
        if kind == "csv":
            return lambda: motion_csv(state[Joints].arm, motion, rate, planned.grips)
        return lambda: motion_script(state[RobotPart], planned, rate, f"{name}.csv")

    def _saved(self, name: str, content: str | bytes) -> None:
        self._gui.save(name, content)
        size = len(content.encode() if isinstance(content, str) else content)
        self._shown = self._shown.but(saved=f"{name}, {size_text(size)}")

    def read(self, text: str) -> None:
        """Read a file; an error in it, or why an open lesson refuses it, is shown here, and the plan stays."""
        self._clear()
        if self._shown.busy:
            self._waiting = text
            return
        state, command = self._state, reading(text)
        self._shown = self._shown.but(busy="read")
        self._begin(lambda: guard(state, command.apply(state)), lambda _: self._post(command), "import")

    def _begin(self, make: Callable[[], Any], done: Callable[[Any], None], where: str) -> None:
        """Start making a file beside the lab's own work, and continue with the result."""
        future = asyncio.get_running_loop().run_in_executor(recording.maker(), make)
        future.add_done_callback(lambda made: self._finish(made, done, where))

    def _finish(self, made: asyncio.Future[Any], done: Callable[[Any], None], where: str) -> None:
        self._shown = self._shown.but(busy="")
        failure = None if made.cancelled() else made.exception()
        if isinstance(failure, InputError):
            self._shown = self._shown.but(refused=str(failure).rstrip("."), refused_at=where)
        elif failure is not None:
            log.error("a file of a motion failed", exc_info=failure)
            what = "The file could not be handled because of a fault in the lab; nothing was changed"
            self._shown = self._shown.but(refused=what, refused_at=where)
        elif not made.cancelled():
            done(made.result())
        if self._waiting is not None:
            text, self._waiting = self._waiting, None
            self.read(text)
        self.show(self._state)


def _runs(state: State) -> Planned:
    """Return the planned motion of a state; `InputError` if it cannot be run."""
    planned = planned_now(state)
    if planned is None:
        raise InputError("the motion is still being planned")
    if planned.motion is None:
        raise InputError(f"there is no motion to save: {planned.trouble}")
    return planned


def size_text(size: int) -> str:
    """Return the size of a file from its bytes.

    >>> size_text(1), size_text(14_200), size_text(1_234_567)
    ('0.1 kB', '14 kB', '1.23 MB')
    """
    if size >= 999_500:
        return f"{number(size / 1e6, 2)} MB"
    return f"{number(max(size / 1e3, 0.1), 1 if size < 9950 else 0)} kB"


def _checked_count(text: str) -> int:
    count = plain_number(text, "waypoints", f"a whole number from 2 to {MOST_MADE}")
    if count not in range(2, MOST_MADE + 1):
        raise InputError(f"waypoints: expected a whole number from 2 to {MOST_MADE}, got {text.strip()[:40]!r}")
    return int(count)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the page."""
    return MotionFiles(gui, state, post).show


PANEL = Panel((RobotPart, Plan), build, rebuilds=(), hides_then=while_on, around=way_around)
