"""A recording of a motion that plays by itself: a page without a lab behind it, or a file for viser's own player."""

from __future__ import annotations

import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Literal, cast

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.motion import Motion
from armlab.running_loop import running_loop
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.canvas import Canvas
from armlab.ui.colours import BLUE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.eye import FIELD_OF_VIEW
from armlab.ui.figure.drawn import Drawn
from armlab.ui.figure.figure import build_figure
from armlab.ui.html import joined
from armlab.ui.manners import Manners
from armlab.ui.scene import arm as arm_layer
from armlab.ui.scene import stage
from armlab.ui.scene._polyline import ROUGHNESS, simplified
from armlab.ui.scene._strokes import polyline
from armlab.ui.switches import DARK

Floats = NDArray[np.float64]
Kind = Literal["html", "viser"]

POSES_PER_SECOND = 30.0

LONGEST = 120.0
"""Longest recording, seconds: 3600 poses, with six joints about a megabyte besides the page itself."""

TUBE = 0.006
"""Thickness of the path of the tool, in sizes of the arm."""

ROOM = 0.85
"""Distance of the eye, relative to that which shows the whole ball around the motion, whose corners are empty."""

SKY = {
    False: "linear-gradient(#d9e2ec, #eef2f6 50%, #fbfcfd)",
    True: "linear-gradient(#2b333f, #1e242d 55%, #161a20)",
}
"""Background of the scene, by whether the theme is dark, as in the lab."""


@dataclass(frozen=True, eq=False)
class Scenario:
    """The motion to be recorded, and its scene.

    Attributes
    ----------
    state : State
        Its arm and its theme.
    motion : Motion
    azimuth, elevation : float
        Where the eye is, seen from the arm; radians.
    """

    state: State
    motion: Motion
    azimuth: float
    elevation: float


@cache
def maker() -> ThreadPoolExecutor:
    """Return the thread that makes files one after the other, so that a class leaves time for the lab."""
    return ThreadPoolExecutor(1, "armlab-files")


def refuse_long(duration: float) -> None:
    """Raise `InputError` for a motion that is too long for a recording."""
    if duration > LONGEST:
        raise InputError(f"recording: the motion lasts {duration:.4g} s; at most {LONGEST:g} s can be recorded")


def record(scenario: Scenario, kind: Kind) -> bytes:
    """Return a recording in real time: the arm, the ground and the path of the tool.

    It takes about a second: call it outside of the event loop and of the worker.

    Parameters
    ----------
    scenario : Scenario
    kind : "html" or "viser"
        A page that opens from a disk, with its player; or the recording alone, for a player one has already.

    Raises
    ------
    InputError
        The motion lasts longer than `LONGEST`.
    """
    refuse_long(scenario.motion.duration)
    with _server() as server:
        frames = _frames(scenario, server)
        recorder = server.get_scene_serializer()
        for step in frames:
            recorder.insert_sleep(step)
        if kind == "viser":
            return recorder.serialize()
        return _page(scenario.state, recorder.as_html(dark_mode=DARK.on(scenario.state))).encode()


@contextmanager
def _server() -> Iterator[viser.ViserServer]:
    """Provide a server to draw on, which nobody sees."""
    with running_loop("armlab-recording") as loop:
        server, _ = adapter.make_server(loop, Manners())
        try:
            server.scene.configure_default_lights(False)
            server.scene.configure_environment_map(None)
            server.scene.world_axes.visible = False
            yield server
        finally:
            adapter.stop_server(server)


def _frames(scenario: Scenario, server: viser.ViserServer) -> Iterator[float]:
    """Draw the first pose, and return an iterator that draws the following ones and yields the seconds before each."""
    state, motion = scenario.state, scenario.motion
    arm = state[RobotPart].robot.arm
    count = max(math.ceil(motion.duration * POSES_PER_SECOND), 1)
    t = np.linspace(0.0, motion.duration, count + 1)
    poses = np.asarray(arm.clip(motion.at(t)), dtype=np.float64)
    figure = build_figure(arm)
    drawn = Drawn(figure, figure.glbs(), [])
    # A server draws as a client does; here nobody can hand in commands.
    canvas = Canvas(cast(viser.ClientHandle, server), drawn, lambda command: None, poses[0], 0)
    start = state.replace(state[Joints].freed_at(poses[0]), Timeline.initial(state[RobotPart].robot))
    for layer in (stage.LAYER, arm_layer.LAYER):
        layer.build(LayerCanvas(canvas), start)(start)
    _draw_way(server, canvas, np.asarray(arm.position(poses), dtype=np.float64))
    _look(server, scenario, drawn, poses)
    return _moving(canvas, poses, motion.duration / count)


def _moving(canvas: Canvas, poses: Floats, step: float) -> Iterator[float]:
    for q in poses[1:]:
        yield step
        canvas.show_pose(q, at_once=True)


def _draw_way(server: viser.ViserServer, canvas: Canvas, points: Floats) -> None:
    if np.ptp(points, axis=0).max() < 1e-6 * canvas.size:
        return
    segments = polyline(points[simplified(points, ROUGHNESS * canvas.size)])
    server.scene.add_line_segments(canvas.path("way"), segments, BLUE, thickness=TUBE * canvas.size)


def _look(server: viser.ViserServer, scenario: Scenario, drawn: Drawn, poses: Floats) -> None:
    """Place the eye so that it sees the whole motion."""
    some = poses[np.linspace(0, len(poses) - 1, min(len(poses), 25)).round().astype(int)]
    boxes = np.array([drawn.figure.bounds(q) for q in some])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    middle, radius = 0.5 * (low + high), 0.5 * float(np.linalg.norm(high - low))
    distance = ROOM * radius / math.sin(0.5 * FIELD_OF_VIEW)
    around, up = scenario.azimuth, scenario.elevation
    back = np.array([math.cos(around) * math.cos(up), math.sin(around) * math.cos(up), math.sin(up)])
    camera = server.initial_camera
    camera.fov, camera.look_at, camera.position = FIELD_OF_VIEW, middle, middle + distance * back


def _page(state: State, html: str) -> str:
    """Return viser's page with a title and the background of the lab."""
    name = joined(state[RobotPart].robot.name)
    style = f"canvas[data-engine] {{ background: {SKY[DARK.on(state)]}; }}"
    html = html.replace("<title>Viser</title>", f"<title>{name}: motion</title>", 1)
    return html.replace("</head>", f"<style>{style}</style></head>", 1)
