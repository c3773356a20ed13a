"""The map of basins with its axes, marks and legend, as markup."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.basins.maps import Map, Question
from armlab.benches.iterate.basins.state import Basins, belongs_elsewhere
from armlab.benches.iterate.basins.ui.picture import FULL, enlarged, pixels, png, scale_of, solution_colour
from armlab.benches.iterate.runs.state import Iterations
from armlab.benches.iterate.runs.ui.words import vector_text
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate.basins import FAILED
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import css
from armlab.ui.file_names import file_name
from armlab.ui.form import Form, Picked
from armlab.ui.format import capitalised, dot, number, so_many, trimmed
from armlab.ui.html import Inside, Markup, joined, styles, tag
from armlab.ui.png import as_address
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

TICKS = 4
"""Number of intervals of an axis."""

MOST_NAMED = 16
"""Largest number of rows of the legend."""

SAME_START = 1e-12
"""Largest difference, in rad or m, of a start of the map and a start of the film that are the same."""


def map_markup(form: Form, found: Map, units: Units, begin: Picked) -> Markup:
    """Return the picture with axes, marks of the solutions, and the marks that `places` moves."""
    question = found.question
    across, up = (_axis(found, side, units) for side in (0, 1))
    picture = png(pixels(found.found))
    said = f"Basins of {question.run.kind.title}: click a start to see its film"
    marks = _solutions(found), tag("b.ba-start"), tag("b.ba-arm")
    return tag(
        "div.basin",
        tag("span.ba-name.up", up[0]),
        tag("div.ba-ticks.up", up[1]),
        tag(
            "div.ba-map", tag("img", alt=said, src=as_address(picture)), marks, title=said, **form.place("start", begin)
        ),
        tag("div.ba-ticks", across[1]),
        tag("span.ba-name", across[0]),
    )


def _axis(found: Map, side: int, units: Units) -> tuple[str, list[Markup]]:
    """Return the name of an axis with its unit, and its numbers."""
    joint = found.question.joints[side]
    revolute = bool(found.question.arm.revolute[joint])
    values = (found.found.across, found.found.up)[side]
    half = 0.5 * float(values[1] - values[0])
    low, high = float(values[0]) - half, float(values[-1]) + half
    ticks = [(k / TICKS, low + (high - low) * k / TICKS) for k in range(TICKS + 1)]
    texts = [tag("i", _tick(value, revolute, units), style=f"--at:{100.0 * at:.2f}%") for at, value in ticks]
    return f"{units.variable(joint, revolute)}, {units.unit(revolute)}", texts


def _tick(value: float, revolute: bool, units: Units) -> str:
    decimals = (0 if units.in_degrees else 2) if revolute else 0 if units.length_unit == "mm" else 2
    return number(value / units.factor(revolute), decimals)


def _solutions(found: Map) -> list[Markup]:
    """Return a numbered mark for each solution inside the map."""
    marks = []
    for k, q in enumerate(found.found.solutions):
        x, y = (found.part(side, float(q[joint])) for side, joint in enumerate(found.question.joints))
        if 0.0 <= x <= 1.0 and 0.0 <= y <= 1.0:
            at = f"--x:{100.0 * x:.2f}%;--y:{100.0 * y:.2f}%;--c:{css(solution_colour(k))}"
            marks.append(tag("i.ba-sol", str(k + 1), style=at, title=found.names[k]))
    return marks


def legend(found: Map, units: Units) -> Inside:
    """Return the solution of each colour, and the share of each and of failures among the starts tried."""
    index = found.found.index[: found.found.rows]
    if not index.size:
        return None
    rows = [
        (dot(css(solution_colour(k))), f"{k + 1}", _name(found.names[k]), float(np.mean(index == k)))
        for k in range(min(len(found.names), MOST_NAMED))
    ]
    more = float(np.mean(index >= MOST_NAMED))
    if more > 0.0:
        rows.append((dot(css(solution_colour(FULL))), "", f"{len(found.names) - MOST_NAMED} more", more))
    most = found.question.most
    rows.append((tag("span.dot.ba-white"), "", f"not reached in {most} steps", float(np.mean(index == FAILED))))
    lines = [([tag("span", text) for text in texts], tag("b", _share(share))) for *texts, share in rows]
    return tag("div.ba-legend", lines), _scale(found), _about(found, units)


def _name(name: str) -> str:
    return capitalised(name) if not name.startswith("solution ") else "Solution"


def _share(share: float) -> str:
    percent = 100.0 * share
    return "< 0.1 %" if 0.0 < percent < 0.05 else f"{number(percent, 1)} %"


def _scale(found: Map) -> Markup | None:
    low, high = scale_of(found.found)
    if not high:
        return None
    if low == high:
        return tag("p.dim", f"Nearly every run that arrived took {so_many(low, 'step')}.")
    return tag("p.dim", f"Bright: {so_many(low, 'step')} or fewer. Dark: {high} or more.")


def _about(found: Map, units: Units) -> Markup:
    """Return the arguments of the map: target, method and the start values of the joints that do not vary."""
    asked = found.question
    target = np.frombuffer(asked.target).reshape(4, 4)
    others = [
        f"{units.variable(i, bool(row.revolute))} = {units.constant(value, bool(row.revolute), 0)}"
        for i, (row, value) in enumerate(zip(asked.arm.rows, asked.rest, strict=True))
        if i not in asked.joints
    ]
    parameters = [
        joined(with_indices(each.symbol), f" = {trimmed(asked.run.values[each.key], 6)}")
        for each in asked.run.kind.parameters
    ]
    with_them = (" (", joined(parameters, between=", "), ")") if parameters else None
    said: list[Inside] = [joined(capitalised(asked.run.kind.title), with_them)]
    said.append(joined(f"target {target_text(asked.arm, target, units)}, task ", vector_text(asked.task)))
    if others:
        said.append(f"starts with {', '.join(others)}")
    said.append("limits kept" if asked.limits == "clamp" else "limits not kept")
    return tag("p.dim", joined(said, between="; "), ".")


def target_text(arm: Arm, target: NDArray[np.floating], units: Units) -> str:
    """Return the place of a target in the world; an arm that moves in a plane of the world has two coordinates."""
    upright = np.array_equal(arm.base[:3, :3], np.eye(3)) and arm.task.position
    seen = target[arm.task.coordinates, 3] if upright else target[:3, 3]
    return f"({', '.join(units.text(float(value), False) for value in seen)}) {units.length_unit}"


def standing(state: State) -> Inside:
    """Return the notes over the picture: that it belongs to another target, and its progress."""
    found, drawing = state[Basins].map, state[Basins].drawing
    if found is None:
        return None
    said = []
    if belongs_elsewhere(state):
        said.append("This map belongs to another target or task: draw it again.")
    if not found.finished and drawing is not found.question:
        said.append(f"Cancelled at {100.0 * found.done:.0f} %.")
    if found.known and not len(found.found.solutions):
        said.append(found.known)
    return [tag("p.warn", text) for text in said]


def places(state: State) -> Markup | None:
    """Return the places of the arm and of the film's start in the map, as style."""
    found = state[Basins].map
    if found is None:
        return None
    values = {"arm": state[Joints].q, "start": np.array(state[Iterations].start)}
    rules = []
    for name, q in values.items():
        x, y = (found.part(side, float(q[joint])) for side, joint in enumerate(found.question.joints))
        seen = 0.0 <= x <= 1.0 and 0.0 <= y <= 1.0 and math.isfinite(x + y)
        rules.append(
            f".al .ba-map .ba-{name}{{--x:{100.0 * x:.2f}%;--y:{100.0 * y:.2f}%;display:{'block' if seen else 'none'}}}"
        )
    return styles(rules)


