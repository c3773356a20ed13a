"""The full record of an iteration, from which its film is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

Status = Literal[
    "converged",
    "stuck",
    "singular",
    "representation",
    "diverged",
    "jumped",
    "limit",
    "most",
    "out of reach",
    "locked",
    "unfit",
]


@dataclass(frozen=True, eq=False)
class Trace:
    """An iteration from q0, k steps long; arrays are read-only.

    Attributes
    ----------
    method : str
        Key of the method: an iterative one, or a compiled one in the record of a solve.
    parameters : dict
        Its parameters by key.
    q : ndarray, shape (k + 1, n)
        Iterates, rad or m.
    components : ndarray, shape (k + 1, m)
        Error of each task component, wanted minus present, m or rad; `names` and `kinds` say what they are.
    position_error, rotation_error : ndarray, shape (k + 1,)
        Metres and radians, of what the task controls. A joint that is a task component counts in neither; its error
        is in ``components``.
    step : ndarray, shape (k, n)
        Joint changes, rad or m.
    sigma_min, sigma_max, w : ndarray, shape (k + 1,)
        Smallest and largest singular value and their product, of the Jacobian the method used: scaled, weighted, and
        without locked joints.
    damping : ndarray, shape (k,)
        The number added to the diagonal of J J^T at each step; 0 for methods without.
    cost : ndarray, shape (k + 1,)
        Half the squared scaled error; with chords for angles of cyclic coordinate descent and of compiled methods.
    objective : ndarray, shape (k + 1,), or None
        Value of a secondary objective.
    status, reason : str
        Why it ended, for programs and in words.
    jumps : tuple of int
        Steps (from 1) in which a joint turned by more than half a turn.
    names, kinds : tuple of str
        Names of the task components, and their units.
    length : float
        Metres that count as 1 in sigma, w, damping and cost.
    scaling : str
        The same in words.
    """

    method: str
    parameters: dict[str, float]
    q: Floats
    components: Floats
    position_error: Floats
    rotation_error: Floats
    step: Floats
    sigma_min: Floats
    sigma_max: Floats
    w: Floats
    damping: Floats
    cost: Floats
    objective: Floats | None
    status: Status
    reason: str
    jumps: tuple[int, ...]
    names: tuple[str, ...]
    kinds: tuple[str, ...]
    length: float
    scaling: str

    @property
    def success(self) -> bool:
        """Whether the target is reached."""
        return self.status == "converged"

    @property
    def iterations(self) -> int:
        """Number of steps."""
        return len(self.step)
