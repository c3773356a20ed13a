"""The iterates of the selected run around the present one, in numbers."""

from __future__ import annotations

from typing import NamedTuple

from armlab.benches.iterate.runs.clip import each, place_of
from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations
from armlab.kin.ik.iterate import TaskVector
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised, number, scientific
from armlab.ui.html import Inside, classes, tag
from armlab.ui.small_numbers import HUGE, NO_BREAK, small
from armlab.ui.units import Units, units_of

ROWS = 7
"""Number of rows shown at once, with the present one in the middle if possible."""

IN_LINE = 2
"""Largest number of joints with their values in the row itself; others have them in a line below the present one."""


class Numbers(NamedTuple):
    """Markup in the row of an iterate after its name, and in the line below, which may be empty."""

    cells: tuple[str, ...]
    below: str


class Table:
    """The table of one panel; the numbers of a row are written once for each film, in which they do not change."""

    def __init__(self, form: Form) -> None:
        self._form = form
        self._film: Film | None = None
        self._units: Units | None = None
        self._rows: dict[int, Numbers] = {}

    def show(self, state: State) -> None:
        """Show the rows around the present one; a press on the number of a row shows that iterate."""
        part, units = state[Iterations], units_of(state)
        film = part.film
        if film is None:
            self._form.show(tag("h3", "Iterates"), tag("p.dim", "…"))
            return
        if film is not self._film or units != self._units:
            self._film, self._units, self._rows = film, units, {}
        i, _ = place_of(state)
        first = max(0, min(i - ROWS // 2, film.last - ROWS + 1))
        shown = range(first, min(first + ROWS, film.last + 1))
        on = () if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY),)
        rows = [self._row(film, k, k == i, units, (*on, Seek(k * each(film)))) for k in shown]
        top = [tag("th", head) for head in _columns(film, units)]
        title = "Instants" if film.t is not None else "Iterates"
        self._form.show(
            tag("h3", f"{title} of run {part.selected + 1}"),
            tag("table.kit-table", tag("tr", top), rows),
            tag("p.dim", f"{capitalised(film.scaling)}."),
        )

    def _row(self, film: Film, k: int, present: bool, units: Units, to_it: tuple[Command, ...]) -> Inside:
        if k not in self._rows:
            self._rows[k] = _numbers(film, k, units)
        cells, below = self._rows[k]
        name = f"{film.t[k]:.2f}" if film.t is not None else str(k)
        head = self._form.button(f"row {k}", name, to_it, "copy", "Show this iterate")
        row, here = classes("tr", now=present), "true" if present else None
        line = tag(row, tag("td", head), [tag("td", cell) for cell in cells], aria_current=here)
        joints = tag("td.it-q", f"q = {below}", colspan=len(cells) + 1)
        return line, tag(row, joints, aria_current=here) if below and present else None


def _columns(film: Film, units: Units) -> list[str]:
    arm, vector = film.question.arm, film.question.task or TaskVector(film.question.arm.task)
    heads = ["t, s" if film.t is not None else "k"]
    if arm.n <= IN_LINE:
        heads += [f"{units.variable(i, bool(t))}, {units.unit(bool(t))}" for i, t in enumerate(arm.revolute)]
    if vector.task.position:
        heads.append(f"|e|, {units.length_unit}")
    if vector.task.rotation != "none":
        heads.append(f"|e|, {units.angle_unit}")
    for joint, _ in vector.joints:
        turns = bool(arm.revolute[joint - 1])
        heads.append(f"e of {units.variable(joint - 1, turns)}, {units.unit(turns)}")
    if arm.revolute.any():
        heads.append(f"|Δq|, {units.angle_unit}")
    if not arm.revolute.all():
        heads.append(f"|Δq|, {units.length_unit}")
    return heads


def _numbers(film: Film, k: int, units: Units) -> Numbers:
    arm, vector = film.question.arm, film.question.task or TaskVector(film.question.arm.task)
    cells = []
    values = [_value(float(q), bool(turns), units) for q, turns in zip(film.q[k], arm.revolute, strict=True)]
    if arm.n <= IN_LINE:
        cells += values
    if vector.task.position:
        cells.append(small(float(film.position_error[k]), False, units))
    if vector.task.rotation != "none":
        cells.append(small(float(film.rotation_error[k]), True, units))
    for j, (joint, _) in enumerate(vector.joints):
        cells.append(small(float(film.components[k, vector.task.m + j]), bool(arm.revolute[joint - 1]), units))
    turn, slide = film.step_lengths
    if arm.revolute.any():
        cells.append(small(float(turn[k]), True, units) if k < film.last else "")
    if not arm.revolute.all():
        cells.append(small(float(slide[k]), False, units) if k < film.last else "")
    if arm.n <= IN_LINE:
        return Numbers(tuple(cells), "")
    joints = ", ".join(values)
    if arm.revolute.all() or not arm.revolute.any():
        joints = f"({joints}){NO_BREAK}{units.unit(bool(arm.revolute[0]))}"
    else:
        turned = zip(values, arm.revolute, strict=True)
        joints = ", ".join(
            f"{value}{'' if turns and units.in_degrees else NO_BREAK}{units.unit(bool(turns))}"
            for value, turns in turned
        )
    return Numbers(tuple(cells), joints)


def _value(value: float, revolute: bool, units: Units) -> str:
    scaled = value / units.factor(revolute)
    return scientific(scaled, 2) if abs(scaled) >= HUGE else number(scaled, units.decimals(revolute))
