"""A body on its way from one orientation to another, and the traces of the tip of its z axis along three ways."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.stage import pose_at, stage_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.benches.body.quaternion.between import POINTS, film_share, kinds_of_ends, present_way, ways_of
from armlab.benches.body.quaternion.state import Quaternions
from armlab.benches.body.quaternion.state_view import WAYS, QuaternionView
from armlab.benches.body.quaternion.ui.way import COLOURS
from armlab.kin.motion.orientation import Orientation
from armlab.session.parts.display import Display
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import GREY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, arc

Floats = NDArray[np.float64]

SPHERE = 1.0
"""Radius of the sphere of the traces, in that of the outermost gimbal ring."""

ENDS = ("p", "q")


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the body, the sphere, the traces, and where each way is at present."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "way/base", radius)
    block = Block(canvas, "way/block", radius, ("x′", "y′", "z′"))
    traces, sphere, hands = (Sketch(canvas, f"way/{name}", weight) for name, weight in _WEIGHTS.items())
    names = [Named(canvas, f"way/end{k}") for k in range(2)]
    drawn: object = None

    def show(state: State) -> None:
        nonlocal drawn
        on = state[QuaternionView].shown == "way"
        base.visible(on)
        block.visible(on)
        if not on:
            for sketch in (traces, sphere, hands):
                sketch.draw(Marks())
            for name in names:
                name.show("", np.zeros(3))
            drawn = None
            return
        centre, _ = stage_of(state)
        share = film_share(state)
        base.show(centre)
        block.show(pose_at(present_way(state).rotation(share), centre))
        hands.draw(hands_of(state, share, centre, radius))
        if drawn != (ends := kinds_of_ends(state)):
            drawn = ends
            traces.draw(traces_of(state, centre, radius))
            sphere.draw(circles(centre, radius))
        for k, name in enumerate(names):
            name.show(ENDS[k], centre + 1.1 * SPHERE * radius * tips(present_way(state), np.array([float(k)]))[0])

    return show


_WEIGHTS = {"traces": 0.7, "sphere": 0.3, "hands": 0.5}
"""Thickness of the sketches by name."""


def tips(way: Orientation, s: Floats) -> Floats:
    """Return the tip of the z axis of the body at places of a way, (N, 3), of length 1."""
    return np.asarray(way.rotation(s)[..., :, 2])


def traces_of(state: State, centre: Floats, radius: float) -> Marks:
    """Return the traces of all ways."""
    strokes: list[Segment] = []
    s = np.linspace(0.0, 1.0, POINTS)
    for key, way in state.derived(ways_of).by.items():
        points = centre + SPHERE * radius * tips(way, s)
        strokes += [(one, other, COLOURS[key]) for one, other in pairwise(points)]
    return Marks(strokes=strokes)


def hands_of(state: State, share: float, centre: Floats, radius: float) -> Marks:
    """Return an arrow from the middle to where each way is at present."""
    by = state.derived(ways_of).by
    at = np.array([share])
    arrows: list[Segment] = [
        (centre, centre + SPHERE * radius * tips(by[key], at)[0], COLOURS[key]) for key in WAYS if key in by
    ]
    return Marks(arrows)


def circles(centre: Floats, radius: float) -> Marks:
    """Return three great circles that stand for the sphere."""
    strokes: list[Segment] = []
    for axis in np.eye(3):
        start = SPHERE * radius * np.roll(axis, 1)
        strokes += arc(centre, start, axis, 2.0 * np.pi, GREY)
    return Marks(strokes=strokes)


LAYER = Layer(
    "quaternion_way",
    order=73,
    watches=(Body, Quaternions, QuaternionView, Timeline, Display, RobotPart),
    build=build,
    panel="quaternion",
)
