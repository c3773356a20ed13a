"""Robots and what is none: a definition, and things that are judged by it."""

from __future__ import annotations

from armlab.benches.robot.history.state import History, Judge, JudgeAnew
from armlab.benches.robot.history.things import DEFINITIONS, FEATURES, THINGS, Definition, Thing
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import fold

ANSWERS = {True: "yes", False: "no"}


def things_markup(form: Form, state: State) -> Inside:
    """Return the choice of a definition, what it asks for, and all things with the answers so far."""
    part = state[History]
    definition = DEFINITIONS[part.definition]
    titles = {key: each.title for key, each in DEFINITIONS.items()}
    chips = form.chips("by", titles, part.definition, "Definition", lambda key: Set(History, "definition", key))
    judged = part.judged
    done = f"{len(judged)} of {len(THINGS)} judged, {part.right} rightly."
    anew = form.chip("anew", "start again", JudgeAnew(), "Take the answers to this definition back", off=not judged)
    return (
        tag("div.bar", chips),
        tag("p", f"{definition.asks} It takes:"),
        tag("ul.hi-needs", [tag("li", FEATURES[each]) for each in definition.needs]),
        fold("About this definition", tag("p.dim", definition.says), tag("p.dim.hi-source", definition.source)),
        tag("h3", definition.asks, tag("span.copies", anew)),
        tag("div.hi-things", [_line(form, thing, definition, judged.get(thing.key)) for thing in THINGS.values()]),
        tag("p.dim", done),
    )


def _line(form: Form, thing: Thing, definition: Definition, said: bool | None) -> Markup:
    chips = [
        form.chip(
            f"{word} {thing.key}", word, Judge(thing.key, answer), f"{thing.title}: {word}", pressed=said is answer
        )
        for answer, word in ANSWERS.items()
    ]
    return tag("div.hi-thing", tag("span", thing.title), tag("span.hi-said", chips), _verdict(thing, definition, said))


def _verdict(thing: Thing, definition: Definition, said: bool | None) -> Markup | None:
    """Return whether an answer is right, and why."""
    if said is None:
        return None
    lacks = thing.lacks(definition)
    right = said is not bool(lacks)
    why = f"lacks {' and '.join(FEATURES[each] for each in lacks)}" if lacks else "has all of it"
    return tag(classes("span.hi-why", ok=right, no=not right), f"{'✓ right' if right else '✕ wrong'}: {why}")
