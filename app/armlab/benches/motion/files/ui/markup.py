"""Markup of the page for the files of a motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol, Self

from armlab.benches.motion.files.commands import By
from armlab.benches.motion.files.read import MOST_SAMPLES, count_of
from armlab.benches.motion.files.table import MOST_BYTES, MOST_ROWS
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import readable
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.recording import LONGEST

HINTS = {
    "csv": "Time, joint values, velocities and accelerations in s, rad and m; one row for each sample",
    "python": "A script that makes the same motion with the armlab library and writes its samples",
    "json": "Waypoints, moves, limits and the arm; this file can be read here again",
    "html": f"The arm and the path of its tool in real time, at most {LONGEST:g} s; opens without the lab",
    "viser": "The same recording without the page, for viser's own player",
}


@dataclass(frozen=True)
class Shown:
    """Values on the page that are not in the state.

    Attributes
    ----------
    rate : float
        Samples a second.
    count : int
        Waypoints that would be made.
    busy : str
        What is being made or read; empty for nothing.
    saved : str
        What has become of the last file.
    refused, refused_at : str
        Why it has not, and whether that was ``"export"`` or ``"import"``.
    """

    rate: float
    count: int
    busy: str = ""
    saved: str = ""
    refused: str = ""
    refused_at: str = ""

    def but(self, **changes: Any) -> Self:
        """Return the values with changes."""
        return replace(self, **changes)


class Page(Protocol):
    """Actions of the controls."""

    def set_rate(self, text: str) -> None:
        """Set the samples a second."""

    def set_count(self, text: str) -> None:
        """Set the number of waypoints."""

    def make(self, by: By) -> Command:
        """Request waypoints from the motion."""
        ...

    def back(self) -> Command:
        """Request the earlier waypoints."""
        ...

    def save(self, kind: str) -> None:
        """Make a file of a kind."""

    def read(self, text: str) -> None:
        """Read a file."""


def export_markup(form: Form, state: State, shown: Shown, page: Page) -> Markup:
    """Return the buttons that save files."""
    planned = planned_now(state)
    off = planned is None or planned.motion is None or bool(shown.busy)

    def save(kind: str, text: str, off: bool = off) -> Markup:
        return form.chip(kind, text, partial(page.save, kind), HINTS[kind], off=off)

    typed = form.field("rate", readable(shown.rate, 4), "Samples a second", page.set_rate)
    rate = tag("label.option", typed, tag("i", "/s"), title="Samples a second, at least")
    return joined(
        tag("h3", "Save"),
        _motion_line(state, planned, shown.rate),
        _row("Samples", rate, save("csv", "CSV"), save("python", "Python")),
        _row("Recording", save("html", "Web page"), save("viser", ".viser")),
        _row("Plan", save("json", "JSON", bool(shown.busy))),
        _outcome(shown, "export"),
    )


def _row(name: str, *inside: Markup) -> Markup:
    return tag("div.row.files", tag("span", name), tag("div", inside))


def import_markup(form: Form, state: State, shown: Shown, page: Page) -> Markup:
    """Return the field that reads a file, and what can be made from a motion that was read."""
    n = state[Joints].arm.n
    bound = form.bound("read-motion", page.read)
    chosen = tag("input", type="file", accept=".csv,.tsv,.txt,.dat,.json", data_most=MOST_BYTES, **bound)
    load = tag("label.chip", "Read file", chosen, title="The lab reads the file and sends it nowhere else")
    says = (
        f"The file is a plan in JSON, or a table of time and q1 to q{n}. The header gives units (q1_deg, q1 [rad]); "
        f"without any they are s, rad and m. At most {MOST_ROWS} rows, {MOST_BYTES / 1e6:g} MB."
    )
    outcome, motion = _outcome(shown, "import"), _recorded(form, state, shown, page)
    return joined(tag("h3", "Read"), tag("div.bar", load), outcome, motion, tag("p.dim", says))


def _motion_line(state: State, planned: Planned | None, rate: float) -> Markup:
    """Return a line on the motion, and on the size of its table."""
    if planned is None:
        return tag("p.dim", "… planning")
    trouble = f"{planned.trouble.rstrip('.')}."
    if planned.motion is None:
        return tag("p.no", f"✕ No motion: {trouble}")
    part = state[Plan]
    if part.recorded is not None:
        what = f"From a file: {len(part.recorded.t)} samples"
    else:
        what = f"Plan of {len(part.waypoints)} waypoints"
    count = count_of(planned.duration, rate)
    many = f"{count} rows" if count <= MOST_SAMPLES else f"{count} rows are too many (at most {MOST_SAMPLES})"
    line = tag("p.dim", f"{what}, {planned.duration:.2f} s; {many}.")
    return line if planned.whole else joined(line, tag("p.warn", f"◐ Only the part that can be run: {trouble}"))


def _recorded(form: Form, state: State, shown: Shown, page: Page) -> Markup | None:
    """Return the buttons for a motion from a file, or nothing if there is none."""
    if state[Plan].recorded is None:
        return None

    back = form.chip(
        "motion-back",
        "Back to the waypoints",
        page.back,
        "Remove the motion from the file; the waypoints are as they were",
    )
    typed = form.field("count", str(shown.count), "How many waypoints", page.set_count)
    count = tag("label.option", typed, tag("i", "waypoints"))
    hint = "Where a polygon through the others is farthest from the motion"
    by_shape = form.chip("by-shape", "by shape", lambda: page.make("shape"), hint)
    by_time = form.chip("by-time", "evenly", lambda: page.make("time"), "Evenly spaced in time")
    return verdict_box(
        "todo",
        "A motion from a file",
        "It is used instead of the waypoints.",
        tag("div.bar", back),
        "Or convert it to",
        tag("div.bar.made", count, by_shape, by_time),
        sign="",
    )


def _outcome(shown: Shown, where: str) -> Markup | None:
    """Return the result of the last file."""
    if shown.busy and (shown.busy == "read") == (where == "import"):
        doing = "Reading the file" if where == "import" else "Writing the file"
        return tag("p.dim", f"… {doing}", role="status")
    if shown.refused and shown.refused_at == where:
        return tag("p.no", f"✕ {shown.refused}.", role="alert")
    if shown.saved and where == "export":
        return tag("p.ok", f"✓ Saved {shown.saved}", role="status")
    return None
