"""The buttons that jog the joints or the tool, on every page that has room for them; `jog.js` presses them."""

from __future__ import annotations

from collections.abc import Callable

from armlab.errors import InputError
from armlab.kin.ik.jog import FARTHEST
from armlab.session.branch_words import near_singularity
from armlab.session.fields import Set
from armlab.session.parts.jog import LENGTHS, MODES, TURNS, Ended, Jog, JogBy, jog_offers
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.units import Units, units_of

HINTS = {
    "joints": "Move each joint in steps: click for one step, hold to continue",
    "base": "Move the tool along and about the axes of frame {0}, by inverse kinematics",
    "tool": "Move the tool along and about its own axes, by inverse kinematics",
}

KEYS = (
    (
        "1 … 9",
        "jog joint 1 … 9, or the tool along and about x, y and z; Shift reverses the direction; hold to continue",
    ),
    (
        "gamepad",
        "jog: left stick along x and y, right stick along and about z, cross about x and y; A: joints, base or tool; "
        "shoulder buttons: choose the joint that the left stick moves",
    ),
)
"""Keys while the buttons of Jog are seen."""

DIGITS = 9
"""Number of coordinates that have a key."""


def show_jog(form: Form, state: State, wide: bool = False) -> None:
    """Show the buttons; while nothing is jogged they are not made again for every pose of a drag."""
    if state[Jog].mode or not form.shows(state[Jog]):
        form.show(jog_markup(form, state, wide))


def jog_markup(form: Form, state: State, wide: bool = False) -> Inside:
    """Return the choice of what is jogged, and below it the steps, the buttons, and why the arm cannot go on."""
    part, units = state[Jog], units_of(state)
    modes = [
        form.button(
            f"jog-{key}",
            title,
            Set(Jog, "mode", "" if key == part.mode else key),
            "chip",
            f"{HINTS[key]}{'. Press again to hide the buttons' if key == part.mode else ''}",
            pressed=key == part.mode,
            data_jog_mode=key,
        )
        for key, title in MODES.items()
        if key
    ]
    head = row("Jog", modes, wide=wide)
    if not part.mode:
        return head
    return head, _steps(form, state, units, wide), _buttons(form, state, units), _said(state, units)


def _steps(form: Form, state: State, units: Units, wide: bool) -> Markup:
    """Return the choice of the sizes of a step: of those that this arm has a use for."""
    part, arm, offers = state[Jog], state[Joints].arm, jog_offers(state)
    by_joints = part.mode == "joints"
    turns = bool(arm.revolute.any()) if by_joints else any(offers[3:])
    slides = not arm.revolute.all() if by_joints else any(offers[:3])
    rows: list[Markup] = []
    for name, known, revolute, used in (("length", LENGTHS, False, slides), ("turn", TURNS, True, turns)):
        if used:
            texts = {key: units.constant(value, revolute) for key, value in known.items()}
            chips = form.chips(f"jog-{name}", texts, getattr(part, name), "Size of a step", _setter(name))
            rows.append(row("and" if rows else "Step", chips, wide=wide))
    return joined(rows)


def _setter(name: str) -> Callable[[str], Set]:
    return lambda key: Set(Jog, name, key)


def _buttons(form: Form, state: State, units: Units) -> Markup:
    """Return a pair of buttons for each coordinate."""
    part, offers = state[Jog], jog_offers(state)
    cells = [_pair(form, state, units, k, offered) for k, offered in enumerate(offers)]
    ended = "" if part.ended is None else str(part.ended.jog)
    bound = form.moved("jog", _jogged)
    kind = "div.jog.joints" if part.mode == "joints" else "div.jog"
    return tag(kind, cells, role="group", aria_label="Jog", data_jogs=len(offers), data_ended=ended, **bound)


def _pair(form: Form, state: State, units: Units, k: int, offered: bool) -> Markup:
    joints, part = state[Joints], state[Jog]
    if part.mode == "joints":
        revolute = bool(joints.arm.revolute[k])
        name, value = units.variable(k, revolute), units.text(float(joints.q[k]), revolute)
        said = f"joint {k + 1}"
    else:
        letter = "xyz"[k % 3]
        name, value = (letter, "") if k < 3 else (f"↻ {letter}", "")
        said = f"{'along' if k < 3 else 'about'} {letter}"
    ends = []
    for sign, word, key in (("−", "minus", "Shift+"), ("+", "plus", "")):
        by_key = f" ({key}{k + 1})" if k < DIGITS else ""
        hint = f"{capitalised(said)}, {word} one step; hold to continue{by_key}"
        if not offered:
            hint = f"Joint {k + 1} is held" if part.mode == "joints" else "The task of this arm does not include it"
        ends.append(
            form.button(
                f"jog {k} {word}", sign, (), "", hint, f"Jog {said} {word}", None, not offered, data_jog=f"{k},{sign}1"
            )
        )
    shown = tag("span", tag("b", name), f" {value}" if value else None)
    return tag("div", ends[0], shown, ends[1])


def _jogged(text: str) -> JogBy:
    """Return the command of a text ``NUMBER:PART,PART,...`` from the page's script."""
    number, _, parts = text.partition(":")
    try:
        return JogBy(tuple(float(each) for each in parts.split(",")), int(number))
    except ValueError:
        raise InputError(f"jog: expected a number and parts of steps, got {text[:40]!r}") from None


def _said(state: State, units: Units) -> Markup | None:
    """Return why the arm cannot go on, or that it is near a singularity."""
    part, joints = state[Jog], state[Joints]
    near = "" if part.mode == "joints" else near_singularity(joints.arm, joints.q)
    if part.ended is not None:
        return tag("p.no", f"✕ {ended_words(part.ended, state, units)}", role="status")
    return tag("p.warn", f"◐ {capitalised(near)}.", role="status") if near else None


def ended_words(ended: Ended, state: State, units: Units) -> str:
    """Return in a sentence why a jog went no further."""
    joints, named = state[Joints], [f"joint {i + 1}" for i in ended.joints]
    if ended.why == "held":
        return f"{capitalised(' and '.join(named))} {'is' if len(named) == 1 else 'are'} held."
    if ended.why == "limit":
        limits = (_limit(joints, i, units) for i in ended.joints)
        at = " and ".join(f"{name} is at its limit of {limit}" for name, limit in zip(named, limits, strict=True))
        return f"{capitalised(at)}{'' if state[Jog].mode == 'joints' else ': the tool cannot take this step'}."
    if ended.why == "reach":
        return "Out of reach: the tool cannot take this step."
    near = near_singularity(joints.arm, joints.q)
    turns = joints.arm.revolute[list(ended.joints)]
    sizes = ((units.angle(FARTHEST), turns.any()), (units.length(FARTHEST * joints.arm.length_scale), not turns.all()))
    most = " or ".join(size for size, used in sizes if used)
    why = f"{' and '.join(named)} would have to move by more than {most} in this step; choose smaller steps"
    return f"{capitalised(near)}: {why}." if near else f"The step is too large: {why}."


def _limit(joints: Joints, i: int, units: Units) -> str:
    """Return the limit of a joint at which it is, or to which it is nearer."""
    low, high = joints.arm.limits[i].tolist()
    value = low if abs(joints.q[i] - low) < abs(joints.q[i] - high) else high
    return units.angle(value) if joints.arm.revolute[i] else units.length(value)
