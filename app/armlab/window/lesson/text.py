"""The text of a step, with present values in it, the unlocked hints, and the part revealed at the end."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

from armlab.content.check import Words, metres, spaced
from armlab.content.fact_words import said
from armlab.content.lesson import Lesson
from armlab.content.live import all_live_values
from armlab.content.live_value import NONE
from armlab.content.markdown import IN_METRES
from armlab.session.pages import pages, place_of
from armlab.session.parts.timeline import clips
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart, observed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.plugin import switches
from armlab.ui.units import units_of

_LIVE = re.compile(r'(<output class="live" data-live="([^"]*)">)[^<]*(?=</output>)')
HIDDEN = "?"
"""Text of a live value before the prediction."""


def words_of(state: State) -> Words:
    """Return the words of the lab for the units and names of a student."""
    units = units_of(state)
    return Words(units.length, units.angle, lambda key: _titles().get(key, spaced(key)))


@cache
def _titles() -> dict[str, str]:
    """Return the titles of films and switches, and where panels are found; if a name is shared the last one counts."""
    films = {key: clip.title for key, clip in clips().items()}
    named = {key: place_of(key) for key in pages()}
    return films | named | {switch.name: switch.title for switch in switches()}


def step_text(state: State, lesson: Lesson, i: int) -> Markup:
    """Return the whole text of a step."""
    part = state[LessonPart]
    step, progress, name = lesson.steps[i], part.progress, part.name
    about = _about(lesson, part, i) if lesson.intro_html else None
    title = tag("h2", tag("small", f"{i + 1} of {len(lesson.steps)}"), " ", step.title)
    hints = [
        tag("div.hint", tag("b", f"Hint {k} of {len(step.hints)}"), Markup(hint))
        for k, hint in enumerate(step.hints[: progress.hints.get(name, 0)], start=1)
    ]
    seen = step.reveal_html if revealed(part, lesson, i) else ""
    reveal = tag("div.reveal", Markup(seen)) if seen else None
    text = joined(about if i == 0 else None, title, Markup(step.html), hints, reveal, about if i else None)
    return tag("div.lesson-text", with_values(state, text))


def _about(lesson: Lesson, part: LessonPart, i: int) -> Markup:
    """Return the introduction, folded; at the first step of a task it says what is given, and is open."""
    title = "About this lesson" if part.assigned is None else "About this task"
    return tag("details", tag("summary", title), Markup(lesson.intro_html), open=part.assigned is not None and i == 0)


def revealed(part: LessonPart, lesson: Lesson, i: int) -> bool:
    """Return whether the hidden part of a step may be seen: its question is answered, or else its check is met."""
    step = lesson.steps[i]
    if part.silent:
        return False
    if step.question is not None:
        return part.progress.answered(lesson, i)
    return step.check is None or part.name in part.progress.met


def with_values(state: State, html: Markup) -> Markup:
    """Return a text of a lesson with the present values in it."""
    if 'class="live"' not in html:
        return html
    seen = observed(state)
    values, hidden = all_live_values(seen.arm.n), bool(state[LessonPart].hides)
    words = words_of(state)

    def value(found: re.Match[str]) -> str:
        name, _, unit = (part.strip() for part in found[2].partition(":"))
        live, units = values.get(name), replace(words, length=metres) if unit == IN_METRES else words
        if name in seen.facts:
            fact = seen.facts[name]
            shown = said(fact.named(fact.value), fact.unit, units)
        else:
            shown = NONE if live is None else live(seen, units)
        text = HIDDEN if hidden else shown
        return joined(Markup(found[1]), text)

    return Markup(_LIVE.sub(value, html))
