"""The page of the market: how many robots work in the world, how fast they become more, and what follows from it."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.robot.market.examples import EXAMPLES, ChooseMarketExample
from armlab.benches.robot.market.numbers import SHARES, SOURCE, SPANS, STOCK, following
from armlab.benches.robot.market.state import NUMBERS, ComputeNumber, Market, TakeSpan
from armlab.benches.robot.market.ui.chart import chart_markup, percent, robots, shares_markup
from armlab.kin.growth import doubling_time
from armlab.session.fields import Set, fields_of
from armlab.session.parts.notation import Notation
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, readable, so_many, trimmed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.option_text import Scale, option_value
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.widgets import Gui

FORMULA = r"\mathrm{CAGR}=\left(\frac{V_{end}}{V_{begin}}\right)^{1/years}-1"

SYMBOLS = {"begin": r"V_{begin}", "end": r"V_{end}", "years": r"years", "rate": r"\mathrm{CAGR}"}

UNITS = {"rate": "%"}

TIMES = 3.0
"""Factor from which growth is told as so many times as much, instead of as a percentage."""

AXES = {"log": "logarithmic", "even": "linear"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the chart, the calculator, and the numbers of the IFR."""
    del state
    form = gui.form(post)

    def show(state: State) -> None:
        part = state[Market]
        form.show(
            examples(form, EXAMPLES, part.example, ChooseMarketExample),
            tag("h3", "Industrial robots at work in the world", tag("span.copies", _axis(form, part))),
            chart_markup(part),
            spans_markup(form, part),
            calculator_markup(form, part),
            fold("What the numbers of 2024 say", numbers_markup()),
            tag("p.dim.ma-source", "Source: ", SOURCE, "⟦; section 1.8 of the notes⟧."),
        )

    return show


def _axis(form: Form, part: Market) -> Markup:
    def chosen(key: str) -> Command:
        return Set(Market, "log", key == "log")

    return form.chips("axis", AXES, "log" if part.log else "even", "Axis of the robots", chosen)


def spans_markup(form: Form, part: Market) -> Markup:
    """Return a button for each pair of counts, with the rate between them when it is pressed."""
    chips = []
    for first, last in SPANS:
        one, other = STOCK[first], STOCK[last]
        shown = part.start, part.years, part.begin, part.end, part.unknown
        here = shown == (one.year, other.year - one.year, one.robots, other.robots, "rate")
        chips.append(
            form.chip(f"span {first} {last}", f"{one.year}–{other.year}", TakeSpan(first, last), "Rate between", here)
        )
    return tag("div.bar.ma-spans", chips)


def calculator_markup(form: Form, part: Market) -> Inside:
    """Return the four numbers, of which one is computed from the others, and what follows from the rate."""
    found = part.found
    names = form.chips("compute", NUMBERS, part.unknown, "What is computed from the others", ComputeNumber)
    rate = found["rate"]
    words = "doubles" if rate > 0.0 else "halves"
    time = (
        f"At this rate a value {words} in {so_many(trimmed(doubling_time(rate), 1), 'year')}"
        if rate
        else "Nothing changes"
    )
    whole = _whole(found["end"] / found["begin"])
    return (
        tag("h3", "Compound growth"),
        tag("div.eq.small", mathml(FORMULA)),
        tag("div.bar", tag("span.dim", "compute"), names),
        tag("div.ma-fields", [_field(form, part, name, found[name]) for name in NUMBERS]),
        tag(
            "p",
            f"{percent(rate)} a year over {so_many(trimmed(found['years'], 2), 'year')}: {whole}. {time}.",
        ),
    )


def _whole(factor: float) -> str:
    """Return in words what a value has become in all."""
    return f"{percent(factor - 1.0)} in all" if factor < TIMES else f"{trimmed(factor, 1)} times as much in all"


def _field(form: Form, part: Market, name: str, value: float) -> Markup:
    factor = 100.0 if name == "rate" else 1.0
    off = name == part.unknown

    def typed(text: str) -> Command:
        kind = replace(fields_of(Market)[name], symbol="", title=NUMBERS[name], unit="q" if name == "rate" else "1")
        scale = Scale("%", 1.0 / factor) if name == "rate" else Scale()
        return Set(Market, name, option_value(kind, text.removesuffix("%"), value, (scale,), True))

    shown = trimmed(value, 0) if name in ("begin", "end") and value >= 1e3 else readable(value * factor, 2)
    if off and name == "rate":
        shown = trimmed(100.0 * value, 2)
    elif off and name == "years":
        shown = trimmed(value, 2)
    field = form.field(name, shown, NUMBERS[name], typed, off=off)
    return tag("label", tag("span", mathml(SYMBOLS[name])), field, tag("i", UNITS.get(name, "")))


def numbers_markup() -> Inside:
    """Return the numbers of the IFR, each with one that follows from it, and the shares of countries."""
    rows = [line(each.given, f"{_amount(each.value, each.unit)}: {each.says}") for each in following()]
    return (
        tag("table.ma-table", head_line("the IFR says", "so"), rows),
        shares_markup(SHARES),
        tag("p.dim", "China has been the largest market since 2013; in Europe Italy is the second after Germany."),
    )


def _amount(value: float, unit: str) -> str:
    return f"{trimmed(value / 1e9, 1)} billion $" if unit == "$" else robots(value)


PANEL = Panel((Market,), build, rebuilds=(Notation,), apart=True)
