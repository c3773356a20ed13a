"""The form of the bench of timing laws: example, timing, the laws with their options, and remarks."""

from __future__ import annotations

from functools import partial

from armlab.benches.motion.laws.commands import (
    AddLaw,
    AsFastAsAllowed,
    ChooseLaw,
    LeaveAsTyped,
    RemoveLaw,
    SetLawOption,
    SetQuantity,
    Stretch,
    StretchOptimally,
)
from armlab.benches.motion.laws.examples import EXAMPLES, ChooseLawExample
from armlab.benches.motion.laws.state import MOST_LAWS, Laws
from armlab.benches.motion.laws.timing import AS_TYPED, QUANTITIES, excesses, phases
from armlab.benches.motion.laws.words import corrections, excess_text, phases_text
from armlab.kin.motion import free_law_types
from armlab.session.fields import Set
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, Rgb, css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import dot
from armlab.ui.html import Markup, joined, tag
from armlab.ui.option_form import option_form

LAW_COLOURS: tuple[Rgb, ...] = (BLUE, ORANGE, GREEN)
STRETCHED: Rgb = PURPLE
"""Colour of the law that is stretched in time."""

VIEWS = {"laws": "Laws", "bounds": "Bounds on a path"}

TIMINGS = {"time": "Duration T", "fast": "As fast as allowed"}


STRETCHED_NAME = " (×k)"
"""Text behind the number of the stretched law."""


def names(part: Laws) -> list[tuple[str, Rgb]]:
    """Return number and colour of each law, the stretched one last."""
    found = [(str(i + 1), LAW_COLOURS[entry.colour]) for i, entry in enumerate(part.entries)]
    return found if part.stretched is None else [*found, (f"{part.scaled + 1}{STRETCHED_NAME}", STRETCHED)]


def marked(name: str, colour: Rgb) -> Markup:
    """Return the name of a law with a dot in its colour."""
    return tag("span.law-name", dot(css(colour)), name)


def form_markup(form: Form, part: Laws) -> Markup:
    """Return timing and laws."""
    laws = [_law(form, part, i) for i in range(len(part.entries))]
    add = form.chip("add", "+ Law", AddLaw(), "Up to three at once") if len(part.entries) < MOST_LAWS else None
    return joined(_timing(form, part), tag("h3", "Laws ", tag("span.copies", add)), laws)


def head_markup(form: Form, part: Laws) -> Markup:
    """Return the choice of an example, and whether the calculator is shown."""
    chooser = examples(form, EXAMPLES, part.example, ChooseLawExample)
    shown = "bounds" if part.bounds_shown else "laws"
    hint = "What to look at"
    views = form.chips("view", VIEWS, shown, hint, lambda view: Set(Laws, "bounds_shown", view == "bounds"))
    return joined(chooser, tag("div.bar", views))


def _timing(form: Form, part: Laws) -> Markup:
    timing = part.timing
    hint = "Whether the laws last for the given duration, or are as fast as the limits allow"
    mode = "fast" if timing.fastest else "time"
    how = form.chips("mode", TIMINGS, mode, hint, lambda mode: AsFastAsAllowed(mode == "fast"))
    shown = [field for field in QUANTITIES if not (timing.fastest and field.key == "duration")]
    given = {field.key: getattr(timing, field.key) for field in shown}
    options = option_form(form, "t-", shown, given, SetQuantity)
    names = ", ".join(f"{field.symbol}: {field.title.partition(';')[0]}" for field in shown)
    head = tag("h3", "Timing ", tag("span.copies", how))
    return joined(head, tag("div.options.law-short", options), tag("p.dim", f"{names}."))


def _law(form: Form, part: Laws, i: int) -> Markup:
    entry, last = part.entries[i], len(part.entries) == 1
    kind = free_law_types()[entry.chosen.key]
    titles = {key: each.title for key, each in free_law_types().items()}
    chooser = form.select(f"law {i}", f"Law {i + 1}", titles, kind.key, partial(ChooseLaw, i))
    away = None if last else form.button(f"remove {i}", "✕", RemoveLaw(i), "copy", "Remove this law")
    typed = None
    if kind.key in AS_TYPED:
        hint = "Keep times and accelerations as they were typed, or scale them to the duration and the distance"
        left = form.chip(f"typed {i}", "As typed", LeaveAsTyped(i, True), hint, entry.as_typed)
        fitted = form.chip(f"fitted {i}", "Scaled to T and L", LeaveAsTyped(i, False), hint, not entry.as_typed)
        typed = tag("div.bar", left, fitted)
    options = option_form(form, f"l{i}-", kind.fields, entry.chosen.options, partial(SetLawOption, i))
    given = tag("div.options", options) if options else None
    head = tag("div.kit-head", marked(str(i + 1), LAW_COLOURS[entry.colour]), chooser, away)
    return tag("div.law", head, typed, given, _said(part, i))


def _said(part: Laws, i: int) -> Markup:
    """Return remarks on a law: its phases, the limits it exceeds, and the differences from the notes."""
    law, entry = part.laws[i], part.entries[i]
    plain = [text for text in (phases_text(part, i), *law.remarks) if text]
    wrong = [excess_text(excess) for excess in excesses(entry, part.timing)]
    notes = corrections(entry, part.timing, phases(law))
    return joined(
        [tag("p", text) for text in plain],
        [tag("p.no", f"✕ {text}") for text in wrong],
        [tag("p.dim", text) for text in notes],
    )


def scaling_markup(form: Form, part: Laws) -> Markup:
    """Return the choice of the law that is stretched, and of the optimal k."""
    which = [
        form.button(
            f"scale {i}",
            marked(str(i + 1), LAW_COLOURS[entry.colour]),
            Set(Laws, "scaled", i),
            "chip",
            f"Stretch law {i + 1}",
            pressed=i == part.scaled,
        )
        for i, entry in enumerate(part.entries)
    ]
    best = form.chip(
        "optimal", "Optimal k", StretchOptimally(), "Slow the law down or speed it up until it just reaches one limit"
    )
    back = form.chip("unscaled", "k = 1", Stretch(1.0), "Leave the law as it is", off=part.k == 1.0)
    return tag("div.bar", which, best, back)
