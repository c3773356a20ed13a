"""Asimov's laws: a situation is put together, and the first law that speaks decides."""

from __future__ import annotations

from armlab.benches.robot.history.laws import DECISIONS, FLAGS, LAWS, SIGNS, Decision, decide
from armlab.benches.robot.history.state import History, Suppose
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import verdict_box

SIGNS_OF = {"act": "ok", "refrain": "no", "free": "ok", "conflict": "warn"}
"""Kind of the card for each decision."""


def laws_markup(form: Form, state: State) -> Inside:
    """Return the laws, the situation, and what they decide."""
    holds = state[History].holds
    found = decide(holds)
    return (
        tag("p.dim.hi-asimov", "Isaac Asimov, Runaround, 1942; in short:"),
        tag("ol.hi-laws", [tag(classes("li", now=law == found.law), text) for law, text in LAWS.items()]),
        tag("h3", "An action of the robot"),
        [_line(form, law, holds) for law in LAWS],
        _card(found),
        tag(
            "p.dim",
            "The order of the laws is the whole of it. A robot that follows them has to know what harm is, and what "
            "will come of an action: an arm knows positions, speeds, forces. Collaborative arms take the first law as "
            "limits of speed and force, and stop at a touch.",
        ),
        tag(
            "p.dim",
            "The word robot is from Karel Čapek's play R.U.R. of 1920: robota is Czech for forced labour.",
        ),
    )


def _line(form: Form, law: int, holds: frozenset[str]) -> Markup:
    chips = [
        form.chip(f"flag {flag}", FLAGS[flag], Suppose(flag, flag not in holds), f"Law {law}", pressed=flag in holds)
        for flag, (of, _) in SIGNS.items()
        if of == law
    ]
    return tag("div.bar.hi-flags", tag("span.dim", f"Law {law}"), chips)


def _card(found: Decision) -> Markup:
    if found.kind == "free":
        said = "No law says anything about it."
    elif found.kind == "conflict":
        said = f"Law {found.law} speaks for it and against it. Later laws do not count, since this one comes first."
    else:
        later = " What later laws say does not count." if found.law < len(LAWS) else ""
        said = f"Law {found.law} decides.{later}"
    return verdict_box(SIGNS_OF[found.kind], capitalised(DECISIONS[found.kind]), tag("p", said))
