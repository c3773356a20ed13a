"""The plane of x, large."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.control.exponential.state import Exponential
from armlab.benches.control.exponential.ui.plane import EIGEN, eigenvectors
from armlab.ui.colours import BLUE, VERMILLION
from armlab.ui.curve import Curve
from armlab.ui.large import LargeChart
from armlab.ui.tray_picture import Drawn, Picture
from armlab.ui.widgets import Gui


class LargePlane(LargeChart):
    """The curve of x(t) in the plane, as the tray shows it."""

    def __init__(self, gui: Gui) -> None:
        super().__init__(gui, "The curve of x(t) in the plane", "plane")

    def show_part(self, part: Exponential) -> None:
        """Set what it is drawn of."""
        self.show(part, partial(self._drawn, part))

    def _drawn(self, part: Exponential) -> Picture:
        curve, here = part.curve, part.found.whole @ np.array(part.x0)
        reach = 1.2 * float(np.abs(curve.x).max()) / np.sqrt(2.0)
        drawn = [
            Drawn(Curve(f"eigenvector {i + 1}", EIGEN[i], 1.4, dash=(5, 3)), *(reach * np.outer(vector, (-1.0, 1.0))))
            for i, vector in enumerate(eigenvectors(part))
        ]
        drawn += [
            Drawn(Curve("x(t)", BLUE, 2.0), *curve.x.T),
            Drawn(Curve("x now", VERMILLION, 9.0, dots=True), *here[:, None]),
        ]
        return Picture(self.title, "x₁", drawn, square=True, y="x₂")
