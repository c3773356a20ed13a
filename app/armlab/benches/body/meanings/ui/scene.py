"""Three pictures of one rotation: the axes of the body, one vector in two frames, and a vector that is rotated."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.stage import pose_at, stage_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.benches.body.forms.ui.handle import body_handle
from armlab.benches.body.meanings.state import MATRIX, Meanings, image_of
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.selection import Selection
from armlab.session.state import State
from armlab.ui.colours import AXES, INK, ORANGE, PURPLE, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.format import components
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, arc
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

COLOURS: tuple[Rgb, Rgb, Rgb] = (AXES["x"], AXES["y"], AXES["z"])

ARC = 0.45
"""Radius of the arc of an angle between two axes, in radii of the outermost gimbal ring."""

STILL = 1e-6


@dataclass
class Picture:
    """Marks in the frame of the base, with lengths in radii of the outermost gimbal ring.

    Attributes
    ----------
    arrows, strokes, fine : list of (start, end, colour)
    labels : list of (text, place)
    body : bool
        Whether the block is there.
    """

    arrows: list[Segment] = field(default_factory=list)
    strokes: list[Segment] = field(default_factory=list)
    fine: list[Segment] = field(default_factory=list)
    labels: list[tuple[str, Floats]] = field(default_factory=list)
    body: bool = True


def picture_of(state: State) -> Picture:
    """Return the picture of the meaning that is shown."""
    return {"orientation": _orientation, "coordinates": _coordinates, "operator": _operator}[state[Meanings].shown](
        state
    )


def _orientation(state: State) -> Picture:
    """Return a column of R as steps along the base axes, and the angle of which a selected entry is the cosine."""
    R, selected = state.derived(forms_of).R, state[Selection].of(MATRIX)
    column = selected.column if selected.column is not None else 0
    picture = Picture()
    if selected.row is not None and selected.column is None:
        # A row is an axis of the base in the axes of the body.
        axis = np.eye(3)[selected.row]
        picture.arrows.append((np.zeros(3), axis, COLOURS[selected.row]))
        picture.strokes += steps(R.T @ axis, R)
        picture.labels.append((f"{'xyz'[selected.row]} = ({components(R[selected.row], 3)}) in x′ y′ z′", 1.08 * axis))
        return picture
    axis = R[:, column]
    picture.arrows.append((np.zeros(3), axis, COLOURS[column]))
    picture.strokes += steps(axis, np.eye(3))
    picture.labels.append((f"{'xyz'[column]}′ = ({components(axis, 3)})", 1.08 * axis))
    if selected.row is not None:
        base = np.eye(3)[selected.row]
        across = np.cross(base, axis)
        angle = float(np.arctan2(np.linalg.norm(across), base @ axis))
        if np.linalg.norm(across) > STILL:
            normal = across / np.linalg.norm(across)
            picture.fine += arc(np.zeros(3), ARC * base, normal, angle, ORANGE)
            middle = base + axis if np.linalg.norm(base + axis) > STILL else np.cross(normal, base)
            picture.labels.append((units_of(state).angle(angle), 1.15 * ARC * middle / np.linalg.norm(middle)))
    return picture


def _coordinates(state: State) -> Picture:
    """Return one vector, with steps along the axes of both frames."""
    R, p, dark = state.derived(forms_of).R, np.array(state[Meanings].p), DARK.on(state)
    image = image_of(state)
    picture = Picture(arrows=[(np.zeros(3), image, INK[dark])])
    picture.strokes += steps(p, R)
    picture.fine += steps(image, np.eye(3))
    picture.labels.append(("p", 1.06 * image))
    return picture


def _operator(state: State) -> Picture:
    """Return a vector before and after its rotation, both in the base frame, with the axis and the arc."""
    found, v, dark = state.derived(forms_of), np.array(state[Meanings].p), DARK.on(state)
    image = image_of(state)
    picture = Picture(body=False)
    picture.arrows += [(np.zeros(3), v, INK[dark]), (np.zeros(3), image, ORANGE)]
    picture.labels += [("v", 1.07 * v), ("v′ = R v", 1.07 * image)]
    if not found.still:
        picture.fine += [(-1.2 * found.axis, 1.2 * found.axis, PURPLE)]
        picture.labels.append(("r", 1.26 * found.axis))
        picture.fine += arc(np.zeros(3), v, found.axis, found.angle, ORANGE)
        foot = (v @ found.axis) * found.axis
        picture.fine += [(foot, v, PURPLE), (foot, image, PURPLE)]
    return picture


def steps(coordinates: Floats, axes: Floats) -> list[Segment]:
    """Return the way from the origin to a point along three axes (3, 3), one after the other."""
    at = np.zeros(3)
    found: list[Segment] = []
    for k in range(3):
        to = at + coordinates[k] * axes[:, k]
        found.append((at, to, COLOURS[k]))
        at = to
    return found


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the frames, the body, and the picture of the meaning."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "meanings/base", radius)
    block = Block(canvas, "meanings/block", radius, ("x′", "y′", "z′"))
    thick, fine = Sketch(canvas, "meanings/thick", 0.8), Sketch(canvas, "meanings/fine", 0.5)
    names = [Named(canvas, f"meanings/name{k}") for k in range(3)]
    handle = body_handle(canvas, "meanings/handle", radius)

    def show(state: State) -> None:
        centre, _ = stage_of(state)
        picture = picture_of(state)
        base.show(centre)
        block.visible(picture.body)
        block.show(pose_at(state.derived(forms_of).R, centre))

        def placed(segments: list[Segment]) -> list[Segment]:
            return [(centre + radius * start, centre + radius * end, colour) for start, end, colour in segments]

        thick.draw(Marks(placed(picture.arrows), placed(picture.strokes)))
        fine.draw(Marks(strokes=placed(picture.fine)))
        for k, name in enumerate(names):
            text, at = picture.labels[k] if k < len(picture.labels) else ("", np.zeros(3))
            name.show(text, centre + radius * at)
        handle(state)

    return show


LAYER = Layer(
    "meanings",
    order=69,
    watches=(Body, Meanings, Selection, Display, RobotPart, Notation),
    build=build,
    panel="meanings",
)
