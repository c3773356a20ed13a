"""The card of one erratum: both forms with their residuals, why, and where it is met in the course."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from armlab.benches.lessons.errata.places import named_in, taught_in
from armlab.benches.lessons.errata.state import Errata, Found, RunAgain
from armlab.benches.lessons.errata.ui.dots import dots
from armlab.benches.lessons.errata.ui.texts import headline, residual, severity, written
from armlab.content.errata import Erratum
from armlab.content.lessons import lessons
from armlab.kin.errata.trial import POINTS, Trial
from armlab.session.fields import Set
from armlab.session.pages import pages, place_of
from armlab.session.state import State
from armlab.teaching.lesson_commands import GoToStep, OpenLesson
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold

MOST_TAUGHT = 4
"""Most lessons on the same topic that are listed besides those that name the erratum."""


def card(form: Form, state: State) -> Inside:
    """Return the card of the chosen erratum."""
    part = state[Errata]
    each, found = part.erratum, part.run
    trial = None if found is None else found.trial
    return (
        tag("h3", headline(each), tag("span.copies", severity(each))),
        tag("p.er-title", each.title),
        _both(each, found, trial),
        tag("div.er-why", written(each.why)),
        _run(form, part, found, trial),
    )


def _both(each: Erratum, found: Found | None, trial: Trial | None) -> Inside:
    unit = trial.unit if trial else ""
    told = found if found is not None and found.printed else None
    return (
        _form("wrong", "✕ Printed", each.printed, told.worst_printed if told else None, unit),
        _form("right", "✓ Correct", each.correct, told.worst_correct if told else None, unit),
    )


def _form(kind: str, name: str, text: str, worst: float | None, unit: str) -> Markup:
    said = None if worst is None else tag("span", "largest residual ", tag("b", residual(worst, unit)))
    if worst == float("inf"):
        said = tag("span", tag("b", "has no value"))
    return tag(f"div.er-form.er-{kind}", tag("p.er-head", tag("b", name), said), written(text))


def _run(form: Form, part: Errata, found: Found | None, trial: Trial | None) -> Inside:
    if part.erratum.unrun:
        return tag("p.dim", "Not run. ", part.erratum.unrun)
    if found is None or trial is None:
        return tag("p.dim", f"Both forms are run at {POINTS} points …")
    quiet, is_quiet = trial.quiet, part.quiet and trial.quiet is not None
    drawn = "inputs" if is_quiet else trial.drawn
    at = f"{POINTS} times, seed {part.seed}: {drawn}"
    where = f", {quiet.says}" if is_quiet and quiet else ""
    chip = None
    if quiet is not None:
        chip = form.chip(
            "quiet",
            "Where it is not seen",
            Set(Errata, "quiet", not part.quiet),
            f"Both forms agree {quiet.says}",
            pressed=part.quiet,
        )
    return (
        dots(found, trial),
        tag(
            "div.bar",
            form.chip("again", "Run again", RunAgain(), "Take other points, with the next seed"),
            chip,
            _seen(found, trial, is_quiet),
        ),
        fold(
            "How it is run",
            tag("p", f"{at}{where}."),
            tag("p", f"Compared is the {trial.measure}, with {trial.judged_by}."),
            tag("p", f"The dashed line is the tolerance of the correct form, {residual(trial.tolerance, trial.unit)}."),
            key="er-how",
        ),
    )


def _seen(found: Found, trial: Trial, quiet: bool) -> Markup:
    """Return at how many points the error is seen, in words."""
    seen = sum(value > trial.tolerance for value in found.printed)
    if quiet and not seen:
        return tag("span.warn", "◐ not seen")
    some = f", {trial.somewhere}" if trial.somewhere and seen < len(found.printed) else ""
    return tag("span.no", f"✕ wrong at {seen} of {len(found.printed)}{some}")


def where(form: Form, each: Erratum, open_panel: Callable[[str], None]) -> Markup:
    """Return the lessons and pages that have to do with an erratum, to be opened."""
    found = lessons()
    named = [
        form.button(
            f"lesson {place.lesson}",
            (tag("b", place.title), f" step {place.step + 1}" if place.step >= 0 else " introduction"),
            (OpenLesson(place.lesson), GoToStep(max(place.step, 0))),
            "copy",
            "Open the lesson where it names this erratum",
        )
        for place in named_in(found).get(each.id, ())
    ]
    taught = [
        form.button(f"lesson {key}", title, OpenLesson(key), "copy", "Open a lesson on the same topic")
        for key, title in taught_in(each, found)[:MOST_TAUGHT]
    ]
    seen = [
        form.button(f"page {key}", place_of(key), partial(open_panel, key), "copy", f"Open {place_of(key)}")
        for key in _pages(each)
    ]
    rows = [
        tag("p", tag("span.dim", f"{title}: "), joined(*buttons, between=" · "))
        for title, buttons in (("Named in", named), ("On its topic", taught), ("Page", seen))
        if buttons
    ]
    return tag(
        "div.er-where", tag("h4", "Where in the course"), rows or tag("p.dim", "Not yet in a lesson or on a page.")
    )


def _pages(each: Erratum) -> Iterator[str]:
    """Yield the pages of the lab that show a topic of an erratum."""
    rows = set(each.rows)
    return (key for key, page in pages().items() if rows.intersection(page.about))
