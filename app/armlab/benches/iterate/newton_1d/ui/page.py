"""Newton's method for one equation in one unknown: the curve with its tangents, and the iterates in numbers."""

from __future__ import annotations

from armlab.benches.iterate.newton_1d.clip import STEP, Place, place_of
from armlab.benches.iterate.newton_1d.state import CLIP_KEY, ChooseEquation, Newton1D, TypeEquation, solution
from armlab.benches.iterate.runs.one_equation import Solved
from armlab.benches.iterate.runs.ui.tangents import picture
from armlab.kin.ik.iterate import EXAMPLES
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import escaped, number, scientific
from armlab.ui.markup import SIGNS
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import plain_number
from armlab.ui.widgets import Gui

FORMULA = "<i>x</i><sub>n+1</sub> = <i>x</i><sub>n</sub> − f(<i>x</i><sub>n</sub>) / f′(<i>x</i><sub>n</sub>)"

ROWS = 8
"""Of the table at once."""

DIGITS = 10
"""Decimals of x: enough to see the correct ones double."""

KINDS = {"converged": "ok", "most": "warn"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make equation, picture and table."""
    problem, drawn, numbers = gui.form(post), gui.html(), gui.form(post)

    def show(state: State) -> None:
        found, place = state.derived(solution), place_of(state)
        problem.show(_problem(problem, state))
        drawn.show(picture(found, place))
        numbers.show(_table(numbers, found, place, state[Timeline].clip == CLIP_KEY))

    return show


def _problem(form: Form, state: State) -> str:
    part, found = state[Newton1D], state.derived(solution)
    titles = {**({"": "your own"} if part.text else {}), **{each.key: each.title for each in EXAMPLES}}
    chooser = form.select("equation", "Equation", titles, "" if part.text else part.example, ChooseEquation)
    play = play_button(form, state, CLIP_KEY, "tangents")
    kind = KINDS.get(found.status, "no")
    slope = '<p class="dim">f′ by central difference.</p>' if found.differenced else ""
    typed = form.field("f", part.text, "Function of x", TypeEquation)
    start = form.field(
        "x0", f"{part.x0:.10g}".replace("-", "−"), "Start", lambda text: Set(Newton1D, "x0", plain_number(text, "x₀"))
    )
    return (
        f'<div class="eq small" title="Notes 4.106-4.110; printed there without x_n">&emsp;{FORMULA}</div>'
        f'<div class="kit-head"><span class="dim">Equation</span>{chooser}</div>'
        f'<div class="kit-numbers kit-typed"><label><span>or f(x) =</span>{typed}</label></div>{slope}'
        f'<div class="kit-numbers"><label><span>x₀</span>{start}</label></div>'
        f'<div class="bar">{play}<span class="{kind}">{SIGNS[kind]} {escaped(found.says)}.</span></div>'
    )


def _table(form: Form, found: Solved, place: Place, on: bool) -> str:
    first = max(0, min(place.k - ROWS // 2, found.last - ROWS + 1))
    rows = []
    for k in range(first, min(first + ROWS, found.last + 1)):
        each = found.iterates[k]
        mark = ' class="now" aria-current="true"' if k == place.k else ""
        to_k = (*(() if on else (OpenClip(CLIP_KEY),)), Seek(STEP * k))
        name = form.button(f"iterate {k}", str(k), to_k, "copy", "Show this iterate")
        cells = (name, _plain(each.x, DIGITS), _plain(each.f, 4), _plain(each.tangent.slope, 4))
        rows.append(f"<tr{mark}>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
    heads = "".join(f"<th>{head}</th>" for head in ("k", "x<sub>k</sub>", "f(x<sub>k</sub>)", "f′(x<sub>k</sub>)"))
    return f'<table class="kit-table"><tr>{heads}</tr>{"".join(rows)}</table>'


def _plain(value: float, decimals: int) -> str:
    """Return a number with fixed decimals, or with a power of ten where these would show nothing or too much."""
    if value == 0.0:
        return "0"
    return number(value, decimals) if 10.0 ** (1 - decimals) <= abs(value) < 1e4 else scientific(value, 3)


PANEL = Panel((Newton1D, Timeline), build, rebuilds=())
