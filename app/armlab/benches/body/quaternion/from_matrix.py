"""The quaternion of the body's matrix by three methods, and what each misses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.kin.quaternion_signs import matrix_of_quaternion, quaternion_by_signs
from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.state import State

METHODS = {
    "signs": "roots and signs",
    "slip": "the same with r₁₃ − r₃₂",
    "largest": "by the largest",
}
"""Methods by key: the second has a wrong index in the sign of the y component."""


@dataclass(frozen=True, eq=False)
class Found:
    """A quaternion that a method finds.

    Attributes
    ----------
    q : ndarray, shape (4,)
    off : float
        Largest difference of an entry of its matrix from R.
    """

    q: NDArray[np.float64]
    off: float


def found_of(state: State) -> dict[str, Found]:
    """Return what each method finds."""
    R = state.derived(forms_of).R
    quaternions = {
        "signs": quaternion_by_signs(R),
        "slip": quaternion_by_signs(R, slip=True),
        "largest": np.asarray(quaternion_from_rotation(R), dtype=np.float64),
    }
    return {key: Found(q, float(np.abs(matrix_of_quaternion(q) - R).max())) for key, q in quaternions.items()}
