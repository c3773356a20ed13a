"""Inverse kinematics of many poses, one solution each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong
from armlab.kin.ik.solve import SEARCHES, IkResult, checked_how, solved
from armlab.kin.transforms import as_pose

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class IkBatch:
    """The outcomes for poses (..., 4, 4); see `IkResult`.

    Attributes
    ----------
    success : ndarray of bool, shape (...)
    q : ndarray, shape (..., n)
        Solutions, or the closest configurations found; rad and m.
    position_error, rotation_error : ndarray, shape (...)
        Metres and radians.
    results : tuple of IkResult
        The same one by one, the last index running fastest.
    """

    success: NDArray[np.bool_]
    q: Floats
    position_error: Floats
    rotation_error: Floats
    results: tuple[IkResult, ...]

    def __len__(self) -> int:
        return len(self.results)


def solve_batch(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike | None = None,
    method: str = "dls",
    weights: ArrayLike | None = None,
    seed: int = 0,
    locked: Sequence[bool] | None = None,
    searches: int = SEARCHES,
    *,
    follow: bool = False,
    complete: bool = True,
) -> IkBatch:
    """Solve for each of many poses as `solve` does for one.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (..., 4, 4)
        Wanted poses of the tool in the world.
    q0 : array_like, shape (n,) or (..., n), optional
        First starts.
    method, weights, seed, locked, searches, complete
        As for `solve`; the same for all poses, whose answers therefore do not depend on each other.
    follow : bool
        Take the poses for a path: each start is the last solution before it, so that the arm stays on its branch as
        long as it can. ``q0`` (n,) is then the start of the first.

    Raises
    ------
    InputError
        A pose is none (its index is named), or as for `solve`.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> found = solve_batch(arm, arm.fk([[0.1, 0.5], [0.2, 0.6], [0.3, 0.7]]), q0=[0.0, 0.4], follow=True)
    >>> bool(found.success.all()), found.q.round(6).tolist()
    (True, [[0.1, 0.5], [0.2, 0.6], [0.3, 0.7]])
    """
    poses = as_floats(T, "T", "poses of shape (..., 4, 4)")
    if poses.ndim < 2 or poses.shape[-2:] != (4, 4):
        raise InputError(f"T: expected shape (..., 4, 4), got {poses.shape}")
    batch = poses.shape[:-2]
    checked = [as_pose(poses[index], f"T{list(index)}") for index in np.ndindex(batch)]
    starts = _starts(arm, q0, batch, follow)
    how = checked_how(arm, method, weights, locked, seed, searches, bool(complete), False)
    results: list[IkResult] = []
    last = starts[0] if starts else None
    for k, pose in enumerate(checked):
        result = solved(arm, pose, last if follow else starts[k], how)
        last = result.q if result.success else last
        results.append(result)
    return IkBatch(
        success=np.array([one.success for one in results], dtype=np.bool_).reshape(batch),
        q=np.array([one.q for one in results], dtype=float).reshape(*batch, arm.n),
        position_error=np.array([one.position_error for one in results], dtype=float).reshape(batch),
        rotation_error=np.array([one.rotation_error for one in results], dtype=float).reshape(batch),
        results=tuple(results),
    )


def _starts(arm: Arm, q0: ArrayLike | None, batch: tuple[int, ...], follow: bool) -> Sequence[Floats | None]:
    """Return the first start of each pose, the last index running fastest; on a path only that of the first counts."""
    count = int(np.prod(batch))
    if q0 is None:
        return [None] * count
    expected = f"{arm.n} finite numbers" if follow else f"finite numbers of shape ({arm.n},) or {(*batch, arm.n)}"
    values = as_floats(q0, "q0", expected)
    fits = values.shape == (arm.n,) or (values.shape == (*batch, arm.n) and not follow)
    if not fits or not np.isfinite(values).all():
        raise wrong("q0", expected, q0)
    return list(np.broadcast_to(values, (*batch, arm.n)).reshape(count, arm.n))
