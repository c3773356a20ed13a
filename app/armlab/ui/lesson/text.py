"""The text of a step: with the present values inside, the hints that are unlocked, and what is revealed at last."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

from armlab.content.check import Words, metres, spaced
from armlab.content.fact_words import said
from armlab.content.lesson import Lesson
from armlab.content.live import NONE, all_live_values
from armlab.content.markdown import IN_METRES
from armlab.session.pages import pages
from armlab.session.parts.lesson import LessonPart, observed
from armlab.session.parts.timeline import clips
from armlab.session.state import State
from armlab.ui.format import escaped
from armlab.ui.plugin import switches
from armlab.ui.units import units_of

_LIVE = re.compile(r'(<output class="live" data-live="([^"]*)">)[^<]*(?=</output>)')
HIDDEN = "?"
"""What a live value shows before the prediction."""


def words_of(state: State) -> Words:
    """Return how the lab says things to the student of a state."""
    units = units_of(state)
    return Words(units.length, units.angle, lambda key: _titles().get(key, spaced(key)))


@cache
def _titles() -> dict[str, str]:
    """Return the titles of films, panels and switches, where a name is shared the last counts."""
    films = {key: clip.title for key, clip in clips().items()}
    named = {key: panel.title for key, panel in pages().items()}
    return films | named | {switch.name: switch.title for switch in switches()}


def step_text(state: State, lesson: Lesson, i: int) -> str:
    """Return everything there is to read at a step."""
    part = state[LessonPart]
    step, progress, name = lesson.steps[i], part.progress, part.name
    intro = lesson.intro_html
    if intro:
        intro = f"<details><summary>About this lesson</summary>{intro}</details>"
    title = f"<h2><small>{i + 1} of {len(lesson.steps)}</small> {escaped(step.title)}</h2>"
    shown = progress.hints.get(name, 0)
    hints = "".join(
        f'<div class="hint"><b>Hint {k} of {len(step.hints)}</b>{hint}</div>'
        for k, hint in enumerate(step.hints[:shown], start=1)
    )
    reveal = step.reveal_html if revealed(part, lesson, i) else ""
    if reveal:
        reveal = f'<div class="reveal">{reveal}</div>'
    text = f"{intro if i == 0 else ''}{title}{step.html}{hints}{reveal}{intro if i else ''}"
    return f'<div class="lesson-text">{_with_values(state, text)}</div>'


def revealed(part: LessonPart, lesson: Lesson, i: int) -> bool:
    """Return whether what a step keeps back is to be seen: its question is settled and its check, if any, is met."""
    step = lesson.steps[i]
    if step.question is not None:
        return part.progress.answered(lesson, i)
    return step.check is None or part.name in part.progress.met


def _with_values(state: State, html: str) -> str:
    """Return the text with the present values in it."""
    if 'class="live"' not in html:
        return html
    seen = observed(state)
    values, hidden = all_live_values(seen.arm.n), bool(state[LessonPart].hides)
    words = words_of(state)

    def value(found: re.Match[str]) -> str:
        name, _, unit = (part.strip() for part in found[2].partition(":"))
        live, units = values.get(name), replace(words, length=metres) if unit == IN_METRES else words
        if name in seen.facts:
            shown = said(seen.facts[name].value, seen.facts[name].unit, units)
        else:
            shown = NONE if live is None else live(seen, units)
        text = HIDDEN if hidden else shown
        return f"{found[1]}{escaped(text)}"

    return _LIVE.sub(value, html)
