"""What the page of the files of a motion says."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol, Self

from armlab.benches.motion.files.commands import By
from armlab.benches.motion.files.read import MOST_SAMPLES, count_of
from armlab.benches.motion.files.table import MOST_BYTES, MOST_ROWS
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.state import Plan, planned
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import escaped, readable
from armlab.ui.recording import LONGEST

HINTS = {
    "csv": "Time, joint values, velocities and accelerations in s, rad and m; one row a sample",
    "python": "A script that makes the motion again with armlab alone, and writes its samples",
    "json": "Waypoints, moves, limits and the arm, to be read here again",
    "html": f"The arm and the path of its tool in real time, at most {LONGEST:g} s; opens without the lab",
    "viser": "The same recording without the page, for viser's own player",
}


@dataclass(frozen=True)
class Shown:
    """What stands on the page besides the state.

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
        """Return the same with changes."""
        return replace(self, **changes)


class Page(Protocol):
    """What the controls do."""

    def set_rate(self, text: str) -> None:
        """Take samples a second."""

    def set_count(self, text: str) -> None:
        """Take a number of waypoints."""

    def make(self, by: By) -> Command:
        """Ask for waypoints of the motion."""
        ...

    def back(self) -> Command:
        """Ask for the waypoints as they were."""
        ...

    def save(self, kind: str) -> None:
        """Make a file of a kind."""

    def read(self, text: str) -> None:
        """Read a file."""


def export_markup(form: Form, state: State, shown: Shown, page: Page) -> str:
    """Return what can be saved."""
    plan = planned(state)
    off = plan is None or plan.motion is None or bool(shown.busy)

    def save(kind: str, text: str, off: bool = off) -> str:
        return form.chip(kind, text, partial(page.save, kind), HINTS[kind], off=off)

    typed = form.field("rate", readable(shown.rate, 4), "Samples a second", page.set_rate)
    rate = f'<label class="option" title="Samples a second, at least">{typed}<i>/s</i></label>'
    rows = (
        ("Samples", rate + save("csv", "CSV") + save("python", "Python")),
        ("Recording", save("html", "Web page") + save("viser", ".viser")),
        ("Plan", save("json", "JSON", bool(shown.busy))),
    )
    table = "".join(f'<div class="row files"><span>{name}</span><div>{inside}</div></div>' for name, inside in rows)
    return f"<h3>Save</h3>{_motion_line(state, plan, shown.rate)}{table}{_outcome(shown, 'export')}"


def import_markup(form: Form, state: State, shown: Shown, page: Page) -> str:
    """Return how a file is read, and what can be made of a motion that was."""
    n = state[Joints].arm.n
    load = (
        f'<label class="chip" title="It is read here and sent nowhere else">Read file'
        f'<input type="file" accept=".csv,.tsv,.txt,.dat,.json" data-most="{MOST_BYTES}"'
        f" {form.bound('read-motion', page.read)}></label>"
    )
    says = (
        f"A plan in JSON, or a table: time and q1 to q{n}. Units as in its header (q1_deg, q1 [rad]); none: s, rad, m. "
        f"At most {MOST_ROWS} rows, {MOST_BYTES / 1e6:g} MB."
    )
    outcome, motion = _outcome(shown, "import"), _recorded(form, state, shown, page)
    return f'<h3>Read</h3><div class="bar">{load}</div>{outcome}{motion}<p class="dim">{says}</p>'


def _motion_line(state: State, plan: Planned | None, rate: float) -> str:
    """Return what the motion is, and how much a table of it would be."""
    if plan is None:
        return '<p class="dim">… working it out</p>'
    if plan.motion is None:
        return f'<p class="no">✕ No motion: {escaped(plan.trouble.rstrip("."))}.</p>'
    part = state[Plan]
    if part.recorded is not None:
        what = f"From a file: {len(part.recorded.t)} samples"
    else:
        what = f"Plan of {len(part.waypoints)} waypoints"
    count = count_of(plan.duration, rate)
    many = f"{count} rows" if count <= MOST_SAMPLES else f"{count} rows are too many (at most {MOST_SAMPLES})"
    line = f'<p class="dim">{what}, {plan.duration:.2f} s; {many}.</p>'
    if plan.whole:
        return line
    return f'{line}<p class="warn">◐ Only what can be run: {escaped(plan.trouble.rstrip("."))}.</p>'


def _recorded(form: Form, state: State, shown: Shown, page: Page) -> str:
    """Return what can be done with a motion from a file; nothing where there is none."""
    if state[Plan].recorded is None:
        return ""

    back = form.chip("motion-back", "Back to the waypoints", page.back, "They wait as they were")
    typed = form.field("count", str(shown.count), "How many waypoints", page.set_count)
    count = f'<label class="option">{typed}<i>waypoints</i></label>'
    hint = "Where a polygon through the others is farthest from the motion"
    kinds = form.chip("by-shape", "by shape", lambda: page.make("shape"), hint)
    kinds += form.chip("by-time", "evenly", lambda: page.make("time"), "Evenly spaced in time")
    return (
        '<div class="verdict todo"><b>A motion from a file</b>It stands in place of the waypoints.'
        f'<div class="bar">{back}</div>Or make of it<div class="bar made">{count}{kinds}</div></div>'
    )


def _outcome(shown: Shown, where: str) -> str:
    """Return what has become of the last file."""
    if shown.busy and (shown.busy == "read") == (where == "import"):
        doing = "Reading the file" if where == "import" else "Making the file"
        return f'<p class="dim" role="status">… {doing}</p>'
    if shown.refused and shown.refused_at == where:
        return f'<p class="no" role="alert">✕ {escaped(shown.refused)}.</p>'
    if shown.saved and where == "export":
        return f'<p class="ok" role="status">✓ Saved {escaped(shown.saved)}</p>'
    return ""
