"""Three ways from one orientation to another: about one axis, along a line of quaternions, and by three angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.quaternion.film import second
from armlab.benches.body.quaternion.state import Quaternions
from armlab.benches.body.quaternion.state_view import WAY_KEY, QuaternionView
from armlab.errors import InputError
from armlab.kin.motion.orientation import Orientation, about_one_axis, by_euler_angles, swept
from armlab.kin.motion.quaternion_line import along_line
from armlab.kin.quaternions import slerp
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

Floats = NDArray[np.float64]

DURATION = 4.0
"""Duration of the film, seconds; s grows evenly from 0 to 1."""

STOP = 0.5 * DURATION

POINTS = 121
"""Number of places of a trace and of a plot."""


class Slerp(Orientation):
    """About one axis, by the quaternions themselves.

    Parameters
    ----------
    p, q : ndarray, shape (4,)
    shorter : bool
    """

    def __init__(self, p: Floats, q: Floats, shorter: bool) -> None:
        self._ends, self._shorter = (p, q), shorter
        along = float(p @ q)
        R_A, R_B = (np.asarray(rotation_from_quaternion(each)) for each in (p, q))
        if not shorter and abs(along) > 1.0 - 1e-12 and along < 0.0:
            self._omega = 2.0 * np.pi * R_A[:, 2]  # a whole turn about z of the body
        else:
            turn = about_one_axis(R_A, R_B, other_way=not shorter and along < 0.0)
            self._omega = turn.angular(0.0)[0]

    def rotation(self, s: NDArray[np.floating] | float) -> Floats:  # type: ignore[override]
        """Return R(s)."""
        return np.asarray(rotation_from_quaternion(slerp(*self._ends, s, shorter=self._shorter)))

    def angular(self, s: NDArray[np.floating] | float) -> tuple[Floats, Floats]:  # type: ignore[override]
        """Return the constant omega and zeros, (..., 3) each."""
        shape = np.shape(s)
        return np.array(np.broadcast_to(self._omega, (*shape, 3))), np.zeros((*shape, 3))


@dataclass(frozen=True, eq=False)
class Ways:
    """The ways between both orientations.

    Attributes
    ----------
    by : dict of str to Orientation
        By the keys of `armlab.benches.body.quaternion.state_view.WAYS`; one that does not exist is missing.
    missing : str
        Why one is missing; empty if none is.
    along : float
        The scalar product of both unit quaternions, with the signs that they have.
    """

    by: dict[str, Orientation]
    missing: str
    along: float


def ways_of(state: State) -> Ways:
    """Return the ways from the second quaternion to that of the body."""
    p, q, part = second(state), state.derived(forms_of).q, state[Body]
    shorter = state[QuaternionView].shorter
    R_A, R_B = (np.asarray(rotation_from_quaternion(each)) for each in (p, q))
    by: dict[str, Orientation] = {"slerp": Slerp(p, q, shorter)}
    missing = ""
    try:
        by["line"] = along_line(p, q, shorter=shorter)
    except InputError:
        missing = "From q to −q the line leads through zero: there is no lerp."
    by["euler"] = by_euler_angles(R_A, R_B, part.axes, fixed=part.fixed)
    return Ways(by, missing, float(p @ q))


def film_share(state: State) -> float:
    """Return s of the film; one half while it is closed."""
    timeline = state[Timeline]
    return (timeline.time if timeline.clip == WAY_KEY else STOP) / DURATION


def present_way(state: State) -> Orientation:
    """Return the chosen way, or slerp where it does not exist."""
    by = state.derived(ways_of).by
    return by.get(state[QuaternionView].way, by["slerp"])


def turned_in_all(state: State, key: str) -> float | None:
    """Return the angle that a way turns through in all, radians; None where it does not exist."""
    way = state.derived(ways_of).by.get(key)
    return None if way is None else swept(way)


def speeds(state: State) -> tuple[Floats, dict[str, Floats]]:
    """Return s and the size of omega per unit of s along each way, rad."""
    s = np.linspace(0.0, 1.0, POINTS)
    by = state.derived(ways_of).by
    return s, {key: np.asarray(np.linalg.norm(way.angular(s)[0], axis=-1)) for key, way in by.items()}


def kinds_of_ends(state: State) -> tuple[object, ...]:
    """Return what the ways depend on."""
    part = state[Body]
    return state[Quaternions].p, part.q, part.axes, part.fixed, state[QuaternionView].shorter
