"""A body that turns beside the arm: its frame, the axes of its three turns and omega, or the frames of two laws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.api import sphere_of
from armlab.benches.velocity.turning.motion import law_rotation, laws_time, turned_of
from armlab.benches.velocity.turning.state import MATRIX, Turning
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.selection import Selection
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import GREY, INK, joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._arrows import pale_frame
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Segment, Sketch, Triad
from armlab.ui.scene._nodes import move, seen
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

BODY = 1.3
"""Size of the block, the radius of a ring around it, in radii."""

AXIS = 1.25
"""Half length of the axis of a turn, in radii."""

OMEGA = 1.6
"""Length of the arrow of the angular velocity `USUAL`, in radii."""

USUAL = 0.5
"""Angular velocity that is drawn in full length, rad/s; faster ones are drawn no longer."""

APART = 1.15
"""Distance of the two bodies of the laws from the middle, in radii."""

PALE = 0.9
"""Length of the fixed frame, in lengths of the body's frame."""

LEAST = 0.02
"""Angular velocity below which nothing is drawn, rad/s."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw one body, or two side by side."""
    bodies = [Triad(canvas, f"turning/body{k}") for k in range(2)]
    block = Block(canvas, "turning/block", BODY * sphere_of(state)[1])
    fixed = pale_frame(canvas.scene, canvas.path("turning/fixed"), PALE * FRAME_LENGTH * canvas.size, 0.35)
    axes, omega = Sketch(canvas, "turning/axes", 0.7), Sketch(canvas, "turning/omega", 0.8)

    def show(state: State) -> None:
        centre, radius = sphere_of(state)
        laws = state[Turning].shown == "laws"
        bodies[1].visible(laws)
        block.visible(not laws)
        seen(fixed, not laws)
        if laws:
            _show_laws(bodies, state, centre, radius)
            axes.draw(Marks())
            omega.draw(Marks())
            return
        found = state.derived(turned_of)
        bodies[0].show("", _pose(centre, found.R))
        block.show(_pose(centre, found.R))
        move(fixed, centre)
        axes.draw(axes_marks(state, centre, radius))
        omega.draw(omega_marks(state, centre, radius))

    return show


def _pose(centre: Floats, R: Floats) -> Floats:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R, centre
    return pose


def _show_laws(bodies: list[Triad], state: State, centre: Floats, radius: float) -> None:
    time = laws_time(state)
    for law, body in enumerate(bodies):
        side = np.array([0.0, 0.0, APART * radius * (1.0 - 2.0 * law)])
        body.show(f"law {law + 1}", _pose(centre + side, law_rotation(law, time)))


def axes_marks(state: State, centre: Floats, radius: float) -> Marks:
    """Return the axes of the three turns, the columns of T; a selected one is an arrow."""
    found, selected = state.derived(turned_of), state[Selection].of(MATRIX)
    strokes: list[Segment] = []
    arrows: list[Segment] = []
    for k in range(3):
        tip = AXIS * radius * found.T[:, k]
        strokes.append((centre - 0.5 * tip, centre + tip, joint_colour(k)))
        if selected.matrix and selected.column == k:
            arrows.append((centre, centre + tip, joint_colour(k)))
    if selected.matrix and selected.row is not None:
        way = AXIS * radius * np.eye(3)[selected.row]
        strokes.append((centre, centre + way, GREY))
    return Marks(arrows, strokes)


def omega_marks(state: State, centre: Floats, radius: float) -> Marks:
    """Return omega as an arrow, with its size."""
    found, units = state.derived(turned_of), units_of(state)
    size = float(np.linalg.norm(found.omega))
    if size < LEAST:
        return Marks()
    tip = centre + OMEGA * radius * min(1.0, size / USUAL) * found.omega / size
    label = f"ω {units.text(size, True)} {units.angle_unit}/s"
    return Marks([(centre, tip, INK[DARK.on(state)])], label=label, at=tip)


LAYER = Layer(
    "turning",
    order=67,
    watches=(Turning, Timeline, Selection, Notation, Display, RobotPart),
    build=build,
    panel="turning",
)
