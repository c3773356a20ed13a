"""Roots followed from one pose to another, to find those at a special pose from those at a pose nearby.

The poses between lie on a bent way through complex ones, on which no two roots merge but by bad luck: a rotation
Cay(a) M with a = a(u) complex, a place p(u), u = 1 at the start and 0 at the end. Each root has its own u and step. At
the end regular roots are simply reached; the others (merging ones, members of families, those at infinity) are
followed down to `SMALLEST` in steps that shrink with u, in which all of them move steadily in log u.

References
----------
Sommese and Wampler, *The Numerical Solution of Systems of Polynomials*, 2005, chapters 2, 7 and 10.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_complex import OUTERMOST, blurred, inverted
from armlab.kin.ik.general_loop import Complex, Floats, Numbers
from armlab.kin.ik.general_polish import columns_at, crossed, errors_and_columns

FIRST, LONGEST = 0.1, 0.25
"""First and longest step of u."""

ENDGAME = 0.02
"""Value of u below which a root that is not reached in one step is followed in steps of log u."""

SMALLEST = 1e-9
"""Smallest u. Merging roots are then some 1e-5 rad apart; closer, rounding hides them."""

ROUNDING = 1e-12
"""Rounding error of u."""

FACTOR = 0.2
"""Factor of u in a step of the endgame."""

NEAR, CONVERGED = 1e-2, 1e-8
"""Largest first and last Newton step after a prediction, radians."""

EASY = 5e-4
"""First Newton step, in radians, below which the next step may be twice as long."""

MOST_STEPS = 60


class Ends(NamedTuple):
    """The ends of the roots that were followed.

    Attributes
    ----------
    q : ndarray of complex, shape (m, 6)
    u : ndarray, shape (m,)
        Distance from the end of the way; 0 where Newton's method converged at the end itself.
    speed : ndarray, shape (m,)
        Largest change of an angle by log u there: what goes to infinity keeps some, what has an end loses it.
    """

    q: Complex
    u: Floats
    speed: Floats


@dataclass(frozen=True, eq=False)
class Way:
    """Poses from a real one nearby to a pose.

    Attributes
    ----------
    hand : ndarray, shape (4, 4)
        The pose at the end.
    half, aside : ndarray, shape (3,)
        Half the turn between them as the vector of a Cayley transform, and from the place at the end to the other.
    bend : ndarray of complex, shape (2, 3)
        Deviation of vector and place from the straight way.
    """

    hand: Floats
    half: Floats
    aside: Floats
    bend: Complex

    @classmethod
    def beside(cls, hand: Floats, rng: np.random.Generator, size: float) -> Way:
        """Return a way to the given pose from a random one about ``size`` (radians and units of length) beside it."""
        real, imaginary = size * rng.normal(size=(2, 4, 3))
        return cls(hand, 0.5 * real[0], real[1], 0.5 * (real[2:] + 1j * imaginary[2:]))

    @property
    def start(self) -> Floats:
        """The pose at u = 1, shape (4, 4)."""
        return np.asarray(self.at(np.ones(1))[0][0].real)

    @cached_property
    def _turned(self) -> Floats:
        """The rotation half-way between both ends, shape (3, 3)."""
        return np.asarray(cayley(self.half[None])[0] @ self.hand[:3, :3])

    def at(self, u: Floats) -> tuple[Complex, Complex]:
        """Return poses (m, 4, 4) and their derivatives with respect to u as twists (v; omega), shape (m, 6)."""
        u = u[:, None]
        a = (2.0 * u - 1.0) * self.half + u * (1.0 - u) * self.bend[0]
        da = 2.0 * self.half + (1.0 - 2.0 * u) * self.bend[0]
        poses = np.zeros((len(u), 4, 4), dtype=np.complex128)
        poses[:, :3, :3] = cayley(a) @ self._turned
        poses[:, :3, 3] = self.hand[:3, 3] + u * self.aside + u * (1.0 - u) * self.bend[1]
        poses[:, 3, 3] = 1.0
        turning = 2.0 * (da + crossed(a, da)) / (1.0 + (a * a).sum(axis=1))[:, None]
        moving = self.aside + (1.0 - 2.0 * u) * self.bend[1]
        return poses, np.concatenate([moving, turning], axis=1)


def cayley(a: Numbers) -> Numbers:
    """Return the rotation by 2 atan |a| about a (m, 3), ((1 - a.a) 1 + 2 a a^T + 2 [a]) / (1 + a.a), (m, 3, 3)."""
    square = (a * a).sum(axis=1)
    R = 2.0 * a[:, :, None] * a[:, None, :]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        R[:, i, j] -= 2.0 * a[:, k]
        R[:, j, i] += 2.0 * a[:, k]
        R[:, i, i] += 1.0 - square
    return np.asarray(R / (1.0 + square)[:, None, None])


def follow(links: Floats, way: Way, q: Complex) -> Ends:
    """Return the ends of the roots q (m, 6), followed from the start of a way."""
    q, u, speed = q.astype(np.complex128), np.ones(len(q)), np.full(len(q), np.nan)
    steps, factors, late = np.full(len(q), FIRST), np.full(len(q), FACTOR), np.zeros(len(q), dtype=bool)
    going, slopes = np.ones(len(q), dtype=bool), _slopes(links, q, way.at(u)[1])
    for _ in range(MOST_STEPS):
        rows = np.flatnonzero(going)
        if not len(rows):
            break
        log, before = late[rows], u[rows]
        after = np.where(log, before * factors[rows], before - steps[rows])
        after[after < ROUNDING] = 0.0
        there, slope, first, last = _step(links, way, q[rows], slopes[rows], before, after, log)
        speed[rows[log]] = np.abs(slopes[rows[log]]).max(axis=1) * before[log]
        good = (first < NEAR) & (last < CONVERGED * blurred(there))
        done = rows[good]
        q[done], u[done], slopes[done] = there[good], after[good], slope[good]
        easy = first[good] < EASY
        steps[done[easy]] = np.minimum(2.0 * steps[done[easy]], LONGEST)
        factors[done[easy]] = np.maximum(factors[done[easy]] ** 2, FACTOR)
        bad = rows[~good]
        steps[bad] = 0.5 * np.minimum(steps[bad], u[bad])
        factors[bad] = np.where(late[bad], np.sqrt(factors[bad]), FACTOR)
        late[bad[u[bad] <= ENDGAME]] = True
        going[rows] = (u[rows] > SMALLEST) & (np.abs(q[rows].imag).max(axis=1) < OUTERMOST)
        going[bad] &= np.where(late[bad], factors[bad] < 0.97, steps[bad] > 1e-5)
    return Ends(q, u, speed)


def _step(
    links: Floats, way: Way, q: Complex, slopes: Complex, u: Floats, to: Floats, log: NDArray[np.bool_]
) -> tuple[Complex, Complex, Floats, Floats]:
    """Make one step by Runge and Kutta, in u or in log u, and Newton's method; with its first and last step's size.

    ``slopes`` (m, 6) are the derivatives by u at the start; those at the end, but for the last step, are returned.
    """
    with np.errstate(all="ignore"):
        middle = np.where(log, np.sqrt(u * to), 0.5 * (u + to))
        length = np.where(log, np.log(np.where(log, to / u, 1.0)), to - u)[:, None]
        poses, twists = way.at(np.concatenate([middle, to]))
        poses, (at_middle, at_end) = poses[len(q) :], twists.reshape(2, len(q), 6)
        by_middle, by_end = (np.where(log, there, 1.0)[:, None] for there in (middle, to))
        k1 = slopes * np.where(log, u, 1.0)[:, None]
        k2 = _slopes(links, q + 0.5 * length * k1, at_middle) * by_middle
        k3 = _slopes(links, q + 0.5 * length * k2, at_middle) * by_middle
        k4 = _slopes(links, q + length * k3, at_end) * by_end
        q = q + length / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
        first = last = np.zeros(len(q))
        for k in range(3):
            errors, columns, _ = errors_and_columns(links, q, poses)
            inverses = inverted(columns)
            step = (errors[:, None] @ inverses)[:, 0]
            q, last = q + step, np.abs(step).max(axis=1)
            first = last if k == 0 else first
            if (last < CONVERGED).all():
                break
        return q, (at_end[:, None] @ inverses)[:, 0], first, last


def _slopes(links: Floats, q: Complex, twists: Complex) -> Complex:
    """Return the derivatives of roots (m, 6) where the tool moves by twists (m, 6)."""
    with np.errstate(all="ignore"):
        return np.asarray((twists[:, None] @ inverted(columns_at(links, q)))[:, 0])
