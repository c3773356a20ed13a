"""Arrows of what a matrix does: both parts of A x, a cross product, or a vector taken apart along columns."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.stage import stage_of
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.benches.body.skew.facts import cross_of, matrix_of
from armlab.benches.body.skew.state import Skew
from armlab.kin.matrix_parts import skew_part, symmetric_part
from armlab.session.parts.display import Display
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import GREY, INK, ORANGE, PURPLE, SKY, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.switches import DARK

Floats = NDArray[np.float64]

LONGEST = 1.3
"""Length of the longest arrow, in radii of the outermost gimbal ring; the others are to scale."""

STILL = 1e-9


@dataclass
class Picture:
    """Arrows from the origin or from a point, with names, in the units of the page.

    Attributes
    ----------
    arrows : list of (start, end, colour)
    names : list of (text, place)
    fine : list of (start, end, colour)
    """

    arrows: list[Segment] = field(default_factory=list)
    names: list[tuple[str, Floats]] = field(default_factory=list)
    fine: list[Segment] = field(default_factory=list)

    def arrow(self, name: str, start: Floats, end: Floats, colour: Rgb) -> None:
        """Add an arrow with its name at its tip; one without a length is left out."""
        if np.linalg.norm(end - start) > STILL:
            self.arrows.append((start, end, colour))
            self.names.append((name, end))

    def scaled(self) -> float:
        """Return the factor with which the farthest tip is at `LONGEST`."""
        ends = [float(np.linalg.norm(end)) for _, end, _ in self.arrows]
        return LONGEST / max(ends, default=1.0)


def picture_of(state: State) -> Picture:
    """Return the picture of what is shown."""
    return {"split": _split, "cross": _cross, "dyads": _dyads}[state[Skew].shown](state)


def _split(state: State) -> Picture:
    A, x, dark = matrix_of(state), np.array(state[Skew].x), DARK.on(state)
    one, other = symmetric_part(A) @ x, skew_part(A) @ x
    picture, origin = Picture(), np.zeros(3)
    picture.arrow("x", origin, x, INK[dark])
    picture.arrow("symmetric", origin, one, SKY)
    picture.arrow("A x", one, one + other, ORANGE)
    picture.fine.append((origin, one + other, GREY))
    return picture


def _cross(state: State) -> Picture:
    v, u, dark = np.array(state[Skew].v), np.array(state[Skew].u), DARK.on(state)
    picture, origin = Picture(), np.zeros(3)
    picture.arrow("v", origin, v, PURPLE)
    picture.arrow("u", origin, u, INK[dark])
    picture.arrow("S(v) u", origin, cross_of(state), ORANGE)
    picture.fine += [(v, v + u, GREY), (u, v + u, GREY)]
    return picture


def _dyads(state: State) -> Picture:
    """Return the columns, and x as the way along them, one dyad after the other."""
    A, x, dark = matrix_of(state), np.array(state[Skew].x), DARK.on(state)
    picture, origin = Picture(), np.zeros(3)
    for k, colour in enumerate((SKY, PURPLE, ORANGE)):
        picture.arrow(f"b{'₁₂₃'[k]}", origin, A[:, k], colour)
    picture.arrow("x", origin, x, INK[dark])
    at = origin
    for k, colour in enumerate((SKY, PURPLE, ORANGE)):
        to = at + A[:, k] * float(A[:, k] @ x)
        picture.fine.append((at, to, colour))
        at = to
    return picture


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the base frame and the arrows."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "skew/base", radius)
    thick, fine = Sketch(canvas, "skew/thick", 0.8), Sketch(canvas, "skew/fine", 0.6)
    names = [Named(canvas, f"skew/name{k}") for k in range(4)]

    def show(state: State) -> None:
        centre, _ = stage_of(state)
        picture = picture_of(state)
        size = picture.scaled() * radius

        def placed(segments: list[Segment]) -> list[Segment]:
            return [(centre + size * start, centre + size * end, colour) for start, end, colour in segments]

        base.show(centre)
        thick.draw(Marks(placed(picture.arrows)))
        fine.draw(Marks(strokes=placed(picture.fine)))
        for k, name in enumerate(names):
            text, at = picture.names[k] if k < len(picture.names) else ("", np.zeros(3))
            name.show(text, centre + 1.07 * size * at)

    return show


LAYER = Layer("skew", order=70, watches=(Skew, Display, RobotPart), build=build, panel="skew")
