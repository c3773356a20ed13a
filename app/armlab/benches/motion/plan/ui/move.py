"""The move to the selected waypoint: space, path, law and their options."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption
from armlab.benches.motion.plan.laws import RAMPS, shaped_by_limits
from armlab.benches.motion.plan.moves import TURNINGS, Move, Stretch
from armlab.benches.motion.plan.question import Leg
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.kin.motion import law_types, path_types
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.form import Form, Typed
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale
from armlab.ui.units import units_of

SPACES = {"joint": "In joint space", "cartesian": "In Cartesian space"}


class Industrial(NamedTuple):
    """Two names of a move in the languages of industrial robots, and a sentence on it."""

    name: str
    other: str
    says: str


INDUSTRIAL = {
    ("joint", "line"): Industrial(
        "Move J", "PTP", "point-to-point motion along a straight line in joint space; the tool follows some curve"
    ),
    ("cartesian", "line"): Industrial(
        "Move L", "LIN", "the tool moves along a straight line; inverse kinematics gives the joint values"
    ),
    ("cartesian", "circle"): Industrial(
        "Move C", "CIRC", "the tool moves along a circular arc through three waypoints"
    ),
}
"""These names, by the space and the path of a move; other moves have none that is common."""


def industrial(move: Move) -> Industrial | None:
    """Return the names of a move in the languages of industrial robots, if it has some."""
    return INDUSTRIAL.get((move.space, move.path.key))


def move_markup(form: Form, state: State) -> Markup | None:
    """Return the choices for the move to the selected waypoint, or for the first waypoint a sentence."""
    part = state[Plan]
    if part.recorded is not None:
        return None
    if not part.selected or part.stretch is None:
        text = "The motion begins at waypoint 1. Select a later one to choose the move that leads to it."
        return tag("p.dim", text)
    stretch, k = part.stretch, part.selected
    move = stretch.move
    hint = "Give all moves the settings of this one"
    like = form.chip("all-like", "Apply to all moves", AllMovesLike(k), hint, off=len(part.moves) == 1)
    spaces = [
        form.chip(f"space-{key}", text, SetMove(k, space=key), "Space in which the path is defined", key == move.space)
        for key, text in SPACES.items()
    ]
    paths = {key: kind.title for key, kind in path_types().items() if move.space in kind.spaces}
    laws = {key: kind.title for key, kind in law_types().items()}
    return joined(
        tag("h3", f"Move {stretch.title}", tag("span.copies", like)),
        _named(form, k, move),
        tag("div.bar", spaces, _stop(form, part, stretch)),
        _choice(form, "path", "Path", paths, move.path.key, lambda path: SetMove(k, path=path)),
        _path_form(form, k, move, state),
        _together(form, k, move),
        _turning(form, k, stretch, state),
        _choice(form, "law", "Law", laws, move.law.key, lambda law: SetMove(k, law=law)),
        _law_form(form, k, stretch, state),
        _bounds(state, stretch),
    )


def _named(form: Form, k: int, move: Move) -> Inside:
    """Return the moves that have names of their own, to be chosen by these, and what the chosen one is."""
    here = industrial(move)
    chips = [
        form.chip(
            f"named-{space}-{path}",
            f"{each.name} ({each.other})",
            SetMove(k, space=space, path=path),
            capitalised(each.says),
            each is here,
        )
        for (space, path), each in INDUSTRIAL.items()
    ]
    says = tag("p.dim", f"{here.name}, or {here.other}: {here.says}.") if here is not None else None
    return tag("div.bar", chips), says


def _choice(form: Form, cell: str, title: str, texts: dict[str, str], chosen: str, action: Typed) -> Markup:
    return tag("div.option.wide", tag("span", title), form.select(cell, title, texts, chosen, action))


def _path_form(form: Form, k: int, move: Move, state: State) -> Markup | None:
    found = option_form(
        form, "path ", move.kind.fields, move.path.options, partial(SetMoveOption, k, "path"), scales(state)
    )
    return tag("div.options", found) if found else None


def _law_form(form: Form, k: int, stretch: Stretch, state: State) -> Inside:
    """Return the options of the law; ramps that the limits shape are grey, and empty unless they are typed."""
    law, timed = stretch.move.law, state[Plan].duration is not None
    kinds, by_limits = law_types()[law.key].fields, not timed or shaped_by_limits(stretch)
    given = {**dict.fromkeys(RAMPS), **law.options} if by_limits else law.options
    off = () if timed and not stretch.move.independent else RAMPS
    found = option_form(form, "law ", kinds, given, partial(SetMoveOption, k, "law"), scales(state), off=off)
    ramps = by_limits and any(kind.key in RAMPS for kind in kinds)
    return tag("div.options", found) if found else None, tag("p.dim", _why_by_limits(stretch, timed)) if ramps else None


def _why_by_limits(stretch: Stretch, timed: bool) -> str:
    if stretch.move.independent:
        return "The limits shape the ramps of independent joints."
    if timed:
        return "While nothing is typed for the ramps, they are those of the fastest motion."
    return "The limits shape the ramps of the fastest motion; typed ones count in a given time."


def _turning(form: Form, k: int, stretch: Stretch, state: State) -> Markup | None:
    move = stretch.move
    if move.space == "joint" or state[Joints].arm.task.rotation == "none":
        return None
    texts = {str(key): text for key, text in TURNINGS.items()}
    choice = _choice(form, "turning", "Orientation", texts, move.turning, lambda turning: SetMove(k, turning=turning))
    leg = _leg(state, stretch)
    if leg is None or leg.tool_path is None or not leg.tool_path.orientation.goes_on:
        return choice
    return joined(choice, tag("p.dim", "It goes on smoothly past the waypoints: the angular velocity does not jump."))


def _together(form: Form, k: int, move: Move) -> Markup | None:
    """Return the choice whether the joints of a straight joint move go together."""
    if move.space != "joint" or move.path.key != "line":
        return None
    hint = "All joints start and end together, or each moves as fast as it can and the first ones wait"
    return tag(
        "div.bar",
        form.chip("together", "Coordinated joints", SetMove(k, apart=False), hint, not move.apart),
        form.chip("apart", "Independent joints", SetMove(k, apart=True), hint, move.apart),
    )


def _leg(state: State, stretch: Stretch) -> Leg | None:
    """Return what has become of a stretch, as far as it is planned by now."""
    planned = planned_now(state)
    return None if planned is None else next((leg for leg in planned.legs if leg.stretch == stretch), None)


def _bounds(state: State, stretch: Stretch) -> Markup | None:
    """Return the bounds of the law from the limits of the joints, as in section 6.1.1."""
    leg = _leg(state, stretch)
    if leg is None or leg.bounds is None:
        return None
    bounds = leg.bounds
    speed = f"|ṡ| ≤ {bounds.V:.3g} 1/s" + (f" (joint {bounds.V_joint})" if bounds.V_joint else "")
    growth = f"|s̈| ≤ {bounds.A:.3g} 1/s²" + (f" (joint {bounds.A_joint})" if bounds.A_joint else "")
    hint = (
        "Safe bounds for the law, from the limits of the joints⟦ (6.1.1)⟧; the motion is then scaled until it "
        "just reaches a limit"
    )
    return tag("p.dim", f"{speed}, {growth}", title=hint)


def _stop(form: Form, part: Plan, stretch: Stretch) -> Markup | None:
    """Return the choice of a stop at the selected waypoint, if the path could pass through."""
    k = part.selected
    if k >= len(part.waypoints) - 1:
        return None
    move, after = part.moves[k - 1], part.moves[k]
    through = move.kind.most is None and move.through() == after.through()
    if not through:
        return None
    hint = "Stop here, although the path could pass through"
    return form.chip("stop", f"Stop at {k + 1}", SetMove(k, stop=not move.stop), hint, move.stop)


def scales(state: State) -> tuple[Scale, ...]:
    """Return the units of the coordinates of the move: of the joints, or lengths."""
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    stretch = part.stretch
    if stretch is not None and stretch.move.space == "cartesian":
        return (Scale(units.length_unit, units.factor(False)),)
    return tuple(Scale(units.unit(bool(turns)), units.factor(bool(turns))) for turns in arm.revolute)
