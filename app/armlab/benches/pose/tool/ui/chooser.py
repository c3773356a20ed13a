"""The choice of a transform, the same on every page of the bench Pose."""

from __future__ import annotations

from armlab.benches.pose.tool.state import TOOL, WORLD, Invert, LookAt, PoseView
from armlab.benches.pose.tool.ui.notation import in_words, short_symbol
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.html import Markup, tag
from armlab.ui.markup import row
from armlab.ui.widgets import Gui


class Chooser:
    """Rows of buttons: the ends of the arm, the running product, the steps, and the inverse of the chosen one."""

    def __init__(self, gui: Gui, post: Post) -> None:
        self._form = gui.form(post)

    def show(self, state: State) -> None:
        """Mark the chosen transform."""
        self._form.show(chooser_markup(self._form, state[PoseView]))


def chooser_markup(form: Form, view: PoseView) -> Markup:
    """Return the rows; the choice of the inverse stays while other pairs are chosen."""
    n = view.n
    ends = ((WORLD, TOOL), ("0", TOOL), (WORLD, "0"), (str(n), TOOL))

    def pair(reference: str, frame: str, name: Markup | str) -> Markup:
        hint, on = in_words(reference, frame), view.outer_pair == (reference, frame)
        look = LookAt(reference, frame, keeps_sense=True)
        return form.button(f"{reference}-{frame}", name, look, "chip", hint, hint, on)

    hint = "The inverse transform: reference and frame exchanged"
    inverse = form.button("inverse", "inverse", Invert(), "chip", hint, hint, view.inward)
    return tag(
        "div.choose",
        row(None, ([pair(*ends_of, short_symbol(*ends_of)) for ends_of in ends], inverse)),
        row(short_symbol("0", "i"), [pair("0", str(i), str(i)) for i in range(1, n + 1)]),
        row(("A", tag("sub", "i")), [pair(str(i - 1), str(i), str(i)) for i in range(1, n + 1)]),
    )
