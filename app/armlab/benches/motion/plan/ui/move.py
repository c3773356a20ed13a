"""The move to the selected waypoint: space, path, law and their options."""

from __future__ import annotations

from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption
from armlab.benches.motion.plan.moves import TURNINGS, Move, Stretch
from armlab.benches.motion.plan.state import Plan, planned
from armlab.kin.field import Field
from armlab.kin.motion import law_types, path_types
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.fields import Fields
from armlab.ui.markup import chip, chips, options, select
from armlab.ui.option_form import Scale, option_markup, option_value
from armlab.ui.units import units_of


def move_markup(fields: Fields, state: State) -> str:
    """Return the choices of the move to the selected waypoint; of the first one, a sentence."""
    part, channel = state[Plan], fields.channel_id
    if part.recorded is not None:
        return ""
    if not part.selected or part.stretch is None:
        return (
            '<p class="dim">The motion begins at waypoint 1. Select a later one to choose how the arm comes to it.</p>'
        )
    stretch = part.stretch
    move = stretch.move
    like = chip(channel, "all-like", "All like this", "Make all moves of this kind", off=len(part.moves) == 1)
    head = f'<h3>Move {stretch.title}<span class="copies">{like}</span></h3>'
    spaces = chips(
        channel, {"space-joint": "Joint", "space-cartesian": "Cartesian"}, f"space-{move.space}", "What runs"
    )
    paths = {key: kind.title for key, kind in path_types().items() if move.space in kind.spaces}
    laws = {key: kind.title for key, kind in law_types().items()}
    return (
        f'{head}<div class="bar">{spaces}{_stop(part, stretch, channel)}</div>'
        + _choice(channel, "path", "Path", paths, move.path.key)
        + _form(fields, "path ", move.kind.fields, move.path.options, state)
        + _together(channel, move)
        + _turning(state, channel, move)
        + _choice(channel, "law", "Law", laws, move.law.key)
        + _form(fields, "law ", law_types()[move.law.key].fields, move.law.options, state)
        + _bounds(state, stretch)
    )


def _choice(channel: str, cell: str, title: str, texts: dict[str, str], chosen: str) -> str:
    return f'<div class="option wide"><span>{title}</span>{select(channel, cell, title, options(texts, chosen))}</div>'


def _form(fields: Fields, prefix: str, kinds: tuple[Field, ...], given: dict[str, object], state: State) -> str:
    form = option_markup(fields, prefix, kinds, given, scales(state))
    return f'<div class="options">{form}</div>' if form else ""


def _turning(state: State, channel: str, move: Move) -> str:
    if move.space == "joint" or state[Joints].arm.task.rotation == "none":
        return ""
    return _choice(channel, "turning", "Tool turns", {str(key): text for key, text in TURNINGS.items()}, move.turning)


def _together(channel: str, move: Move) -> str:
    """Return whether the joints of a straight joint move go together."""
    if move.space != "joint" or move.path.key != "line":
        return ""
    both = {"together": "Joints together", "apart": "Each by itself"}
    hint = "All joints start and end together, or each is as fast as it can and those there first wait"
    return f'<div class="bar">{chips(channel, both, "apart" if move.apart else "together", hint)}</div>'


def _bounds(state: State, stretch: Stretch) -> str:
    """Return what the limits of the joints leave to the law: the bounds of section 6.1.1."""
    plan = planned(state)
    leg = None if plan is None else next((leg for leg in plan.legs if leg.stretch == stretch), None)
    if leg is None or leg.bounds is None:
        return ""
    bounds = leg.bounds
    speed = f"|ṡ| ≤ {bounds.V:.3g} 1/s" + (f" (joint {bounds.V_joint})" if bounds.V_joint else "")
    growth = f"|s̈| ≤ {bounds.A:.3g} 1/s²" + (f" (joint {bounds.A_joint})" if bounds.A_joint else "")
    hint = "Safe bounds of the law from the limits of the joints (6.1.1); the motion is then scaled to meet one exactly"
    return f'<p class="dim" title="{hint}">{speed}, {growth}</p>'


def _stop(part: Plan, stretch: Stretch, channel: str) -> str:
    """Return whether the arm stops at the selected waypoint, where the path could go through."""
    k = part.selected
    if k >= len(part.waypoints) - 1:
        return ""
    move, after = part.moves[k - 1], part.moves[k]
    through = move.kind.most is None and move.through() == after.through()
    if not through:
        return ""
    return chip(channel, "stop", f"Stop at {k + 1}", "Rest here, although the path could go through", pressed=move.stop)


def scales(state: State) -> tuple[Scale, ...]:
    """Return the units of the coordinates of the move: of the joints, or lengths."""
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    stretch = part.stretch
    if stretch is not None and stretch.move.space == "cartesian":
        return (Scale(units.length_unit, units.factor(False)),)
    return tuple(Scale(units.unit(bool(turns)), units.factor(bool(turns))) for turns in arm.revolute)


def move_command(state: State, cell: str, text: str) -> tuple[Command, ...] | None:
    """Return what a person asked for; None when no cell of the move has this name. `InputError`: not a number."""
    part = state[Plan]
    k = part.selected
    stretch = part.stretch
    if stretch is None:
        return None
    move = stretch.move
    simple: dict[str, Command] = {
        "all-like": AllMovesLike(k),
        "space-joint": SetMove(k, space="joint"),
        "space-cartesian": SetMove(k, space="cartesian"),
        "path": SetMove(k, path=text),
        "law": SetMove(k, law=text),
        "turning": SetMove(k, turning=text),
        "stop": SetMove(k, stop=not part.moves[k - 1].stop),
        "together": SetMove(k, apart=False),
        "apart": SetMove(k, apart=True),
    }
    if cell in simple:
        return (simple[cell],)
    of, _, name = cell.partition(" ")
    if of not in ("path", "law"):
        return None
    kinds = move.kind.fields if of == "path" else law_types()[move.law.key].fields
    field = next((each for each in kinds if each.key == name), None)
    if field is None:
        return None
    given = move.path.options if of == "path" else move.law.options
    value = option_value(field.seen(given), text, given.get(name), scales(state))
    return (SetMoveOption(k, "path", name, value) if of == "path" else SetMoveOption(k, "law", name, value),)
