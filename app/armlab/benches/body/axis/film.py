"""Two bodies: one is turned about r in three steps, C R_z(theta) C^T, the other about r itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.axis.state import CLIP_KEY
from armlab.benches.body.forms.film import time_of
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.timing import amounts
from armlab.kin.axis_angle import frame_about
from armlab.kin.rotations import axis_angle, rotation_about, rotation_from_axis_angle
from armlab.session.state import State

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Steps:
    """The three steps of one rotation.

    Attributes
    ----------
    r : ndarray, shape (3,)
        The axis, of unit length.
    angle : float
        Radians.
    C : ndarray, shape (3, 3)
        The frame [n s r].
    """

    r: Floats
    angle: float
    C: Floats

    def parts(self, time: float) -> tuple[Floats, Floats, Floats]:
        """Return C^T, R_z(theta) and C, each (3, 3), as far as they are made at a time of the film in seconds."""
        there, turned, back = amounts(time).tolist()
        axis, angle = axis_angle(self.C)
        return (
            np.asarray(rotation_from_axis_angle(axis, -there * angle)),
            np.asarray(rotation_about("z", turned * self.angle)),
            np.asarray(rotation_from_axis_angle(axis, back * angle)),
        )

    def at(self, time: float) -> Floats:
        """Return the orientation of the body that makes the steps, (3, 3)."""
        there, turned, back = self.parts(time)
        return np.asarray(back @ turned @ there)

    def direct(self, time: float) -> Floats:
        """Return the orientation of the body that turns about r while the other one turns about z, (3, 3)."""
        return np.asarray(rotation_from_axis_angle(self.r, self.turned(time)))

    def turned(self, time: float) -> float:
        """Return the angle of the second step, as far as it is made, radians."""
        return float(amounts(time)[1]) * self.angle

    def carried(self, time: float) -> Floats:
        """Return where the steps have carried r, (3,): to z and back."""
        return np.asarray(self.at(time) @ self.r)


def steps_of(state: State) -> Steps:
    """Return the steps for axis and angle of the body."""
    found = state.derived(forms_of)
    return Steps(found.axis, found.angle, frame_about(found.axis))


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its end while it is closed."""
    return time_of(state, CLIP_KEY)
