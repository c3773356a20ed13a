"""The cloud of attained positions at the tool, magnified, with its barycentre, AP as an arrow, and RP as a ball."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.pose.state import Repeats
from armlab.benches.sensor.pose.ui.cloud import Cloud, cloud_of
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import BLUE, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import lathe
from armlab.ui.format import trimmed
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Segment, Sketch
from armlab.ui.scene._nodes import add_solid, move, seen

Floats = NDArray[np.float64]

POINT = 0.0055
"""Size of a point of the cloud, in sizes of the arm."""

SIDES = 24
"""Sides of the ball of RP, and rings from pole to pole."""

SMALLEST = 1e-3
"""Radius of the ball, and length of the arrow, in sizes of the arm, below which they are not drawn."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the cloud."""
    scene, path = canvas.scene, canvas.path("pose_accuracy")
    heights = np.linspace(0.0, np.pi, SIDES + 1)
    ball = add_solid(
        scene,
        f"{path}/ball",
        lathe([(float(np.sin(at)), float(-np.cos(at))) for at in heights], SIDES, soft=True),
        BLUE,
        opacity=0.16,
    )
    points: Any = None
    sketch = Sketch(canvas, "pose_accuracy/arrow", 0.6)

    def show(state: State) -> None:
        nonlocal points
        cloud = state.derived(cloud_of)
        if points is not None:
            points.remove()
        points = scene.add_point_cloud(
            f"{path}/points",
            cloud.points.astype(np.float32),
            VERMILLION,
            point_size=POINT * canvas.size,
            point_shape="circle",
        )
        seen(ball, cloud.radius > SMALLEST * canvas.size)
        ball.scale = max(cloud.radius, SMALLEST * canvas.size)
        move(ball, cloud.mean)
        sketch.draw(marks(cloud, canvas.size))

    return show


def marks(cloud: Cloud, size: float) -> Marks:
    """Return the arrow from the commanded position to the barycentre, and the magnification in words."""
    away = np.linalg.norm(cloud.mean - cloud.commanded) > SMALLEST * size
    arrows: list[Segment] = [(cloud.commanded, cloud.mean, BLUE)] if away else []
    top = max(float(cloud.points[:, 2].max()), float(cloud.mean[2]) + cloud.radius)
    at = np.array([cloud.mean[0], cloud.mean[1], top + 0.02 * size])
    return Marks(arrows, label=words(cloud), at=at)


def words(cloud: Cloud) -> str:
    """Return what is written beside the cloud.

    >>> words(Cloud(2000.0, *[np.zeros(3)] * 3, 0.0))
    'errors × 2000'
    """
    return f"errors × {trimmed(cloud.magnification, 0)}"


LAYER = Layer(
    "pose_accuracy",
    order=82,
    watches=(Repeats, Joints, RobotPart, Notation, Display),
    build=build,
    panel="pose_accuracy",
)
