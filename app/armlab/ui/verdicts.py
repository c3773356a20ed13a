"""The verdict of inverse kinematics in words, with numbers and units."""

from __future__ import annotations

import math

from armlab.kin.ik import Verdict
from armlab.session.parts.target import Judged
from armlab.ui.format import capitalised
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import SIGNS, verdict_box
from armlab.ui.units import Units


def verdict_kind(verdict: Verdict) -> str:
    """Return ``ok``, ``warn`` or ``no``."""
    return {"reached": "ok", "moving": "warn"}.get(verdict.status, "no")


def verdict_words(verdict: Verdict, units: Units) -> tuple[str, str]:
    """Return the verdict in a word or two, and an explanation with numbers and units."""
    short = _shortfall(verdict, units)
    if verdict.status == "reached":
        return "reached", f"{units.length(verdict.position_error)} {units.angle(verdict.rotation_error)}"
    if verdict.status in ("limit", "closest"):
        return verdict.reason, short
    if verdict.status == "beyond":
        return "out of reach", f"{short}; farther than the fully stretched arm"
    return "not there yet", short


def _shortfall(verdict: Verdict, units: Units) -> str:
    """Return the distance of the target, in the components of the task."""
    said = []
    if verdict.position_error >= 5e-5:
        said.append(f"{units.length(verdict.position_error)} short")
    if verdict.rotation_error >= math.radians(0.05):
        said.append(f"orientation error {units.angle(verdict.rotation_error)}")
    return ", ".join(said) or f"within {units.length(1e-4)} and {units.angle(math.radians(0.1))}"


def verdict_card(verdict: Verdict, units: Units) -> Markup:
    """Return the verdict as a coloured card with a sign and words."""
    kind = verdict_kind(verdict)
    head, body = verdict_words(verdict, units)
    notes = [tag("p", f"{capitalised(note)}.") for note in notes_of(verdict)]
    return verdict_box(kind, capitalised(head), body, notes)


def verdict_line(verdict: Verdict, units: Units) -> Markup:
    """Return the verdict in one line."""
    kind = verdict_kind(verdict)
    head, body = verdict_words(verdict, units)
    notes = [tag("i.note", note) for note in notes_of(verdict)]
    return joined(tag(f"b.{kind}", f"{SIGNS[kind]} {head}"), f" {body}", notes)


def notes_of(verdict: Verdict) -> tuple[str, ...]:
    """Return further notes: a branch that was crossed, a singularity that is near."""
    return verdict.notes if isinstance(verdict, Judged) else ()
