"""A page without pictures for the camera alone: viser's own handle, what the lab tells the page, and a hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import viser

from armlab.ui.eye import TALL, Eye, Z

HEIGHT = 800


class Onlooker:
    """Stands for a client: a page that knows its camera and can be looked through.

    Attributes
    ----------
    told : list
        Messages of the lab to the page.
    """

    def __init__(self, aspect: float = 1.5) -> None:
        self.told: list[Any] = []
        self._websock_connection = SimpleNamespace(queue_message=self.told.append)
        self.camera = viser.CameraHandle(self)  # type: ignore[arg-type]
        state: Any = self.camera._state
        state.position, state.look_at, state.up_direction = np.array([3.0, 3.0, 3.0]), np.zeros(3), np.array(Z)
        state.fov, state.update_timestamp = 1.3, 1.0
        state.image_height, state.image_width = HEIGHT, round(aspect * HEIGHT)

    @property
    def eye(self) -> Eye:
        """Where the camera is."""
        camera = self.camera
        return Eye(np.array(camera.position), np.array(camera.look_at), np.array(camera.up_direction))

    def sees(self, points: np.ndarray) -> bool:
        """Return whether all points are in the picture."""
        return self.eye.sees(points, TALL, self.camera.aspect)

    async def tells(self, eye: Eye | None = None, aspect: float | None = None) -> None:
        """Tell the lab of the camera, as viser's page does with some rounding: of another place, or another shape."""
        state: Any = self.camera._state
        eye = eye or self.eye
        state.position, state.look_at, state.up_direction = eye.position * (1.0 + 1e-13), eye.look_at, eye.up + 1e-16
        if aspect is not None:
            state.image_width = round(aspect * HEIGHT)
        for callback in list(state.camera_cb):
            await callback(self.camera)


def degrees_off(one: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two directions in degrees."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(one, other)), one @ other)))


def upper_side(eye: Eye) -> np.ndarray:
    """Return the direction that is up in the picture."""
    up = eye.up - (eye.up @ eye.back) * eye.back
    return np.asarray(up / np.linalg.norm(up))
