"""The choice of a transform, the same on every page of the Pose bench."""

from __future__ import annotations

from armlab.benches.pose.tool.state import TOOL, WORLD, Invert, LookAt, PoseView
from armlab.benches.pose.tool.ui.notation import in_words, short_symbol
from armlab.session.state import Post, State
from armlab.ui.markup import button, row
from armlab.ui.widgets import Gui

INVERSE = "inverse"


class Chooser:
    """Rows of buttons: the ends of the arm, the running product, the steps, and the inverse of what is chosen."""

    def __init__(self, gui: Gui, post: Post) -> None:
        self._post = post
        self._fields = gui.fields(lambda cell, _: self._pressed(cell))

    def show(self, state: State) -> None:
        """Mark what is looked at."""
        view = state[PoseView]
        n = view.n
        ends = ((WORLD, TOOL), ("0", TOOL), (WORLD, "0"), (str(n), TOOL))
        rows = {
            "": [self._pair(view, *pair, short_symbol(*pair)) for pair in ends] + [self._inverse(view)],
            short_symbol("0", "i"): [self._pair(view, "0", str(i), str(i)) for i in range(1, n + 1)],
            "A<sub>i</sub>": [self._pair(view, str(i - 1), str(i), str(i)) for i in range(1, n + 1)],
        }
        lines = "".join(row(label, "".join(chips)) for label, chips in rows.items())
        self._fields.show(f'<div class="choose">{lines}</div>')

    def _pressed(self, cell: str) -> None:
        """Look at a pair; the inverse stays chosen while other pairs are."""
        if cell == INVERSE:
            self._post(Invert())
            return
        reference, _, frame = cell.partition("-")
        self._post(LookAt(reference, frame, keeps_sense=True))

    def _pair(self, view: PoseView, reference: str, frame: str, name: str) -> str:
        on = view.outer_pair == (reference, frame)
        return self._chip(f"{reference}-{frame}", name, in_words(reference, frame), on)

    def _inverse(self, view: PoseView) -> str:
        return self._chip(INVERSE, "inverse", "The inverse: reference and frame exchanged", view.inward)

    def _chip(self, cell: str, inside: str, hint: str, on: bool) -> str:
        return button(self._fields.channel_id, cell, inside, "chip", hint, hint, on)
