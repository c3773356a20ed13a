"""Results from the table: relations of neighbouring axes, the freedoms they leave, and the closed form of the arm."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from armlab.kin.arm import Arm
from armlab.kin.relations import AxisRelation, axis_relations, end_freedoms
from armlab.kin.structure import Structure, structure_of
from armlab.ui.form import Form
from armlab.ui.format import subscripts
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import Units

SIGNS = {"parallel": "∥", "intersecting": "×", "coincident": "≡", "skew": "skew"}


@dataclass(frozen=True)
class Facts:
    """Results from a table, computed once for each."""

    relations: tuple[AxisRelation, ...]
    ends: tuple[str, str]
    structure: Structure


def facts_of(arm: Arm) -> Facts:
    """Return the results from the table of an arm."""
    return Facts(axis_relations(arm), end_freedoms(arm), structure_of(arm))


def axes_section(form: Form, facts: Facts, chosen: int, units: Units, choose: Callable[[int], None]) -> Inside:
    """Return the chips of frame 0, of each pair of neighbouring axes and of frame n, and the freedom at the chosen one.

    ``choose`` gets the number of the pressed, which is that of the frame.
    """
    n = len(facts.relations) + 1
    names = [("{0}", "frame 0")]
    names += [
        (f"{r.first} {SIGNS[r.kind]} {r.second}", f"axes {r.first} and {r.second}: {r.kind}") for r in facts.relations
    ]
    names.append((f"{{{n}}}", f"frame {n}"))
    chosen = min(chosen, n)
    chips = [
        form.chip(f"axes-{k}", name, partial(choose, k), title, k == chosen) for k, (name, title) in enumerate(names)
    ]
    legend = "\u2002".join(f"{sign}\u00a0{kind}" for kind, sign in SIGNS.items() if sign != kind)
    told = tag("p", _told(facts, chosen, units), tag("br"), tag("small.dim", legend))
    return tag("h3", "Neighbouring axes and free choices"), tag("div.bar", chips), told


def _told(facts: Facts, chosen: int, units: Units) -> Inside:
    n = len(facts.relations) + 1
    if chosen in (0, n):
        return subscripts(facts.ends[0 if chosen == 0 else 1].replace("θ", units.book.symbols["theta"]))
    relation = facts.relations[chosen - 1]
    link = f"a = {units.constant(relation.a, False)}, α = {units.constant(relation.alpha, True)}"
    freedom = relation.freedom.replace("θ", units.book.symbols["theta"])
    return f"{subscripts(freedom)} ", tag("span.dim", link)


def closed_form_card(structure: Structure) -> Markup:
    """Return the closed form of the arm and why it has one, or that none is known."""
    kind, said = ("ok", "closed form") if structure.closed_form else ("warn", "no closed form is known")
    most = structure.most_solutions
    number = "One solution" if most == 1 else f"At most {most} solutions"
    count = "" if most is None else f" {number}, apart from full turns and away from singular configurations."
    card = verdict_box(kind, f"{structure.title}: {said}", f"{subscripts(structure.why)}{count}")
    return joined(tag("h3", "Inverse kinematics"), card)
