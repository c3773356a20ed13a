"""The numbers of a chain: what is typed at each place, the product it is a factor of, and the losses."""

from __future__ import annotations

import math
from functools import partial

from armlab.benches.drive.power.chains import CHAINS, Chain, Passed, effort_typed
from armlab.benches.drive.power.state import GIVEN, Power
from armlab.benches.drive.power.ui.typed import typed
from armlab.benches.drive.quantities import prefixed
from armlab.session.amounts import amount
from armlab.session.fields import Set, fields_of
from armlab.ui.form import Form
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.tables import line


def choices_markup(form: Form, part: Power) -> Markup:
    """Return the choice of a kind of chain, and of the end at which the power is typed."""
    kinds = {key: kind.title for key, kind in CHAINS.items()}
    kind = form.chips("kind", kinds, part.kind, "Kind of the chain", partial(Set, Power, "kind"))
    given = form.chips("given", GIVEN, part.given, "Where the power is typed", partial(Set, Power, "given"))
    return joined(tag("div.cases.pw-chosen", kind), row("Power typed", given, wide=True))


def table_markup(form: Form, part: Power) -> Markup:
    """Return a line for each place and each converter of the chain, and the efficiency of the whole."""
    chain = part.chain
    rows: list[Markup] = []
    for k, passed in enumerate(chain.passed):
        if k > 0:
            title, field = chain.kind.converters[k - 1]
            lost = f"−{prefixed(chain.losses[k - 1], 'W')}"
            rows.append(line(typed(form, part, field, "η ="), "", tag("span.dim", lost), name=tag("span.dim", title)))
        rows.append(_place(form, part, passed, _both(part, k)))
    return joined(tag("table.kit-points.pw-chain", rows), _whole(chain))


def _both(part: Power, k: int) -> bool:
    """Return whether both factors are typed at a place, which gives the power of the chain."""
    return k == (0 if part.given == "supply" else 3)


def _place(form: Form, part: Power, passed: Passed, both: bool) -> Markup:
    place, domain = passed.place, passed.domain
    first = _factor(form, part, place.field)
    other = domain.flow if effort_typed(domain.key) else domain.effort
    value = passed.flow if effort_typed(domain.key) else passed.effort
    unit = domain.flow_unit if effort_typed(domain.key) else domain.effort_unit
    second: Inside = _factor(form, part, place.other) if both else f"{other} = {_text(value, unit)}"
    return line(first, second, tag("b", prefixed(passed.power, "W")), name=place.title)


def _factor(form: Form, part: Power, name: str) -> Markup:
    return typed(form, part, name, f"{fields_of(Power)[name].symbol} =")


def _text(value: float, unit: str) -> str:
    """Return a factor that follows; flow rates are in litres per minute, as on data sheets."""
    return f"{amount(6e4 * value)} L/min" if unit == "m³/s" else prefixed(value, unit)


def _whole(chain: Chain) -> Markup:
    product = " · ".join(amount(value) for value in chain.efficiencies)
    turns = _ratio(chain)
    return tag(
        "p",
        mathml(r"\eta=P_u/P_c"),
        f" = {product} = ",
        tag("b", f"{amount(100.0 * chain.efficiency)} %"),
        f", {prefixed(chain.supplied - chain.useful, 'W')} of heat.{turns}",
    )


def _ratio(chain: Chain) -> str:
    """Return the ratio that the typed speeds mean, with what they have in place of one."""
    if chain.kind.key == "rotary":
        return f" From these speeds follows a gear ratio of {amount(chain.passed[2].flow / chain.passed[3].flow)}."
    last = chain.passed[-1].flow
    if chain.kind.key == "linear":
        lead = 2.0 * math.pi * last / chain.passed[2].flow
        return f" From these speeds follows a screw that advances {amount(1e3 * lead)} mm a turn."
    return f" Flow and speed mean a piston of {amount(1e4 * chain.passed[2].flow / last)} cm²."
