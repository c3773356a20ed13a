"""Newton's method for one equation in one unknown: the curve with its tangents, and the iterates in numbers."""

from __future__ import annotations

from armlab.benches.iterate.newton_1d.clip import STEP, Place, place_of
from armlab.benches.iterate.newton_1d.state import CLIP_KEY, ChooseEquation, Newton1D, TypeEquation, solution
from armlab.benches.iterate.runs.one_equation import Solved
from armlab.benches.iterate.runs.ui.tangents import picture
from armlab.kin.ik.iterate import EXAMPLES
from armlab.session.fields import Set, fields_of
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import number, scientific
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.markup import SIGNS
from armlab.ui.option_text import option_value
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

_X, _HERE = tag("i", "x"), tag("sub", "n")
FORMULA = joined(_X, tag("sub", "n+1"), " = ", _X, _HERE, " − f(", _X, _HERE, ") / f′(", _X, _HERE, ")")

_K = tag("sub", "k")
HEADS = tag("tr", [tag("th", head) for head in ("k", ("x", _K), ("f(x", _K, ")"), ("f′(x", _K, ")"))])

ROWS = 8
"""Number of rows of the table that are shown at once."""

DIGITS = 10
"""Number of decimals of x, enough to see the correct ones double."""

KINDS = {"converged": "ok", "most": "warn"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the equation, the picture and the table."""
    problem, drawn, numbers = gui.form(post), gui.html(), gui.form(post)

    def show(state: State) -> None:
        found, place = state.derived(solution), place_of(state)
        problem.show(_problem(problem, state))
        drawn.show(picture(found, place))
        numbers.show(_table(numbers, found, place, state[Timeline].clip == CLIP_KEY))

    return show


def _start(text: str) -> Set:
    return Set(Newton1D, "x0", option_value(fields_of(Newton1D)["x0"], text, needed=True))


def _problem(form: Form, state: State) -> Inside:
    part, found = state[Newton1D], state.derived(solution)
    titles = {**({"": "your own"} if part.text else {}), **{each.key: each.title for each in EXAMPLES}}
    chooser = form.select("equation", "Equation", titles, "" if part.text else part.example, ChooseEquation)
    play = play_button(form, state, CLIP_KEY, "tangents")
    kind = KINDS.get(found.status, "no")
    typed = form.field("f", part.text, "Function of x", TypeEquation)
    start = form.field(
        "x0",
        f"{part.x0:.10g}".replace("-", "−"),
        "Start",
        lambda text: Set(Newton1D, "x0", option_value(fields_of(Newton1D)["x0"], text, needed=True)),
    )
    return (
        tag("div.eq.small", "\u2003", FORMULA, title="⟦Notes 4.106-4.110; printed there without x_n⟧"),
        tag("div.kit-head", tag("span.dim", "Equation"), chooser),
        tag("div.kit-numbers.kit-typed", tag("label", tag("span", "or f(x) ="), typed)),
        tag("div.kit-numbers", tag("label", tag("span", "x₀"), start)),
        tag("div.bar", play, tag(f"span.{kind}", f"{SIGNS[kind]} {found.says}.")),
    )


def _table(form: Form, found: Solved, place: Place, on: bool) -> Markup:
    first = max(0, min(place.k - ROWS // 2, found.last - ROWS + 1))
    rows = []
    for k in range(first, min(first + ROWS, found.last + 1)):
        each = found.iterates[k]
        to_k = (*(() if on else (OpenClip(CLIP_KEY),)), Seek(STEP * k))
        name = form.button(f"iterate {k}", str(k), to_k, "copy", "Show this iterate")
        cells = (name, _plain(each.x, DIGITS), _plain(each.f, 4), _plain(each.tangent.slope, 4))
        here = k == place.k
        row = [tag("td", cell) for cell in cells]
        rows.append(tag(classes("tr", now=here), row, aria_current="true" if here else None))
    return tag("table.kit-table", HEADS, rows)


def _plain(value: float, decimals: int) -> str:
    """Return a number with fixed decimals, or with a power of ten if it is too small or too large for them."""
    if value == 0.0:
        return "0"
    return number(value, decimals) if 10.0 ** (1 - decimals) <= abs(value) < 1e4 else scientific(value, 3)


PANEL = Panel((Newton1D, Timeline), build, rebuilds=(Notation,), apart=True)
