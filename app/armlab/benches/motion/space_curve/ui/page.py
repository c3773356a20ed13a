"""The laboratory of geometry: one curve in space with its frame, and turning between two orientations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.motion.space_curve.commands import (
    AddPoint,
    ChooseCurve,
    ChooseLaw,
    DrawMarks,
    GoLongWay,
    GoTo,
    LookAt,
    OwnTimes,
    RemovePoint,
    SetAngle,
    SetDuration,
    SetOption,
    SetPoint,
    TakeOrientation,
    TypeFormula,
    UseLength,
    WriteIn,
)
from armlab.benches.motion.space_curve.examples import ChooseExample
from armlab.benches.motion.space_curve.laid import kinds
from armlab.benches.motion.space_curve.stage import sphere_of, stage_of
from armlab.benches.motion.space_curve.state import CLIP_KEY, SpaceCurve, curve_of
from armlab.benches.motion.space_curve.ui.form import curve_form, head, law_form, marks, scales_of
from armlab.benches.motion.space_curve.ui.numbers import at_present, moving, whole
from armlab.benches.motion.space_curve.ui.plots import CurvePlots, TurnPlots
from armlab.benches.motion.space_curve.ui.turn import turn_form, turn_numbers, turn_words
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.option_form import option_value
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tried import plain_number, tried
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the choice of an example, the form, the numbers and the plots."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    top = gui.fields(lambda cell, text: typed(top, cell, text))
    form = gui.fields(lambda cell, text: typed(form, cell, text))
    numbers = gui.fields(lambda cell, text: typed(numbers, cell, text))
    motion, words = gui.html(), gui.html()
    curve_plots, turn_plots = CurvePlots(gui, units_of(state)), TurnPlots(gui, units_of(state))

    def show(state: State) -> None:
        nonlocal present
        present = state
        top.show(head(top, state))
        if state[SpaceCurve].shown == "curve":
            form.show(marks(form, state) + curve_form(form, state) + law_form(form, state))
            numbers.show(at_present(numbers, state))
            motion.show(moving(state))
            words.show(whole(state))
        else:
            form.show(turn_form(form, state) + law_form(form, state))
            numbers.show(turn_numbers(numbers, state))
            motion.show("")
            words.show(turn_words())
        curve_plots.show(state)
        turn_plots.show(state)

    return show


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for; none for what no page of ours sends.

    Raises
    ------
    InputError
        What was typed is no number; the text names the field.
    """
    name, _, rest = cell.partition(" ")
    if name in ("example", "curve", "law", "axes") and not text:
        return ()
    if name[:2] in ("o-", "l-"):
        return (_option(state, name[:2], name[2:], text),)
    found = _pressed(name, rest) or _typed(state, name, rest, text)
    return () if found is None else (found,)


def _pressed(name: str, rest: str) -> Command | None:
    """Return the command of a button."""
    on = rest == "on"
    simple: dict[str, Callable[[], Command]] = {
        "shown": lambda: LookAt("turn" if rest == "turn" else "curve"),
        "play-curve": lambda: OpenClip(CLIP_KEY, play=True),
        "pause-curve": lambda: Play(False),
        "length": lambda: UseLength(on),
        "frame": lambda: DrawMarks("frame", on),
        "arrows": lambda: DrawMarks("arrows", on),
        "add-point": AddPoint,
        "own-times": OwnTimes,
        "about": lambda: WriteIn(fixed=rest == "fixed"),
        "long": lambda: GoLongWay(on),
    }
    if name == "drop" and rest.isdecimal():
        return RemovePoint(int(rest))
    end, _, source = rest.partition(" ")
    if name == "take":
        return TakeOrientation("A" if end == "A" else "B", source)
    return simple[name]() if name in simple else None


def _typed(state: State, name: str, rest: str, text: str) -> Command | None:
    """Return the command of a field or of a choice."""
    units = units_of(state)
    numbers = [int(each) for each in rest.split() if each.isdecimal()]
    if name == "p" and len(numbers) == 2:
        i, j = numbers
        return SetPoint(i, j, units.read(text, False, f"waypoint {i + 1}, {'xyz'[j % 3]}"))
    if name == "f" and numbers and numbers[0] < 3:
        return TypeFormula(numbers[0], text)
    if name == "a" and len(numbers) == 1 and numbers[0] < 3:
        end = "A" if rest.startswith("A") else "B"
        value = units.read(text, True, f"angle {numbers[0] + 1} of {end}")
        return SetAngle("A" if end == "A" else "B", numbers[0], value)
    simple: dict[str, Callable[[], Command]] = {
        "example": lambda: ChooseExample(text),
        "curve": lambda: ChooseCurve(text),
        "law": lambda: ChooseLaw(text),
        "axes": lambda: WriteIn(axes=text),
        "T": lambda: SetDuration(_number(text, "T")),
        "s": lambda: GoTo(_number(text, "s")),
        "sigma": lambda: GoTo(units.read(text, False, "σ") / state.derived(curve_of).arc.length),
    }
    return simple[name]() if name in simple else None


def _number(text: str, where: str) -> float:
    try:
        return plain_number(text)
    except InputError as refusal:
        raise InputError(f"{where}: {refusal}") from None


def _option(state: State, prefix: str, key: str, text: str) -> Command:
    """Return the command of an option of the curve ("o-") or of the law ("l-")."""
    part = state[SpaceCurve]
    of, chosen = ("curve", part.curve) if prefix == "o-" else ("law", part.law)
    known = {field.key: field for field in (kinds() if of == "curve" else free_law_types())[chosen.key].fields}
    if key not in known:
        raise InputError(f"option: {chosen.key} has none that is called {key[:40]!r}")
    scales = {"scales": scales_of(units_of(state))} if of == "curve" else {}
    return SetOption(of, key, option_value(known[key].seen(chosen.options), text, chosen.options.get(key), **scales))


def _around(state: State) -> Points:
    """Return what is drawn beside the arm: the curve, or a box around the sphere of the turn."""
    if state[SpaceCurve].shown == "turn":
        centre, radius = sphere_of(state)
        return np.asarray(centre + radius * np.array([[1.0, 1, 1], [-1, -1, -1]]))
    return state.derived(stage_of).at(state.derived(curve_of).frame.position)


PANEL = Panel((SpaceCurve, Timeline, Notation, RobotPart), build, rebuilds=(Notation,), around=_around)
