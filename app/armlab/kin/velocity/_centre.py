"""Reasons of singularities of arms with a spherical wrist and no planar part: Stanford's, and 7R arms."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.kin.velocity._layout import Layout, Posture

Array = NDArray[np.float64]
Reason = tuple[Literal["shoulder", "elbow", "wrist"], str, tuple[int, ...], Array | None, bool]
"""Kind, sentences, joints (1-based), lost direction in the world, whether this is a rotation."""

VANISHES = 1e-5
"""Sine, or singular value relative to the largest, that counts as zero; the rank is decided before."""


def reasons(posture: Posture, layout: Layout) -> tuple[Reason, ...]:
    """Return why the arm is singular: its first joints do not move the wrist centre every way, or the wrist is flat.

    The last three columns of the Jacobian at the wrist centre only turn the hand. The Jacobian loses rank where the
    first ones lose a motion of the centre, or where the axes of the wrist lie in a plane and no joint speeds that leave
    the centre in place turn the lower arm across that plane.

    References
    ----------
    Siciliano et al., *Robotics*, 3.3.2; of seven joints Kreutz-Delgado et al. 1992, "Kinematic analysis of 7-DOF
    manipulators".
    """
    J = posture.centre_jacobian
    U, sigma, V_T = np.linalg.svd(J)
    found: list[Reason] = []
    rank = int(np.sum(sigma > VANISHES * sigma[0]))
    if rank == 2:
        lost = np.asarray(U[:, 2])
        found.append(_elbow(posture, lost) or _shoulder(posture, layout, J, lost))
    elif rank < 2:
        along, beside = _lost_pair(posture, U, rank)
        elbow = _elbow(posture, along)
        found += [elbow, _still(posture, J, beside)] if elbow else [_shoulder(posture, layout, J, None)]
    wrist = _wrist(posture, layout, V_T[rank:])
    return (*found, wrist) if wrist is not None else tuple(found)


def _elbow(posture: Posture, lost: Array | None) -> Reason | None:
    """Return the reason that shoulder, axis 4 and wrist centre are in line, or None."""
    shoulder, centre = posture.shoulder_centre, posture.centre
    if shoulder is None or centre is None:
        return None
    z, elbow = posture.axes[3], posture.points[3]
    upper, lower = (way - (way @ z) * z for way in (elbow - shoulder, centre - elbow))
    size = float(np.linalg.norm(upper) * np.linalg.norm(lower))
    if abs(float(z @ np.cross(upper, lower))) > VANISHES * size:
        return None
    how = "stretched" if float(upper @ lower) > 0.0 else "folded"
    says = (
        f"Elbow: the arm is {how}: the shoulder centre (where axes 1, 2 and 3 meet), axis 4 and the wrist centre are "
    )
    says += "in line. No joint moves the wrist centre along that line."
    return "elbow", says, (4,), lost, False


def _lost_pair(posture: Posture, U: Array, rank: int) -> tuple[Array | None, Array | None]:
    """Return the two lost directions of the wrist centre, along the lower arm and across it; None each otherwise."""
    centre = posture.centre
    if rank != 1 or centre is None:
        return None, None
    way = centre - posture.points[3]
    part = U[:, 1:].T @ (way / np.linalg.norm(way))
    if float(np.linalg.norm(part)) < 1.0 - VANISHES:
        return None, None
    return np.asarray(U[:, 1:] @ part), np.asarray(U[:, 1:] @ (-part[1], part[0]))


def _still(posture: Posture, J: Array, lost: Array | None) -> Reason:
    """Return the reason that the shoulder adds no second direction to the one in which joint 4 moves the centre."""
    floor = VANISHES * posture.arm.length_scale
    still = [k + 1 for k in range(3) if float(np.linalg.norm(J[:, k])) <= floor]
    if len(still) == 3:
        says = "Shoulder: the wrist centre is at the shoulder centre (where axes 1, 2 and 3 meet), so joints 1, 2 and "
        says += "3 do not move it. Beside the line of the elbow a second direction is lost to it."
        return "shoulder", says, (1, 2, 3), lost, False
    if len(still) == 2:
        (moving,) = {1, 2, 3} - set(still)
        says = f"Shoulder: axes {still[0]} and {still[1]} pass through the wrist centre, so these joints do not move "
        says += (
            f"it. Joints {moving} and 4 move it the same way: beside the line of the elbow a second direction is lost."
        )
        return "shoulder", says, (1, 2, 3), lost, False
    says = "Shoulder: axes 1, 2 and 3 lie in one plane with the wrist centre, and joints 1, 2, 3 and 4 all move it the "
    says += "same way: beside the line of the elbow a second direction is lost."
    return "shoulder", says, (1, 2, 3), lost, False


def _shoulder(posture: Posture, layout: Layout, J: Array, lost: Array | None) -> Reason:
    if layout.shoulder is not None:
        line = posture.same_line(0, 2)
        what = "axes 1 and 3 are in one line" if line else "axes 1, 2 and 3 lie in one plane"
        says = f"Shoulder: {what}, and the wrist centre lies in the plane of axes 1 and 2. Joints 1, 2 and 3 move it "
        says += "only at right angles to that plane, and joint 4 adds one direction: the third is lost."
        return "shoulder", says, (1, 2, 3), lost, False
    sizes = np.linalg.norm(J, axis=0)
    if sizes[0] <= VANISHES * sizes.max():
        says = "Shoulder: the wrist centre lies on axis 1, so joint 1 does not move it."
        return "shoulder", says, (1,), lost, False
    for i, k in ((0, 1), (0, 2), (1, 2)):
        across = float(np.linalg.norm(np.cross(J[:, i], J[:, k])))
        if across <= VANISHES * sizes[i] * sizes[k]:
            says = f"Shoulder: joints {i + 1} and {k + 1} move the wrist centre along the same line, so one direction "
            says += "is lost to it."
            return "shoulder", says, (i + 1, k + 1), lost, False
    says = "Shoulder: joints 1, 2 and 3 move the wrist centre in one plane only; it cannot move across it."
    return "shoulder", says, (1, 2, 3), lost, False


def _wrist(posture: Posture, layout: Layout, still: Array) -> Reason | None:
    """Return that the wrist is flat and nothing else turns the hand across its plane.

    Parameters
    ----------
    still : ndarray, shape (k, j)
        Joint speeds of the first joints that leave the wrist centre in place.
    """
    assert layout.wrist is not None
    first, middle, last = layout.wrist
    z1, z2, z3 = posture.axes[[first, middle, last]]
    normal = np.cross(z1, z2)
    if abs(float(normal @ z3)) > VANISHES:
        return None
    if np.abs((still * posture.arm.revolute[:first]) @ posture.axes[:first] @ normal).max(initial=0.0) > VANISHES:
        return None
    names = (first + 1, middle + 1, last + 1)
    joints: tuple[int, ...] = (names[0], names[2])
    says = f"Wrist: axes {names[0]} and {names[2]} are in one line, so both joints turn the hand the same way. "
    if float(np.linalg.norm(np.cross(z1, z3))) > VANISHES:
        joints = names
        says = f"Wrist: axes {names[0]}, {names[1]} and {names[2]} lie in one plane. "
    says += f"With the wrist centre held, the hand cannot turn about the direction across axes {names[0]} and "
    says += f"{names[1]}."
    if first > 3:
        says += " The self-motion of the arm does not turn it that way either."
    return "wrist", says, joints, np.asarray(normal / np.linalg.norm(normal)), True
