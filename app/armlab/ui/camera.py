"""The camera of a browser."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.content.robots import Camera as View
from armlab.content.robots import Robot
from armlab.ui.figure.figure import Figure

FIELD_OF_VIEW = math.radians(32.0)
"""Angle of view, radians; viser's 75 degrees distort arms."""

PRESETS: dict[str, tuple[float, float] | None] = {
    "Home": None,
    "Front": (-90.0, 6.0),
    "Side": (0.0, 6.0),
    "Top": (-90.0, 89.0),
}
"""Azimuth and elevation of each view, in degrees; the home view is the robot's own."""


GROWN = 1.6
"""Factor by which an edited arm must grow or shrink for a new view."""

MARGIN = 0.9
"""Least distance of the eye after it has stepped back, relative to its distance before."""

SETTLING = 4.0
"""Time after the start, or the opening of a dock, in which the panels may still take their part of the window,
seconds."""


class Camera:
    """The camera of one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    pose : callable
        Returns the present joint values.
    around : callable
        Returns points (k, 3) that belong in the picture beside the arm.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        pose: Callable[[], NDArray[np.float64]],
        around: Callable[[], NDArray[np.float64]] = lambda: np.zeros((0, 3)),
    ) -> None:
        self._client, self._pose, self._around = client, pose, around
        self._robot: Robot | None = None
        self._lesson: View | None = None
        self._figure: Figure | None = None
        self._aspect, self._began, self._roomy, self._size = 0.0, time.monotonic(), False, math.inf
        client.camera.on_update(self._moved)

    async def _moved(self, _camera: object) -> None:
        """Look again when docking the panels has changed the shape of the picture, which viser reports late."""
        reshaped = abs(self._client.camera.aspect - self._aspect) > 0.01 * self._aspect
        if reshaped and time.monotonic() - self._began < SETTLING:
            self.look_from("Home")

    def make_room(self, on: bool, home: View | None = None) -> None:
        """Show every named pose of an arm in the picture, not only its home pose, because a lesson uses them.

        The lesson may have a home view of its own.

        The dock that opens with it gives the picture another shape, so that is waited for.
        """
        self._roomy, self._lesson = on, home
        if on:
            self._began = time.monotonic()
            self.look_from("Home")

    def follow(self, robot: Robot, figure: Figure, stay: bool = False) -> None:
        """Look at another arm, from its home view, or from the present place unless its size differs much."""
        self._robot, self._figure = robot, figure
        if not stay or not 1.0 / GROWN < figure.anatomy.size / self._size < GROWN:
            self.look_from("Home")
        else:
            self.keep_in_view()

    def keep_in_view(self) -> None:
        """Step back, in the present direction of view, if the arm or a point around it is not in the picture."""
        if self._robot is None or self._figure is None or len(self._pose()) != self._robot.arm.n:
            return
        arm, q = self._robot.arm, self._pose()
        camera = self._client.camera
        back = np.asarray(camera.position) - np.asarray(camera.look_at)
        distance = float(np.linalg.norm(back))
        points = np.vstack([arm.frames(q)[:, :3, 3], arm.position(q), self._around()])
        if distance == 0.0 or self._seen(points, back / distance):
            return
        bounds = self._bounds(self._robot, self._figure)
        middle = bounds.mean(axis=0)
        radius = float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0
        self._stand(middle, max(1.02 * radius / math.sin(self._narrow()), MARGIN * distance), back / distance)

    def _seen(self, points: NDArray[np.float64], back: NDArray[np.float64]) -> bool:
        """Return whether points are visible to an eye that looks at a point against ``back``."""
        camera = self._client.camera
        right = np.cross([0.0, 0.0, 1.0], back)
        if np.linalg.norm(right) < 1e-9:
            right = np.array([1.0, 0.0, 0.0])
        right /= np.linalg.norm(right)
        up = np.cross(back, right)
        away = points - np.asarray(camera.position)
        depth = -(away @ back)
        half = math.tan(camera.fov / 2.0)
        inside = (np.abs(away @ up) < half * depth) & (np.abs(away @ right) < half * camera.aspect * depth)
        return bool(np.all(inside & (depth > 0.0)))

    def _narrow(self) -> float:
        """Return half the angle of view, for the smaller of height and width."""
        return math.atan(math.tan(FIELD_OF_VIEW / 2.0) * min(1.0, self._client.camera.aspect))

    def _stand(self, middle: NDArray[np.float64], distance: float, back: NDArray[np.float64]) -> None:
        camera = self._client.camera
        # In this order: assigning the position keeps the point looked at.
        camera.fov = FIELD_OF_VIEW
        camera.look_at = middle
        camera.position = middle + distance * back
        camera.look_at = middle

    def look_from(self, preset: str) -> None:
        """Look from one of the `PRESETS`, with the whole arm in the picture, at home and at present."""
        if self._robot is None or self._figure is None:
            return
        home = self._lesson or self._robot.camera
        azimuth, elevation = PRESETS[preset] or (home.azimuth_deg, home.elevation_deg)
        bounds = self._bounds(self._robot, self._figure)
        middle = bounds.mean(axis=0)
        radius = float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0
        self._aspect, self._size = self._client.camera.aspect, self._figure.anatomy.size
        distance = 1.02 * home.distance * radius / math.sin(self._narrow())
        self._stand(middle, distance, _direction(math.radians(azimuth), math.radians(elevation)))

    def as_view(self) -> View:
        """Return the present view in the form of a lesson or a robot file."""
        camera = self._client.camera
        back = np.asarray(camera.position) - np.asarray(camera.look_at)
        distance = float(np.linalg.norm(back))
        x, y, z = back / distance if distance else (1.0, 0.0, 0.0)
        elevation = math.degrees(math.asin(min(1.0, max(-1.0, z))))
        usual = distance
        if self._robot is not None and self._figure is not None:
            bounds = self._bounds(self._robot, self._figure)
            usual = 1.02 * float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0 / math.sin(self._narrow())
        factor = min(3.0, max(0.3, distance / usual if usual else 1.0))
        return View(round(math.degrees(math.atan2(y, x)), 1), round(elevation, 1), round(factor, 2))

    def _bounds(self, robot: Robot, figure: Figure) -> NDArray[np.float64]:
        """Return the corners (2, 3) of a box around the arm at home, or in all its poses, and at present."""
        boxes = [figure.bounds(q) for q in (robot.poses.values() if self._roomy else [robot.home])]
        if len(self._pose()) == robot.arm.n:  # while another arm is being fetched its pose is there already
            boxes.append(figure.bounds(self._pose()))
        points = np.vstack([*boxes, self._around()])
        return np.array([points.min(axis=0), points.max(axis=0)])


def _direction(azimuth: float, elevation: float) -> NDArray[np.float64]:
    return np.array(
        [math.cos(azimuth) * math.cos(elevation), math.sin(azimuth) * math.cos(elevation), math.sin(elevation)]
    )
