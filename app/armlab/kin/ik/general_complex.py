"""Roots of the loop, real and complex: Newton's method on the true arm, and the accuracy of each.

The equations of the loop are analytic in its angles, so Newton's method works for complex angles as it stands. An arm
has the same number of roots at every pose but special ones, at most 16; what is missing at a special pose has merged
with others, is at infinity, or belongs to a family. So counting the regular roots, complex ones included, tells
whether a list of the real ones is complete: as many as the arm has leave no room for another, nor for a family.

References
----------
Morgan and Sommese, "Coefficient-parameter polynomial continuation", 1989: the number of isolated roots is the same for
all parameters outside an algebraic set, and nowhere greater.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_loop import Complex, Floats, Numbers
from armlab.kin.ik.general_polish import errors_and_columns

STEPS = 9

STILL = 1e-10
"""Step of Newton's method, in radians, below which polishing ends: the remaining error is its square, or rounding."""

FAR, PATIENCE = 0.3, 2
"""Error from which, after this many steps, a candidate belongs to no root; and the number of steps."""

ACCURATE = 1e-8
"""Largest error of a root, in radians and units of length."""

OUTERMOST = 12.0
"""Largest imaginary part of an angle: beyond it sines exceed 1e5 and all digits cancel in their products."""

MOST_BLURRED = 11.0
"""Largest logarithm of the factor by which rounding is taken to grow."""

LONGEST = 0.7
"""Largest change of an angle in one step, radians."""

REGULAR = 3e5
"""Norm of the inverse Jacobian below which a root is regular: Newton's method then finds it to better than 1e-9."""

SAME = 1e-7
"""Distance in all joints, radians, below which two regular roots are one."""

BESIDE = 1.0
"""Imaginary part up to which a root counts as nearly real, in a wide sense."""

REAL = 1e-8
"""Largest imaginary part of a regular real root. A root with a larger one has its conjugate at twice this distance,
which a regular root never has."""


class Roots(NamedTuple):
    """Roots of one loop.

    Attributes
    ----------
    q : ndarray of complex, shape (m, 6)
        Angles with their offsets.
    regular : ndarray of bool, shape (m,)
        Whether Newton's method converged and the Jacobian is far from singular.
    """

    q: Complex
    regular: NDArray[np.bool_]

    def counted(self, border: float) -> int:
        """Return the number of regular roots whose imaginary parts are within a bound."""
        return int((self.regular & (np.abs(self.q.imag).max(axis=1, initial=0.0) <= border)).sum())

    @property
    def merging(self) -> bool:
        """Whether a root that is nearly real is not regular."""
        return bool((~self.regular & (np.abs(self.q.imag).max(axis=1, initial=0.0) < BESIDE)).any())

    @property
    def real(self) -> NDArray[np.bool_]:
        """Mask of the roots that are regular and real, shape (m,)."""
        return np.asarray(self.regular & (np.abs(self.q.imag).max(axis=1, initial=0.0) < REAL))


NO_ROOTS = Roots(np.empty((0, 6), dtype=np.complex128), np.empty(0, dtype=bool))


def newton(links: Floats, q: Complex, hands: Numbers, steps: int = STEPS) -> tuple[Complex, Floats, Floats]:
    """Return the results of Newton's method, the errors there, and the norms of the inverse Jacobians.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
        See `Loop`.
    q : ndarray of complex, shape (m, 6)
    hands : ndarray, shape (m, 4, 4)

    Returns
    -------
    q : ndarray of complex, shape (m, 6)
    sizes, inverses : ndarray, shape (m,)
        Infinite for what goes to infinity.
    """
    q, sizes, norms = q.copy(), np.full(len(q), np.inf), np.full(len(q), np.inf)
    with np.errstate(all="ignore"):
        rows = np.flatnonzero(np.abs(q.imag).max(axis=1, initial=0.0) < OUTERMOST)
        for k in range(steps):
            if not len(rows):
                break
            errors, columns, found = errors_and_columns(links, q[rows], hands[rows])
            inverses = inverted(columns)
            step = (errors[:, None] @ inverses)[:, 0]
            lengths = np.abs(step).max(axis=1)
            q[rows] += step * np.minimum(1.0, LONGEST / np.maximum(lengths, 1e-300))[:, None]
            still = lengths <= STILL * blurred(q[rows])
            sizes[rows] = found
            # Only where the steps have ended: beside a multiple root they go on and on, each half of the last.
            size = np.sqrt((np.abs(inverses) ** 2).sum(axis=(1, 2)))
            norms[rows] = np.where(still, size, np.inf)
            ended = lengths <= STILL
            going = ~ended & (np.abs(q[rows].imag).max(axis=1) < OUTERMOST)
            if k >= PATIENCE:
                going &= found < FAR
            gone = ~going & ~ended
            sizes[rows[gone]] = np.inf
            rows = rows[going]
    return q, sizes, norms


def distinct(q: Complex, sizes: Floats, norms: Floats) -> Roots:
    """Return polished candidates and their conjugates without repetitions; the most regular of each is kept."""
    good = np.flatnonzero(sizes < ACCURATE * blurred(q))
    good = good[np.argsort(norms[good], kind="stable")]
    both = np.repeat(q[good], 2, axis=0)
    both[1::2] = both[1::2].conj()
    kept = ~np.tril(near(both, SAME), -1).any(axis=1)
    return Roots(both[kept], np.repeat(norms[good] < REGULAR, 2)[kept])


def joined(one: Roots, other: Roots) -> Roots:
    """Return the roots of both, without repetitions."""
    q, regular = np.concatenate([one.q, other.q]), np.concatenate([one.regular, other.regular])
    order = np.argsort(~regular, kind="stable")
    kept = order[~np.tril(near(q[order], SAME), -1).any(axis=1)]
    return Roots(q[kept], regular[kept])


def near(q: Complex, tolerance: float) -> NDArray[np.bool_]:
    """Return which of the rows (m, 6) agree up to whole turns and a tolerance in radians, shape (m, m)."""
    apart = q[:, None] - q
    turned = apart.real - 2.0 * np.pi * np.round(apart.real / (2.0 * np.pi))
    return np.asarray(np.maximum(np.abs(turned), np.abs(apart.imag)).max(axis=2, initial=0.0) < tolerance * blurred(q))


def blurred(q: Complex) -> Floats:
    """Return the factor by which rounding is larger at complex angles (m, 6): sines grow as exp |Im|."""
    return np.asarray(np.exp(np.minimum(2.0 * np.abs(q.imag).max(axis=1, initial=0.0), MOST_BLURRED)))


def inverted(columns: Complex) -> Complex:
    """Return the inverses of Jacobians (m, 6, 6); nan when one is exactly singular."""
    try:
        return np.asarray(np.linalg.inv(columns))
    except np.linalg.LinAlgError:
        return np.array([_inverted(one) for one in columns])


def _inverted(columns: Complex) -> Complex:
    try:
        return np.asarray(np.linalg.inv(columns))
    except np.linalg.LinAlgError:
        return np.full((6, 6), np.nan + 0j)
