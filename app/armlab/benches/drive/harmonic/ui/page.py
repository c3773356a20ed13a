"""The page of harmonic drives: teeth, the part that is fixed, the ratio with its sign, and teeth that are counted."""

from __future__ import annotations

import math
from functools import partial

from armlab.benches.drive.gears.stage import around
from armlab.benches.drive.gears.ui.page import HIDES
from armlab.benches.drive.gears.ui.typed import whole_field
from armlab.benches.drive.harmonic.examples import EXAMPLES, ChooseHarmonicExample
from armlab.benches.drive.harmonic.film import DURATION, counted_now
from armlab.benches.drive.harmonic.state import CLIP_KEY, TURN, TURNS, Harmonic, SetCircular, ShowTurns
from armlab.kin.drive.strain_wave import FEWEST, FIXED, LOBES, MOST, StrainWave, counted_teeth
from armlab.kin.field import Field
from armlab.session.amounts import amount
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, number, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, verdict_box
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

FORMULAS = {
    "circular": r"n=-\frac{N_{FS}}{N_{CS}-N_{FS}}",
    "flexible": r"n=+\frac{N_{CS}}{N_{CS}-N_{FS}}",
    "generator": r"n=+\frac{N_{CS}}{N_{FS}}",
}
"""The ratio of input to output, by the part that is fixed."""

PARTS = {"circular": "the circular spline", "flexible": "the flexspline", "generator": "the wave generator"}

FLEXSPLINE = Field("flexspline", "N_FS", "teeth of the flexspline", "whole", low=FEWEST, high=MOST)
CIRCULAR = Field("circular", "N_CS", "teeth of the circular spline", "whole", low=FEWEST, high=MOST + max(LOBES))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the teeth, the film and what is counted."""
    form, film, numbers = gui.form(post), gui.form(post), gui.html()
    units = units_of(state)

    def show(state: State) -> None:
        part = state[Harmonic]
        form.show(
            examples(form, EXAMPLES, part.example, ChooseHarmonicExample),
            _teeth(form, part),
            _ratio(part.drive),
        )
        film.show(clock(film, state, CLIP_KEY, DURATION), _turns(film, state))
        numbers.show(_counted(state, units), _why(part.drive))

    return show


def _teeth(form: Form, part: Harmonic) -> Markup:
    drive = part.drive
    fixed = form.chips("fixed", FIXED, part.fixed, "Part that stands still", partial(Set, Harmonic, "fixed"))
    flexible = whole_field(form, "flexspline", FLEXSPLINE, drive.flexspline, partial(Set, Harmonic, "flexspline"))
    circular = whole_field(form, "circular", CIRCULAR, drive.circular, SetCircular)
    names = form.chip("names", "Names", Set(Harmonic, "names", not part.names), "Names in the scene", part.names)
    return tag(
        "div",
        tag(
            "div.kit-numbers.hd-teeth",
            tag("label", mathml("N_{FS}"), " = ", flexible, title="Teeth of the flexspline"),
            tag("label", mathml("N_{CS}"), " = ", circular, title="Teeth of the circular spline"),
            names,
        ),
        tag("div.bar", tag("span.dim", "Fixed"), fixed),
    )


def _ratio(drive: StrainWave) -> Markup:
    way = "against" if drive.ratio < 0.0 else "along with"
    said = f"{PARTS[drive.output].capitalize()} is the output and turns {way} {PARTS[drive.input]}, the input."
    return verdict_box(
        "ok", f"n = {amount(drive.ratio)}", tag("p", mathml(FORMULAS[drive.fixed])), tag("p", said), sign=""
    )


def _turns(form: Form, state: State) -> Markup:
    """Return buttons that show the film after whole turns of the input."""
    timeline = state[Timeline]
    now = timeline.time if timeline.clip == CLIP_KEY else 0.0
    chips = []
    for k in range(TURNS + 1):
        text = "start" if k == 0 else "1 turn" if k == 1 else f"{k} turns"
        chips.append(form.chip(f"turn {k}", text, ShowTurns(k), "Of the input", now == k * TURN))
    return tag("div.bar", chips)


def _counted(state: State, units: Units) -> Inside:
    """Return what can be counted at the present time, and the ratio that this gives."""
    drive, found = state[Harmonic].drive, counted_now(state)
    rows = [
        line(number(found.turns, 2), name=f"turns of {PARTS[drive.input]}"),
        line(number(found.passed_circular, 1), name="teeth of the circular spline past a lobe"),
        line(number(found.passed_flexible, 1), name="teeth of the flexspline past it"),
        line(number(found.moved, 2), name="the marked tooth of the flexspline moved, teeth"),
        line(units.angle(2.0 * math.pi * found.out), name=f"turn of {PARTS[drive.output]}"),
    ]
    return (
        tag("h3", "Counted since the start"),
        tag("table.kit-points.hd-counted", head_line(None, None), rows),
        tag(
            "p.dim",
            "The same number of teeth of both comes past a lobe, one by one. But the flexspline has "
            f"{drive.difference} fewer on its circumference, and comes to the end of them earlier.",
        ),
    )


def _why(drive: StrainWave) -> Markup:
    by_count = float(counted_teeth(drive))
    lobes = {2: "two lobes", 3: "three lobes"}[drive.lobes]
    return fold(
        "Why, and which numbers fit",
        tag("div.eq.small", mathml(r"N_{FS}(\dot\theta_{FS}-\dot\theta_{WG})=N_{CS}(\dot\theta_{CS}-\dot\theta_{WG})")),
        tag(
            "p",
            "Seen from the wave generator the splines roll on each other. Counted tooth by tooth, with no formula, the "
            f"flexspline turns by {amount(by_count)} of its {drive.flexspline} teeth against the circular spline: "
            f"{amount(by_count / drive.flexspline)} of a turn.",
        ),
        tag(
            "p",
            f"Here are {lobes}. The teeth must lie the same way at each, so the difference is a multiple of their "
            "number: 2 or 4 with two lobes, 3 with three. A lobe presses the ring outwards by half the difference in "
            f"modules, here {scientific(drive.depth / (0.5 * drive.flexspline), 1)} of its radius.",
        ),
        tag(
            "p",
            "⟦(2.29) gives N_FS/2 without a sign. The size is right for a fixed circular spline; the sign is minus.⟧",
        ),
    )


PANEL = Panel(
    (Harmonic, Timeline),
    build,
    rebuilds=(RobotPart, Notation),
    hides=HIDES,
    around=lambda state: around(state, 1.2),
)
