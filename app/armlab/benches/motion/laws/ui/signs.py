"""Intervals of plus and minus one as two bands, the time at which they say nothing or too much, and the ends."""

from __future__ import annotations

from functools import partial

from armlab.benches.motion.laws.sign_commands import READINGS, SIDES, ReadSigns, SetSigns, UseSigns
from armlab.benches.motion.laws.signs import DURATION, Signs, percent, read, written
from armlab.benches.motion.laws.state import Laws
from armlab.session.amounts import amount
from armlab.session.state import Command
from armlab.ui import svg
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row, verdict_box

WIDE, BAND, MIDDLE = 330.0, 20.0, 26.0
"""Width of the picture, height of a band, and the height at which both meet, pixels."""

NAMES = {"whole": "with 3, 5, 7", "eighths": "with 3/8, 5/8, 7/8"}

FIELDS = {"plus": "+1 on", "minus": "−1 on"}


def signs_markup(form: Form, part: Laws) -> Inside:
    """Return the two lists of intervals, the bands, and whether they are an acceleration."""
    signs = part.signs
    here = next((key for key, some in READINGS.items() if signs == Signs(*some, DURATION)), "")
    return (
        tag("div.bar", form.chips("reading", NAMES, here, "Intervals of an example", ReadSigns)),
        [row(FIELDS[side], _field(form, side, getattr(signs, side)), wide=False) for side in SIDES],
        bands(signs),
        _card(form, signs),
        tag("p.dim", "⟦1.41 prints 3/8, 5/8 and 7/8, where 3, 5 and 7 are meant.⟧"),
    )


def _field(form: Form, side: str, some: tuple[tuple[float, float], ...]) -> Markup:
    return form.field(f"signs {side}", written(some), SIDES[side], partial(_typed, side), class_="field law-signs")


def _typed(side: str, text: str) -> Command:
    read(text, SIDES[side])
    return SetSigns(side, text)


def bands(signs: Signs) -> Markup:
    """Return the picture: where +1 holds above, where -1 holds below, and marks where both hold or none."""
    scale = WIDE / signs.duration
    shapes: list[Inside] = []
    for one in signs.pieces:
        x, wide = scale * one.start, scale * (one.end - one.start)
        if one.plus:
            shapes.append(svg.shape("rect.law-plus", x=x, y=MIDDLE - BAND, width=wide, height=BAND))
        if one.minus:
            shapes.append(svg.shape("rect.law-minus", x=x, y=MIDDLE, width=wide, height=BAND))
        if not one.determined:
            shapes.append(svg.shape("rect.law-doubt", x=x, y=0.0, width=wide, height=5.0))
    shapes.append(svg.line("law-middle", 0.0, MIDDLE, WIDE, MIDDLE))
    for second in range(int(signs.duration) + 1):
        anchor = "start" if not second else "end" if second == signs.duration else "middle"
        shapes.append(svg.text("tick", scale * second, MIDDLE + BAND + 12.0, str(second), anchor))
    said = f"Intervals of plus and minus one; undetermined for {percent(signs.undetermined)} of the time"
    return svg.drawing("chart.law-bands", WIDE, MIDDLE + BAND + 16.0, said, *shapes)


def _card(form: Form, signs: Signs) -> Markup:
    if signs.ends is None:
        share = percent(signs.undetermined)
        said = f"For {share} of the {amount(signs.duration, 's')} both signs hold, or none: this is no acceleration."
        return verdict_box("no", f"Undetermined for {share}", tag("p", said))
    speed, place = signs.ends
    said = (
        f"From rest at 0: ṡ({amount(signs.duration)}) = {amount(speed)}, s({amount(signs.duration)}) = {amount(place)}."
    )
    use = form.chip("use-signs", "show as a law", UseSigns(), "With its speed and its place")
    return verdict_box("ok", "One sign at every time", tag("p", said), tag("div.bar", use))
