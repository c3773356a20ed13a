"""The sampled workspace in words and numbers: scale of colours, results, the chosen point."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from armlab.benches.workspace.cloud.cuts import AXES, cut_of
from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import GoToSample, Workspace
from armlab.benches.workspace.cloud.ui import measured
from armlab.benches.workspace.cloud.view import drawing, kept
from armlab.kin.workspace.measures import measure_named
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised, pairs
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Points
from armlab.ui.units import Units


def counted(count: int) -> str:
    """Return a number of samples with thin spaces."""
    return f"{count:,}".replace(",", "\u202f")


def with_unit(found: Sampled, value: float) -> str:
    """Return a value of the measure with its unit."""
    unit = measure_named(found.question.measure).unit(found.question.arm)
    return f"{measured.figure(value)} {unit}".strip()


def scale(found: Sampled) -> Markup:
    """Return the colours and their meaning."""
    return measured.scale(found.question.arm, found.question.measure, found.low, found.high)


def facts(state: State, found: Sampled, units: Units) -> Inside:
    """Return the results in numbers."""
    left = int(np.count_nonzero(state.derived(kept)))
    rows = [("Samples", counted(found.done))]
    if drawing(state) == "cloud":
        rows.append(("Points drawn", f"{counted(left)} of the first {counted(len(found.shown.points))}"))
    rows.append(("Farthest sample, from frame 0", units.length(found.farthest)))
    drawn = drawing(state) != "surface" or state[Workspace].section is None
    return None if left or not drawn else tag("p.dim", _hidden(state)), pairs(rows)


def _hidden(state: State) -> str:
    """Return why no sample is drawn."""
    cut = cut_of(state[Workspace])
    if cut in AXES:
        return "No sample lies here: move the slice."
    return "The cut hides all samples: choose another." if cut == "front" else "No sample is near the boundary."


def chosen(form: Form, state: State, units: Units, ways: Callable[[int], Command]) -> Inside:
    """Return the chosen point, and the buttons for it; ``ways`` gets its number."""
    part = state[Workspace]
    found, index = part.found, part.chosen
    if found is None or index is None or index >= len(found.shown.points):
        return None
    point = found.shown.points[index]
    place = ", ".join(units.text(float(value), False) for value in point)
    value = with_unit(found, float(found.shown.values[index]))
    there = _is_there(state, found, index)
    here = "The arm is there." if there else _elsewhere(state, point)
    title = measure_named(found.question.measure).title
    go = form.chip("again", "Go there", GoToSample(index), "Move the arm to this configuration", off=there)
    target = "Move the target there and open the page Solutions"
    all_ways = form.chip("ways", "All solutions here", partial(ways, index), target)
    said = f"{capitalised(title)} {value}. {here}"
    return verdict_box("ok", f"({place}) {units.length_unit}", said, sign="◉"), tag("div.bar", go, all_ways)


def _elsewhere(state: State, point: Points) -> str:
    """Return where the arm is that does not have the joint values of a sample, as where a joint is held."""
    met = np.allclose(state[Joints].tool_pose[:3, 3], point, atol=1e-4)
    return "The tool point is there, with other joint values." if met else "The arm is not there."


def _is_there(state: State, found: Sampled, index: int) -> bool:
    return bool(np.allclose(state[Joints].q, found.shown.q[index], atol=1e-4))
