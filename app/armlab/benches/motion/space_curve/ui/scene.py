"""The page of geometry in the scene: a curve with its moving frame, or two turns on a sphere."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.motion.space_curve.laid import FORMULA, Laid, Moment
from armlab.benches.motion.space_curve.stage import Stage, sphere_of, stage_of
from armlab.benches.motion.space_curve.state import SpaceCurve, curve_of, moment_of, turn_of, turn_place
from armlab.benches.motion.space_curve.turn import Turned
from armlab.benches.motion.space_curve.ui.frenet import FrenetFrame
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import AXES, BLUE, GREEN, GREY, SKY, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.figure.solids import along
from armlab.ui.format import trimmed
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._arrows import Arrow, pale_frame
from armlab.ui.scene._nodes import add_triad, move, seen, turn, write
from armlab.ui.scene._polyline import ROUGHNESS, simplified
from armlab.ui.scene._strokes import add_line, add_name, dashes, polyline

Floats = NDArray[np.float64]

LINE, TRACE, AXIS = 0.005, 0.005, 0.003
"""Thickness of the curve, of the path of a tip, and of an axis, in sizes of the arm."""

POINT = 0.011
"""Size of a waypoint, in sizes of the arm."""

MOST_NAMES = 8
"""Largest number of waypoints with a number, as more would cover each other."""

PEAK = 2.0
"""Length of the largest velocity and acceleration, in lengths of the unit vectors."""

SHORT = 0.03
"""Shortest arrow that is drawn, in lengths of the unit vectors."""

BESIDE = 0.06
"""Distance of a number from its waypoint, in sizes of the arm."""

NAMES = {"velocity": "ṗ", "tangential": "p′s̈", "centripetal": "p″ṡ²"}
COLOURS = {"velocity": GREEN, "tangential": VERMILLION, "centripetal": SKY}

ORIGIN = 0.8
"""Length of the axes at the origin of a model, in lengths of the unit vectors."""

INNER = 1.18
"""Length of the axis of a turn, in radii of the sphere."""


class _Curve:
    """The curve, its waypoints, its frame and its arrows."""

    def __init__(self, canvas: LayerCanvas) -> None:
        scene, size, path = canvas.scene, canvas.size, canvas.path
        self._size, self._canvas = size, canvas
        nothing = np.zeros((1, 2, 3), dtype=np.float32)
        self._line = add_line(scene, path("space_curve/line"), nothing, BLUE, size, LINE)
        self._points: viser.PointCloudHandle | None = None
        self._names = [
            add_name(scene, path(f"space_curve/name{k}"), str(k + 1), np.zeros(3), "center-center")
            for k in range(MOST_NAMES)
        ]
        self._frame = FrenetFrame(canvas, "space_curve/frenet", 0.1 * size)
        self._arrows = {
            key: Arrow(scene, path(f"space_curve/{key}"), colour, 0.6 * size) for key, colour in COLOURS.items()
        }
        self._origin = add_triad(scene, path("space_curve/origin"), size)
        self._ratio = add_name(scene, path("space_curve/ratio"), "", np.zeros(3), "top-center")
        self._drawn: tuple[Laid, Stage] | None = None

    def show(self, state: State) -> None:
        part = state[SpaceCurve]
        on = part.shown == "curve"
        for node in (self._line, self._points, *self._names, self._origin, self._ratio):
            if node is not None:
                seen(node, on)
        if not on:
            self._frame.hide()
            self._show_arrows(None, None, None)
            return
        found, stage = state.derived(curve_of), state.derived(stage_of)
        if self._drawn is None or self._drawn[0] is not found or self._drawn[1] is not stage:
            self._drawn = found, stage
            self._draw(found, stage)
        self._draw_points(part, stage)
        self._travel(part, state.derived(moment_of), found, stage)

    def _draw(self, found: Laid, stage: Stage) -> None:
        drawn = stage.at(found.frame.position)
        self._line.points = polyline(drawn[simplified(drawn, ROUGHNESS * self._size)])
        self._frame.resize(stage.length)
        move(self._origin, stage.shift)
        self._origin.scale = min(FRAME_LENGTH * self._size, ORIGIN * stage.length)
        write(self._ratio, f"model 1 : {trimmed(stage.ratio, 1)}" if stage.model else "")
        lowest = drawn[int(drawn[:, 2].argmin())]
        move(self._ratio, lowest - np.array([0.0, 0.0, 0.03 * self._size]))

    def _draw_points(self, part: SpaceCurve, stage: Stage) -> None:
        seen(self._origin, stage.model)
        seen(self._ratio, stage.model)
        own = () if part.curve.key == FORMULA else part.points
        numbered = len(own) if len(own) <= MOST_NAMES else 0
        places = stage.at(np.array(own)) if own else np.zeros((0, 3))
        for k, name in enumerate(self._names):
            first = k < numbered and own.index(own[k]) == k
            seen(name, first)
            if first:
                same = [str(j + 1) for j in range(numbered) if own[j] == own[k]]
                write(name, ", ".join(same))
                move(name, places[k] - np.array([0.0, 0.0, BESIDE * self._size]))
        if self._points is not None:
            seen(self._points, bool(own))
        if not own:
            return
        points = places.astype(np.float32)
        if self._points is None:
            self._points = self._canvas.scene.add_point_cloud(
                self._canvas.path("space_curve/points"),
                points,
                BLUE,
                point_size=POINT * self._size,
                point_shape="circle",
                point_shading="flat",
                precision="float32",
            )
        elif not np.array_equal(self._points.points, points):
            self._points.points = points

    def _travel(self, part: SpaceCurve, moment: Moment, found: Laid, stage: Stage) -> None:
        frame = moment.frame
        at = stage.at(moment.p)
        if part.frame:
            kappa = float(frame.curvature) / stage.factor
            self._frame.show(at, frame.tangent, frame.normal, frame.binormal, kappa)
        else:
            self._frame.hide()
        self._show_arrows(moment if part.arrows else None, stage, found)

    def _show_arrows(self, moment: Moment | None, stage: Stage | None, found: Laid | None) -> None:
        for key, arrow in self._arrows.items():
            vector = np.zeros(3) if moment is None else getattr(moment, key)
            length = 0.0
            if moment is not None and stage is not None and found is not None:
                peak = found.peaks[0] if key == "velocity" else found.peaks[1]
                length = float(np.linalg.norm(vector)) * PEAK * stage.length / peak if peak > 0.0 else 0.0
                length = length if length > SHORT * stage.length else 0.0
                if length:
                    arrow.place(along(vector, stage.at(moment.p)))
            arrow.show(length, 2.0 * length, True, NAMES[key] if length else "")


class _Turn:
    """A sphere with the paths of the tips of the axes, and both frames on it."""

    def __init__(self, canvas: LayerCanvas, radius: float) -> None:
        scene, size = canvas.scene, canvas.size
        path = canvas.path("space_curve/turn")
        self._root = scene.add_frame(path, show_axes=False, visible=False)
        scene.add_icosphere(
            f"{path}/sphere",
            radius=radius,
            color=GREY,
            subdivisions=4,
            opacity=0.14,
            cast_shadow=False,
            receive_shadow=False,
        )
        self._radius = radius
        nothing = np.zeros((1, 2, 3), dtype=np.float32)
        self._ways = [
            {
                axis: add_line(scene, f"{path}/{kind}_{axis}", nothing, colour, size, TRACE if kind == "one" else AXIS)
                for axis, colour in AXES.items()
            }
            for kind in ("one", "euler")
        ]
        self._one = add_triad(scene, f"{path}/one", radius / FRAME_LENGTH)
        self._euler = pale_frame(scene, f"{path}/euler", radius, 0.42)
        self._axis = add_line(scene, f"{path}/axis", nothing, GREY, size, AXIS)
        self._labels = {
            key: add_name(scene, f"{path}/label_{key}", key, np.zeros(3), "center-center") for key in ("r", "A", "B")
        }
        self._drawn: Turned | None = None

    def show(self, state: State) -> None:
        on = state[SpaceCurve].shown == "turn"
        seen(self._root, on)
        if not on:
            return
        found = state.derived(turn_of)
        if found is not self._drawn:
            self._drawn = found
            self._draw(found)
        centre, _ = sphere_of(state)
        move(self._root, centre)
        s, _ = turn_place(state)
        turn(self._one, found.straight.rotation(s))
        turn(self._euler, found.euler.rotation(s))

    def _draw(self, found: Turned) -> None:
        for which, (ways, rotations) in enumerate(zip(self._ways, found.rotations, strict=True)):
            for k, way in enumerate(ways.values()):
                segments = polyline(self._radius * rotations[:, :, k])
                # The way by three angles is dashed: colour alone would not tell.
                way.points = segments if which == 0 else segments.reshape(-1, 4, 2, 3)[:, :2].reshape(-1, 2, 3)
        turns = abs(found.straight.angle) > 1e-9
        seen(self._axis, turns)
        seen(self._labels["r"], turns)
        r = INNER * self._radius * (found.straight.start @ found.straight.axis) * (1.0 if turns else 0.0)
        if turns:
            self._axis.points = dashes(-r, r, 14)
            move(self._labels["r"], 1.08 * r)
        for key, k in (("A", 0), ("B", -1)):
            tip = found.rotations[0][k, :, 2]
            move(self._labels[key], 1.14 * self._radius * tip)
            write(self._labels[key], key)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the curve or the turn of the page, while it is open."""
    curve, sphere = _Curve(canvas), _Turn(canvas, sphere_of(state)[1])

    def show(state: State) -> None:
        curve.show(state)
        sphere.show(state)

    return show


LAYER = Layer("space_curve", order=82, watches=(SpaceCurve, Timeline), build=build, panel="space_curve")
