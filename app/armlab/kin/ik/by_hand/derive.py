"""The derivation of an arm at a target, with every choice that its steps leave."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.ik.by_hand import arms as _folder
from armlab.kin.ik.by_hand.step import Derivation, Vector, Worked
from armlab.kin.ik.by_hand.work import NoValueError, Work
from armlab.kin.ik.closed_form import closed_form_of, known_structure
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.transforms import as_pose, inverse
from armlab.plugins import discover


@cache
def methods() -> dict[str, Worked]:
    """Return all kinds of derivations by key, in the order in which they are tried."""
    return discover(_folder, "WORKED", Worked)


@lru_cache(maxsize=64)
def method_of(arm: Arm) -> Worked | None:
    """Return how an arm is solved by hand, or None (arms are compared by identity)."""
    return next((worked for worked in methods().values() if worked.fits(arm)), None)


def why_not(arm: Arm) -> str:
    """Return in a sentence why an arm is not solved by hand; empty where it is."""
    if method_of(arm) is not None:
        return ""
    structure, form = known_structure(arm), closed_form_of(arm)
    if structure.key == "srs" and structure.free == 1:
        return "Once the angle of the elbow is chosen, formulas give the rest; this page does not derive them."
    if structure.free:
        number = "one joint is" if structure.free == 1 else f"{structure.free} joints are"
        return (
            f"{number.capitalize()} to spare, so there are infinitely many solutions and no formula gives one of them "
            "unless some joint values are chosen first."
        )
    if form is not None:
        return (
            "It has a closed form, which the page Solutions uses, but its axes do not form the triangles that are "
            "used here."
        )
    if structure.key == "general_6r":
        return (
            "No three neighbouring axes meet in one point or are parallel, so position and orientation do not "
            "separate. What is left is one equation of degree "
            f"{structure.most_solutions or 16}, which no formula solves."
        )
    return "No closed form is known to this lab for its axes and its task."


def derived(arm: Arm, T: ArrayLike, near: ArrayLike, choices: Mapping[str, int] | None = None) -> Derivation:
    """Work an arm by hand at a target.

    Parameters
    ----------
    arm : Arm
        One for which `method_of` returns a method.
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world.
    near : array_like, shape (n,)
        Where the arm is: a joint that may have any value keeps this one.
    choices : mapping of str to int, optional
        Branches, 0 or 1, by the key of their step; the first of a step that is not named.

    Returns
    -------
    Derivation

    Raises
    ------
    InputError
        ``T`` is no pose, or ``near`` is not n finite numbers.
    ValueError
        The arm has no derivation.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> found = derived(arm, arm.fk([0.0, np.pi / 2]), [0.0, 0.0])
    >>> [step.by for step in found.steps], np.degrees(found.q).round(6).tolist()
    (['law of cosines', 'difference of two angles'], [0.0, 90.0])
    """
    pose, start = as_pose(T, "T"), finite_floats(near, "near", (arm.n,), f"{arm.n} finite numbers")
    return _run(arm, pose, np.asarray(start, dtype=np.float64), {} if choices is None else choices)


def every_derivation(arm: Arm, T: ArrayLike, near: ArrayLike) -> Iterator[Derivation]:
    """Yield the derivations with all choices, the first branches first; arguments as of `derived`."""
    waiting: list[dict[str, int]] = [{}]
    while waiting:
        fixed = waiting.pop()
        found = derived(arm, T, near, fixed)
        yield found
        open_steps = [key for key in found.choices if key not in fixed]
        for i, key in enumerate(open_steps):
            waiting.append(fixed | dict.fromkeys(open_steps[:i], 0) | {key: 1})


def _run(arm: Arm, T: Vector, near: Vector, choices: Mapping[str, int]) -> Derivation:
    method = method_of(arm)
    if method is None:
        raise ValueError(f"{arm.name or 'the arm'} is not solved by hand: {why_not(arm)}")
    work = Work(arm, np.asarray(inverse(arm.base) @ T, dtype=np.float64), near, choices)
    try:
        method.write(work)
    except NoValueError:
        return Derivation(arm, tuple(work.steps), None, dict(work.taken))
    q = np.array([work.q[i] for i in range(arm.n)])
    task = task_error_of(arm)
    errors = task.at(q.tolist(), task.target(T))[2]
    return Derivation(arm, tuple(work.steps), q, dict(work.taken), errors.position, errors.rotation)
