"""The result of following a tool path: joint samples, and the places where the arm cannot go on."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion.path import Path, PolynomialPath
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]
Kind = Literal["reach", "limit", "singularity", "branch"]


@dataclass(frozen=True, eq=False)
class Stop:
    """A place where the arm cannot go on along the path.

    Attributes
    ----------
    kind : str
        ``"reach"``: no configuration reaches the path behind it; ``"limit"``: a joint is at its limit;
        ``"singularity"``: the branch ends in a singular configuration, from which another one may go on after a turn on
        the spot; ``"branch"``: it ends there, and only a branch that is elsewhere goes on.
    s : float
    point : ndarray, shape (3,)
        Tool point, world, metres.
    q : ndarray, shape (n,)
        The last configuration.
    joint : int
        1-based joint at its limit; 0 for other kinds.
    other : ndarray, shape (n,) or None
        A configuration inside the limits just behind the stop.
    sentence : str
        Sentence on what happened and what would help.
    """

    kind: Kind
    s: float
    point: Floats
    q: Floats
    joint: int
    other: Floats | None
    sentence: str


@dataclass(frozen=True, eq=False)
class Followed:
    """Joint samples along a tool path.

    Attributes
    ----------
    arm : Arm
    s : ndarray, shape (N,)
    q : ndarray, shape (N, n)
        Rad or m; nan where the path is not followed.
    slope : ndarray, shape (N, n)
        dq/ds = J# times the twist per unit of s (least squares, shortest); nan as ``q``.
    reached : ndarray of bool, shape (N,)
    stops : tuple of Stop
        Stops in the order of s; empty when the whole path is followed.
    parts : tuple of (int, int)
        First sample and the one after the last of each part followed without a jump.
    singular_value : ndarray, shape (N,)
        The smallest over the largest singular value of the task Jacobian (pure numbers): 0 at a singularity.
    corners : tuple of int
        Samples at which the path of the tool has a corner; their ``slope`` is that behind it.
    arriving : ndarray, shape (c, n)
        dq/ds before each corner.
    """

    arm: Arm
    s: Floats
    q: Floats
    slope: Floats
    reached: NDArray[np.bool_]
    stops: tuple[Stop, ...]
    parts: tuple[tuple[int, int], ...]
    singular_value: Floats
    corners: tuple[int, ...]
    arriving: Floats

    @property
    def whole(self) -> bool:
        """Whether the whole path is followed on one branch."""
        return not self.stops and bool(self.reached.all())

    @property
    def reason(self) -> str:
        """The sentence of the first stop, or the statement that there is none."""
        if self.stops:
            return self.stops[0].sentence
        if self.whole:
            return "The whole path is followed on one branch."
        s = self.s[int(np.argmin(self.reached))]
        return f"The branch is followed, but at s = {s:.4f} no solution on it was found: too near a singularity."

    @property
    def differences(self) -> Floats:
        """dq/ds by central differences of the samples, (N, n), one-sided at the ends, to compare with ``slope``."""
        found = np.full(self.q.shape, np.nan)
        for first, last in self.parts:
            if last - first > 1:
                found[first:last] = np.gradient(self.q[first:last], self.s[first:last], axis=0)
        return found

    def joint_path(self) -> Path:
        """Return the spline through all joint samples: the fifth planning step of the notes.

        With a law s(t) it is the joint motion; its end slopes are those of the Jacobian. From corner to corner it is a
        spline of its own: a single one would round the corners off, the less the more samples there are.

        Raises
        ------
        InputError
            The path is not followed to its end; the text says why.
        """
        if not self.whole:
            raise InputError(f"joint_path: {self.reason}")
        ends = [0, *self.corners, len(self.s) - 1]
        leaving, arriving = self.slope[ends[:-1]], [*self.arriving, self.slope[-1]]
        splines = []
        for (first, last), v_start, v_end in zip(pairwise(ends), leaving, arriving, strict=True):
            part = slice(first, last + 1)
            spline = path_type("spline").path(self.q[part], times=self.s[part], v_start=v_start, v_end=v_end)
            assert isinstance(spline, PolynomialPath)
            splines.append(spline)
        if len(splines) == 1:
            return splines[0]
        cubics = np.concatenate([spline.in_time.coefficients for spline in splines])
        return PolynomialPath(Piecewise(self.s, cubics), 1.0)
