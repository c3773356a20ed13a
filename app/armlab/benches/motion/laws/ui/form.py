"""The form of the bench of timing laws: example, timing, the laws with their options, and what there is to say."""

from __future__ import annotations

from armlab.benches.motion.laws.examples import EXAMPLES
from armlab.benches.motion.laws.state import MOST_LAWS, Laws
from armlab.benches.motion.laws.timing import AS_TYPED, QUANTITIES, excesses, phases
from armlab.benches.motion.laws.words import corrections, excess_text, phases_text
from armlab.kin.motion import free_law_types
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, Rgb, css
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import dot, escaped
from armlab.ui.markup import button, chip, chips, options, select
from armlab.ui.option_form import option_markup

LAW_COLOURS: tuple[Rgb, ...] = (BLUE, ORANGE, GREEN)
STRETCHED: Rgb = PURPLE
"""Of the law that is stretched in time."""

VIEWS = {"view laws": "Laws", "view bounds": "Bounds on a path"}

TIMINGS = {"time": "Duration T", "fast": "As fast as allowed"}


def names(part: Laws) -> list[tuple[str, Rgb]]:
    """Return number and colour of each law, the stretched one last."""
    found = [(str(i + 1), LAW_COLOURS[entry.colour]) for i, entry in enumerate(part.entries)]
    return found if part.stretched is None else [*found, (f"{part.scaled + 1}, ×k", STRETCHED)]


def marked(name: str, colour: Rgb) -> str:
    """Return the name of a law with a dot in its colour."""
    return f'<span class="law-name">{dot(css(colour))}{escaped(name)}</span>'


def form_markup(fields: Fields, part: Laws) -> str:
    """Return timing and laws."""
    laws = "".join(_law(fields, part, i) for i in range(len(part.entries)))
    add = chip(fields.channel_id, "add", "+ Add a law", "Up to three at once") if len(part.entries) < MOST_LAWS else ""
    return f"{_timing(fields, part)}<h3>Laws</h3>{laws}{add}"


def head_markup(fields: Fields, part: Laws) -> str:
    """Return the choice of an example, and whether the calculator is shown."""
    examples = examples_markup(fields.channel_id, EXAMPLES, part.example)
    shown = "view bounds" if part.bounds_shown else "view laws"
    views = chips(fields.channel_id, VIEWS, shown, "What to look at")
    return f'{examples}<div class="bar">{views}</div>'


def _timing(fields: Fields, part: Laws) -> str:
    timing = part.timing
    how = chips(
        fields.channel_id,
        {f"mode {key}": text for key, text in TIMINGS.items()},
        f"mode {'fast' if timing.fastest else 'time'}",
        "Whether the laws take the duration, or go as fast as the limits allow",
    )
    shown = [field for field in QUANTITIES if not (timing.fastest and field.key == "duration")]
    given = {field.key: getattr(timing, field.key) for field in shown}
    return (
        f'<h3>Timing</h3><div class="bar">{how}</div>'
        f'<div class="options law-short">{option_markup(fields, "t-", shown, given)}</div>'
    )


def _law(fields: Fields, part: Laws, i: int) -> str:
    entry, channel = part.entries[i], fields.channel_id
    kind = free_law_types()[entry.chosen.key]
    chooser = select(
        channel,
        f"law {i}",
        f"Law {i + 1}",
        options({key: each.title for key, each in free_law_types().items()}, kind.key),
    )
    away = button(channel, f"remove {i}", "✕", "copy", "Take this law away") if len(part.entries) > 1 else ""
    typed = ""
    if kind.key in AS_TYPED:
        hint = "Leave times and accelerations as they are typed, or stretch them to the duration and the distance"
        held = f"typed {i}" if entry.as_typed else f"fitted {i}"
        both = {f"typed {i}": "As typed", f"fitted {i}": "Stretched to T and L"}
        typed = f'<div class="bar">{chips(channel, both, held, hint)}</div>'
    form = option_markup(fields, f"l{i}-", kind.fields, entry.chosen.options)
    given = f'<div class="options">{form}</div>' if form else ""
    head = f'<div class="kit-head">{marked(str(i + 1), LAW_COLOURS[entry.colour])}{chooser}{away}</div>'
    return f'<div class="law">{head}{typed}{given}{_said(part, i)}</div>'


def _said(part: Laws, i: int) -> str:
    """Return how a law goes, which limits it breaks, and where the notes differ."""
    law, entry = part.laws[i], part.entries[i]
    plain = [text for text in (phases_text(part, i), *part.laws[i].remarks) if text]
    wrong = [excess_text(excess) for excess in excesses(entry, part.timing)]
    notes = corrections(entry, part.timing, phases(law))
    return (
        "".join(f"<p>{escaped(text)}</p>" for text in plain)
        + "".join(f'<p class="no">✕ {escaped(text)}</p>' for text in wrong)
        + "".join(f'<p class="dim">{escaped(text)}</p>' for text in notes)
    )


def scaling_markup(fields: Fields, part: Laws) -> str:
    """Return the head of time scaling: which law, and the optimal k."""
    channel = fields.channel_id
    which = "".join(
        button(
            channel,
            f"scale {i}",
            marked(str(i + 1), LAW_COLOURS[entry.colour]),
            "chip",
            f"Stretch law {i + 1}",
            pressed=i == part.scaled,
        )
        for i, entry in enumerate(part.entries)
    )
    best = chip(channel, "optimal", "Optimal k", "Slower, or faster, until one limit is met")
    back = chip(channel, "unscaled", "k = 1", "Leave the law alone", off=part.k == 1.0)
    return f'<h3>Uniform time scaling <small>r = k t</small></h3><div class="bar">{which}{best}{back}</div>'
