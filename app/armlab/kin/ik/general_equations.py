"""Six equations in the three middle joints of a closed 6R loop.

The loop is ``Rz(t_1) T_1 Rz(t_2) T_2 ... Rz(t_6) T_6 = 1`` with any six rigid motions T_i; every cyclic shift of
the factors is an equally good loop. Isolate joints 1 and 2:

    T_2 Rz(t_3) T_3 Rz(t_4) T_4 Rz(t_5) T_5 = Rz(-t_2) T_1^-1 Rz(-t_1) T_6^-1 Rz(-t_6).

On both sides compare the quantities that the turn t_6 leaves alone: the direction l of the z axis and the origin p. The
14 numbers

    p,  l,  p.p,  p.l,  p x l,  e = (p.p) l - 2 (p.l) p

change linearly under every rigid motion: a rotation turns the vectors, and a translation by t adds 2 t.p + t.t to p.p,
t.l to p.l, t x l to p x l, and 2 t x (l x p) + (t.t) l - 2 (p.l) t - 2 (t.l) t to e. With the number 1 they carry a
linear representation of the rigid motions in which Rz(t) has degree one in (cos t, sin t). So the left side is
trilinear in the (1, c, s) of joints 3, 4, 5 and the right side bilinear in those of 1 and 2, for any constants.

References
----------
Raghavan and Roth, "Kinematic analysis of the 6R manipulator of general geometry", 1990, whose 14 equations these are.
The elimination block by block and the sampling are this lab's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_loop import Complex, Floats, Numbers, angle_of, inverses, turns

THIRDS: Floats = 2.0 * np.pi / 3.0 * np.arange(3, dtype=np.float64)
"""Angles at which functions linear in (cos, sin) are sampled; equal steps make the coefficients well conditioned."""

SAMPLES = turns(THIRDS)
SAMPLES_BACK = turns(-THIRDS)

TO_COEFFICIENTS = np.array([np.full(3, 0.5), np.cos(THIRDS), np.sin(THIRDS)]) * (2.0 / 3.0)
"""Matrix from three samples to the coefficients of 1, cos and sin."""

TO_TRILINEAR = np.kron(np.kron(TO_COEFFICIENTS, TO_COEFFICIENTS), TO_COEFFICIENTS)

FIXED = 6
"""Number of the 14 functions, which come first, that a rotation about z leaves alone; the others are 4 pairs (x, y)."""


@dataclass(frozen=True, eq=False)
class Equations:
    """Six trilinear equations for each of B loops, and the data from which joints 1 and 2 follow.

    Attributes
    ----------
    middle : ndarray, shape (B, 6, 3, 3, 3)
        Coefficients over (1, c, s) of joints 3, 4, 5.
    right : ndarray, shape (B, 3, 14)
        The 14 numbers of ``T_1^-1 Rz(-t_1) T_6^-1`` over (1, c, s) of joint 1.
    basis, triangle : ndarray, shapes (B, 6, 2) and (B, 2, 2)
        QR factors of the fixed numbers of cos and sin of joint 1.
    pairs : ndarray, shape (B, 6, 6)
        The triangle of the QR factors of the pairs.
    """

    middle: Floats
    right: Floats
    basis: Floats
    triangle: Floats
    pairs: Floats

    @property
    def evenness(self) -> Floats:
        """Regularity of the eliminated blocks, (B,): 1 at best, 0 where joints 1 and 2 cannot be eliminated."""
        return _evenness(self.triangle) * _evenness(self.pairs)


def equations(T: Floats) -> Equations:
    """Return the equations of loops with motions T_1 to T_6, shape (B, 6, 4, 4)."""
    left, right = _left(T), _right(T)
    # The six fixed numbers: left = right[0] + right[1] cos t_1 + right[2] sin t_1.
    Q, R = np.linalg.qr(np.swapaxes(right[:, 1:, :FIXED], 1, 2), mode="complete")
    left[:, 0, :FIXED] -= right[:, 0, :FIXED]
    first = np.swapaxes(left[..., :FIXED] @ Q[..., 2:], 1, 2)
    # The four pairs: x = cos t_2 X + sin t_2 Y, y = cos t_2 Y - sin t_2 X, with X, Y linear in (1, c, s) of t_1.
    xs, ys = np.swapaxes(right[..., FIXED::2], 1, 2), np.swapaxes(right[..., FIXED + 1 :: 2], 1, 2)
    block = np.empty((len(T), 8, 6))
    block[:, 0::2, :3] = block[:, 1::2, 3:] = xs
    block[:, 1::2, :3] = block[:, 0::2, 3:] = ys
    block[:, 1::2, 3:] *= -1.0
    Q2, R2 = np.linalg.qr(block, mode="complete")
    second = np.swapaxes(left[..., FIXED:] @ Q2[..., 6:], 1, 2)
    middle = np.concatenate([first, second], axis=1).reshape(-1, 6, 3, 3, 3)
    return Equations(middle, right, Q[..., :2], R[:, :2], R2[:, :6])


def _evenness(R: Floats) -> Floats:
    """Return the ratio of smallest to largest diagonal entry of triangles, a cheap measure of how singular they are."""
    sizes = np.abs(np.diagonal(R, axis1=1, axis2=2))
    return np.asarray(sizes.min(axis=1) / np.maximum(sizes.max(axis=1), 1e-300))


def _left(T: Floats) -> Floats:
    """Return the 14 numbers of the left side over the 27 products of (1, c, s), shape (B, 27, 14)."""
    lines = SAMPLES @ T[:, None, 4, :, 2:]
    lines = (SAMPLES @ T[:, None, 3])[:, :, None] @ lines[:, None]
    before = T[:, None, 1] @ SAMPLES @ T[:, None, 2]
    lines = before[:, :, None, None] @ lines[:, None]
    return np.asarray(TO_TRILINEAR @ line_numbers(lines).reshape(-1, 27, 14))


def _right(T: Floats) -> Floats:
    ends = inverses(T[:, [0, 5]])
    lines = ends[:, None, 0] @ SAMPLES_BACK @ ends[:, None, 1, :, 2:]
    return np.asarray(TO_COEFFICIENTS @ line_numbers(lines))


def line_numbers(lines: Numbers) -> Numbers:
    """Return the 14 numbers, those a turn about z does not change first, then the pairs.

    Parameters
    ----------
    lines : ndarray, shape (..., 4, 2)
        Homogeneous columns: a direction l and a point p.

    Returns
    -------
    ndarray, shape (..., 14)
        p_z, l_z, (p x l)_z, e_z, p.p, p.l, then (x, y) of p, l, p x l, e.
    """
    lx, ly, lz = (lines[..., k, 0] for k in range(3))
    px, py, pz = (lines[..., k, 1] for k in range(3))
    pp = px * px + py * py + pz * pz
    pl = px * lx + py * ly + pz * lz
    twice = 2.0 * pl
    out = np.empty((*pp.shape, 14), dtype=lines.dtype)
    out[..., 0], out[..., 1], out[..., 2], out[..., 3] = pz, lz, px * ly - py * lx, pp * lz - twice * pz
    out[..., 4], out[..., 5] = pp, pl
    out[..., 6], out[..., 7], out[..., 8], out[..., 9] = px, py, lx, ly
    out[..., 10], out[..., 11] = py * lz - pz * ly, pz * lx - px * lz
    out[..., 12], out[..., 13] = pp * lx - twice * px, pp * ly - twice * py
    return out


def all_angles(T: Floats, found: Equations, owner: NDArray[np.intp], middle: Complex) -> Complex:
    """Return all six angles from those of joints 3, 4, 5.

    Joint 1 from the fixed numbers by least squares, joint 2 from the pairs as the turn that fits them best, joint 6
    from the rotation that is left.

    Parameters
    ----------
    T : ndarray, shape (B, 6, 4, 4)
    found : Equations
        Equations of these loops.
    owner : ndarray of int, shape (m,)
        Index of the loop to which each row belongs.
    middle : ndarray of complex, shape (m, 3)

    Returns
    -------
    ndarray of complex, shape (m, 6)
    """
    own = T[owner]
    R = turns(middle)
    chain = own[:, 1] @ R[:, 0] @ own[:, 2] @ R[:, 1] @ own[:, 3] @ R[:, 2] @ own[:, 4]
    numbers, right = line_numbers(chain[..., 2:]), found.right[owner]
    rest = numbers[:, :FIXED] - right[:, 0, :FIXED]
    u, v = ((rest[:, None] @ found.basis[owner])[:, 0]).T
    (r11, r12), (_, r22) = np.moveaxis(found.triangle[owner], 0, -1)
    # Back-substitution times |r11 r22|: the angle does not depend on that factor.
    sign = np.sign(r11 * r22)
    c1, s1 = (r22 * u - r12 * v) * sign, r11 * v * sign
    t1 = angle_of(c1 + 1j * s1, c1 - 1j * s1)
    turn = np.stack([np.ones_like(t1), np.cos(t1), np.sin(t1)], axis=1)[:, None]
    X, Y = np.moveaxis((turn @ right[..., FIXED:])[:, 0].reshape(-1, 4, 2), -1, 0)
    x, y = np.moveaxis(numbers[:, FIXED:].reshape(-1, 4, 2), -1, 0)
    # x + iy = exp(-i t_2) (X + iY), and with -i for i, which for complex X and Y is another equation.
    t2 = angle_of(_ratio(x - 1j * y, X - 1j * Y), _ratio(x + 1j * y, X + 1j * Y))
    # T_6 times everything before Rz(t_6) is the turn back, Rz(-t_6).
    back = own[:, 5] @ turns(t1) @ own[:, 0] @ turns(t2) @ chain
    c6, s6 = back[:, 0, 0] + back[:, 1, 1], back[:, 0, 1] - back[:, 1, 0]
    return np.column_stack([t1, t2, middle, angle_of(c6 + 1j * s6, c6 - 1j * s6)])


def _ratio(values: Complex, by: Complex) -> Complex:
    """Return the factors (m,) from rows (m, 4) to other rows, by least squares."""
    sizes = (by * by.conj()).real.sum(axis=1)
    return np.asarray((values * by.conj()).sum(axis=1) / np.maximum(sizes, 1e-300))