def here(state: State) -> str:
    """Return the end of the film from the present start, read from the map; it is that of the film if all is equal.

    A start between those of the map may end elsewhere than the nearest of them.
    """
    found, start = state[Basins].map, state[Iterations].start
    if found is None:
        return ""
    x, y = (found.part(side, start[joint]) for side, joint in enumerate(found.question.joints))
    if not (0.0 <= x <= 1.0 and 0.0 <= y <= 1.0):
        return ""
    index, steps = found.outcome(x, y)
    if index != FAILED and index < 0:
        return ""
    ends = (
        f"no solution in {found.question.most} steps"
        if index == FAILED
        else f"ends in {index + 1} after {so_many(steps, 'step')}"
    )
    nearest = found.start(x, y)
    there = all(abs(start[joint] - nearest[joint]) <= SAME_START for joint in found.question.joints)
    same = _is_of_film(state, found.question)
    if same and there:
        return f"◉ The arm. ◇ The film's start: {ends}."
    if same:
        return f"◉ The arm. ◇ The film's start. The nearest start of the map: {ends}."
    if there:
        return f"◉ The arm. ◇ The film's start. As the map was asked for, a start there: {ends}."
    return f"◉ The arm. ◇ The film's start. As the map was asked for, the nearest start of the map: {ends}."


def _is_of_film(state: State, question: Question) -> bool:
    """Return whether the selected run asks what the map has answered: then its film ends as the map tells."""
    part = state[Iterations]
    run, others = part.runs[part.selected], set(range(len(part.start))) - set(question.joints)
    asks = (replace(run, colour=question.run.colour), part.limits, part.most)
    return (
        not belongs_elsewhere(state)
        and asks == (question.run, question.limits, question.most)
        and all(part.start[k] == question.rest[k] for k in others)
    )


def save_link(found: Map, robot: str) -> Markup:
    """Return the link that saves the picture without axes as a PNG file."""
    name = f"basins_{file_name(robot)}_{found.question.run.method}.png"
    picture = as_address(png(enlarged(pixels(found.found))))
    return tag("a.chip", "Save as PNG", data_cell="png", download=name, href=picture)
