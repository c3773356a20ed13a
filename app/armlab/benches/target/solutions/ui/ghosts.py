"""Drawing of the solutions: the chosen one and the nearest as bodies, the others as sticks, none at the arm itself."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.target.solutions.found import Found, Row
from armlab.benches.target.solutions.state import GoToSolution, Solutions, present_row
from armlab.benches.target.solutions.ui.bodies import Bodies
from armlab.benches.target.solutions.ui.names import Names
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import GREY, Rgb, joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Show
from armlab.ui.scene._sticks import Sticks, corners_of

MOST_BODIES = 2
NOTHING = np.empty((0, 0, 3))

Drawn = tuple[Found, int, int, tuple[int, ...]]


def row_colour(row: Row) -> Rgb:
    """Return the colour of a solution: its own, which it keeps, or that of its family; grey if it is out of limits."""
    return joint_colour(row.slot if row.family < 0 else row.family) if row.within else GREY


class Ghosts:
    """All solutions in the scene except the present one."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas = canvas
        path = canvas.path(name)
        canvas.scene.add_frame(path, show_axes=False)
        self._sticks = Sticks(canvas, f"{path}/sticks", lambda k: self._go(self._thin[k].slot))
        self._bodies = [Bodies(canvas, f"{path}/{k}", k, self._goer(k)) for k in range(MOST_BODIES)]
        self._names = Names(canvas, f"{path}/names")
        self._thin: list[Row] = []
        self._solid: list[Row] = []
        self._drawn: Drawn | None = None

    def show(self, state: State) -> None:
        """Show the results; nothing is sent if they are on screen already."""
        found, q = state[Solutions].found, state[Joints].q
        if found is None or found.question.arm is not self._canvas.drawn.figure.anatomy.arm:
            self.hide()
            return
        present = state.derived(present_row)
        skip = (-1 if present is None else present.slot,)
        self._solid = _solid(found, state[Solutions].chosen, skip, q)
        drawn = (found, skip[0], state[Solutions].chosen, tuple(row.slot for row in self._solid))
        if drawn == self._drawn:
            return
        self._drawn = drawn
        left_out = {*skip, *drawn[3]}
        here = found.nearest(q)[0]
        self._thin = [row for row in _drawn_rows(found, here, q) if row.slot not in left_out]
        ghosts = [*self._thin, *self._solid]
        whole = corners_of(found.question.arm, np.array([*(row.q for row in ghosts), q]))
        corners, own = whole[:-1], whole[-1]
        self._sticks.show(corners[: len(self._thin)], [row_colour(row) for row in self._thin])
        self._names.show(corners, own, [found.rows.index(row) + 1 for row in ghosts])
        for k, body in enumerate(self._bodies):
            if k < len(self._solid):
                body.show(self._solid[k].q, row_colour(self._solid[k]), q)
            else:
                body.hide()

    def hide(self) -> None:
        """Hide all ghosts."""
        self._drawn = None
        self._sticks.show(NOTHING, [])
        self._names.show(NOTHING, NOTHING, [])
        for body in self._bodies:
            body.hide()

    def _go(self, slot: int) -> None:
        self._canvas.post(GoToSolution(slot))

    def _goer(self, k: int) -> Callable[[], None]:
        return lambda: self._go(self._solid[k].slot) if k < len(self._solid) else None


def _solid(found: Found, chosen: int, skip: tuple[int, ...], q: np.ndarray) -> list[Row]:
    """Return the rows that are drawn as bodies: the chosen one, and the nearest to the arm inside the limits."""
    rows = [row for row in (found.row(chosen),) if row is not None and row.slot not in skip]
    here = found.nearest(q)[0]
    same = (row.slot for row in found.rows if here is not None and row.family == here.family >= 0)
    nearest, _ = found.nearest(q, (*skip, *same, *(row.slot for row in rows)), inside=True)
    return [*rows, nearest] if nearest is not None else rows


def _drawn_rows(found: Found, here: Row | None, q: np.ndarray) -> list[Row]:
    """Return the rows that are drawn: all, but only the nearest one of each family other than the arm's."""
    if here is None or here.family < 0:
        return list(found.rows)
    families = {row.family for row in found.rows} - {here.family}
    others = [found.nearest(q, (row.slot for row in found.rows if row.family != family))[0] for family in families]
    return [row for row in found.rows if row.family == here.family or row in others]


def drawn_when(wanted: Callable[[State], bool], name: str) -> Callable[[LayerCanvas, State], Show]:
    """Return the ``build`` function of a layer that draws the ghosts while a state wants them."""

    def build(canvas: LayerCanvas, state: State) -> Show:
        ghosts = Ghosts(canvas, name)
        return lambda state: ghosts.show(state) if wanted(state) else ghosts.hide()

    return build
