"""The wrong result of an erratum in red beside the right one in blue, on the arm on the table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from armlab.benches.lessons.errata.state import Errata
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import BLUE, VERDICT, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Sketch
from armlab.ui.scene._sticks import Stick

if TYPE_CHECKING:
    from armlab.benches.lessons.errata.on_arm import Drawn

MOST = 6
"""Most arrows and lines of an erratum."""

NOTHING = Marks()


def colour(wrong: bool) -> Rgb:
    """Return red for what is printed, and blue for what is right."""
    return VERDICT["no"] if wrong else BLUE


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the chosen erratum, and follow the arm."""
    from armlab.benches.lessons.errata.on_arm import on_arm  # with the page: other layers do not wait for it

    sketches = [Sketch(canvas, f"errata/{k}", 0.9) for k in range(MOST)]
    ghosts = {wrong: Stick(canvas, f"errata/ghost{wrong:d}", colour(wrong)) for wrong in (True, False)}

    def draw(state: State, q: NDArray[np.float64]) -> None:
        part = state[Errata]
        found = on_arm(part.chosen, state[Joints].arm, q) if part.view == "look" else None
        marks = marks_of(found)
        for k, sketch in enumerate(sketches):
            sketch.draw(marks[k] if k < len(marks) else NOTHING)
        shown = {} if found is None else {wrong: values for values, wrong in getattr(found, "ghosts", ())}
        for wrong, stick in ghosts.items():
            stick.show(shown.get(wrong))

    return canvas.follow(state, draw)


def marks_of(found: object) -> list[Marks]:
    """Return the arrows and lines of an erratum, each with its label; none where nothing is seen."""
    segments = getattr(found, "segments", ()) if getattr(found, "seen", False) else ()
    made = []
    for each in segments:
        line = (each.start, each.end, colour(each.wrong))
        lists = ([line], []) if each.arrow else ([], [line])
        made.append(Marks(*lists, label=each.label, at=each.end))
    return made


def around(state: State) -> NDArray[np.float64]:
    """Return the ends of the arrows and lines, which belong in the picture."""
    from armlab.benches.lessons.errata.on_arm import on_arm

    found: Drawn | object = on_arm(state[Errata].chosen, state[Joints].arm, state[Joints].q)
    ends = [end for each in getattr(found, "segments", ()) for end in (each.start, each.end)]
    return np.array(ends).reshape(-1, 3)


LAYER = Layer("errata", order=72, watches=(Errata, Joints, Display), build=build, panel="errata")
