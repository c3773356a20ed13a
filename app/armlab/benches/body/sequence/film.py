"""Two bodies: one makes three turns about moving axes, the other about fixed ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.timing import amounts
from armlab.benches.body.sequence.state import Sequence
from armlab.kin.rotations import axis_angle, rotation_about, rotation_from_sequence
from armlab.session.state import State

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Turns:
    """The three turns of one of the bodies.

    Attributes
    ----------
    axes : str
        In the order in which they are made.
    fixed : bool
        Whether the axes are those of the base, and not of the body.
    angles : ndarray, shape (3,)
        Radians, in the same order.
    places : tuple of int
        Place of each in the sequence that was chosen, which has its symbol and its colour.
    """

    axes: str
    fixed: bool
    angles: Floats
    places: tuple[int, ...]

    def angles_at(self, time: float) -> Floats:
        """Return how far each turn is made at a time of the film in seconds, shape (3,), radians."""
        return np.asarray(self.angles * amounts(time))

    def at(self, time: float) -> Floats:
        """Return the orientation at a time of the film in seconds, shape (3, 3)."""
        return np.asarray(rotation_from_sequence(self.axes, self.angles_at(time), fixed=self.fixed))

    def after(self, made: int) -> Floats:
        """Return the orientation after that many whole turns, shape (3, 3)."""
        if made == 0:
            return np.eye(3)
        return np.asarray(rotation_from_sequence(self.axes[:made], self.angles[:made], fixed=self.fixed))

    def turn(self, k: int, time: float) -> Floats:
        """Return the elementary rotation of a turn, 0-based, as far as it is made at a time, shape (3, 3)."""
        return np.asarray(rotation_about(self.axes[k], self.angles_at(time)[k]))

    def axis(self, k: int) -> Floats:
        """Return the axis of a turn, 0-based, in the base frame: one of the base, or where the body has carried it."""
        unit = np.eye(3)["xyz".index(self.axes[k])]
        return unit if self.fixed else np.asarray(self.after(k) @ unit)


def both(axes: str, fixed: bool, angles: Floats, order: str) -> tuple[Turns, Turns]:
    """Return turns about moving axes and turns about fixed axes.

    In reverse order the second ones make the same rotation (notes, theorem 2).

    Parameters
    ----------
    axes : str
        One of `armlab.kin.euler.SEQUENCES`.
    fixed : bool
        Whether the sequence is one about fixed axes.
    angles : ndarray, shape (3,)
        Radians, in the order of the sequence.
    order : "reverse" or "same"
        In which order those of the other kind are made.
    """
    chosen = Turns(axes, fixed, np.array(angles), (0, 1, 2))
    step = -1 if order == "reverse" else 1
    other = Turns(axes[::step], not fixed, chosen.angles[::step], chosen.places[::step])
    return (other, chosen) if fixed else (chosen, other)


def turns_of(state: State) -> tuple[Turns, Turns]:
    """Return the turns of both bodies, about moving axes and about fixed ones."""
    part = state[Body]
    return both(part.axes, part.fixed, state.derived(forms_of).triples.shown, state[Sequence].order)


def difference(one: Floats, other: Floats) -> float:
    """Return the largest difference of an entry of two matrices."""
    return float(np.abs(one - other).max())


def apart(one: Floats, other: Floats) -> float:
    """Return the angle of the rotation from one orientation (3, 3) to another, radians."""
    return float(axis_angle(one.T @ other)[1])
