"""Sentences on the branch of an arm: borders that it has crossed, and singularities near it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.conditioning import NEAR
from armlab.kin.ik.branches import branch_names, features
from armlab.kin.ik.closed_form import known_structure
from armlab.kin.spare import task_jacobian

Branch = tuple[str, ...]

BORDER = ("straight", "folded", "above", "beside", "beside the axis")
"""Words for being on neither side of a border."""

STILL_NEAR = 1.5 * NEAR
"""Inverse condition below which a singularity stays near that was nearer before, so that no sentence flickers."""

SHARE = 0.3
"""Part of a unit of joint motion from which a joint contributes to a singularity."""

POSITIVE, NEGATIVE = "det J above 0", "det J below 0"
"""Branches of an arm that has no other words for them."""


def branch_of(arm: Arm, q: NDArray[np.float64]) -> Branch:
    """Return on which side of each border a configuration (n,) is, such as ``("elbow up", "wrist flip")``.

    The sign of det J for a square task of an arm without such words; nothing for the others.
    """
    if features(arm):
        return tuple(branch_names(arm, q[None])[0].split(", "))
    J = _scaled(arm, q)
    if J.shape[0] != J.shape[1]:
        return ()
    return (POSITIVE if float(np.linalg.det(J)) > 0.0 else NEGATIVE,)


def followed(before: Branch, now: Branch) -> Branch:
    """Return the branch; on a border it keeps the side on which it was before."""
    if len(before) != len(now):
        return now
    return tuple(old if new.endswith(BORDER) else new for old, new in zip(before, now, strict=True))


def crossed(before: Branch, now: Branch) -> str:
    """Return what has changed from one branch to the other, in words; empty when nothing has.

    Examples
    --------
    >>> crossed(("elbow up", "wrist flip"), ("elbow down", "wrist flip"))
    'the elbow has changed from up to down'
    """
    if len(before) != len(now):
        return ""
    changes = []
    for old, new in zip(before, now, strict=True):
        (part, was), (other, is_now) = old.split(" ", 1), new.split(" ", 1)
        if old == new or part != other or is_now in BORDER or was in BORDER:
            continue
        if new in (POSITIVE, NEGATIVE):
            return "through a singularity, to another branch"
        changes.append(f"the {part} has changed from {was} to {is_now}")
    return ", ".join(changes)


def near_singularity(arm: Arm, q: NDArray[np.float64], least: float = NEAR) -> str:
    """Return a sentence on the singularity that a configuration (n,) is near; empty when it is near none.

    It is near one where the inverse condition of the task Jacobian, with lengths in length scales, is below ``least``.
    """
    J = _scaled(arm, q)
    _, sizes, motions = np.linalg.svd(J, full_matrices=False)
    if len(sizes) < J.shape[0] or float(sizes[-1]) >= least * float(sizes[0]):
        return ""
    return _named(arm, np.abs(motions[-1]))


def _scaled(arm: Arm, q: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(task_jacobian(arm, q) * np.where(arm.revolute, 1.0, arm.length_scale))


def _named(arm: Arm, motion: NDArray[np.float64]) -> str:
    """Return the name of the singularity in which this joint motion hardly moves the tool."""
    named = _elbow_arm(arm, motion) or _planar(arm)
    if named:
        return named
    joints = [str(i + 1) for i, share in enumerate(motion) if share > SHARE]
    if len(joints) == 1:
        return f"near a singularity: joint {joints[0]} hardly moves the tool"
    return f"near a singularity: joints {', '.join(joints[:-1])} and {joints[-1]} together hardly move the tool"


def _elbow_arm(arm: Arm, motion: NDArray[np.float64]) -> str:
    """Return the name of the singularity for an arm with shoulder, elbow and perhaps wrist."""
    structure = known_structure(arm)
    elbow = structure.key in ("elbow", "spherical_wrist", "three_parallel") and bool(arm.revolute.all())
    words = {name.split(" ", 1)[0] for name in branch_of(arm, np.zeros(arm.n))} if elbow and arm.n in (3, 6) else set()
    if not {"shoulder", "elbow"} <= words:
        return ""
    spherical = structure.key == "spherical_wrist"
    if motion[0] > SHARE:
        if structure.key == "three_parallel":
            return "near a shoulder singularity: the wrist is nearly as close to axis 1 as it can be"
        return f"near a shoulder singularity: {'the wrist centre' if spherical else 'the tool'} is nearly on axis 1"
    if arm.n == 6 and motion[5] > SHARE:
        lines = "axes 4 and 6 are nearly in line" if spherical else "axis 6 is nearly parallel to axes 2, 3 and 4"
        return f"near a wrist singularity: {lines}"
    return "near an elbow singularity: upper arm and forearm are nearly in line"


def _planar(arm: Arm) -> str:
    flat = known_structure(arm).key in ("planar", "scara")
    elbow = flat and any(name.startswith("elbow") for name in branch_of(arm, np.zeros(arm.n)))
    return "near an elbow singularity: both links are nearly in line" if elbow else ""
