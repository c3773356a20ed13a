"""A path with a timing law: as fast as limits allow, or in a given time that keeps them."""

from __future__ import annotations

from typing import Any

import numpy as np

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.field import positive
from armlab.kin.motion.along import moving_ends, restless
from armlab.kin.motion.extremes import SLACK
from armlab.kin.motion.law_types import LawType, law_type
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path import Path
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.scaling import optimal_scaling, refuse_jumps
from armlab.kin.motion.trajectory import Trajectory


def run_along(
    path: Path,
    law: str = "trapezoidal",
    limits: Limits | Arm | None = None,
    *,
    duration: float | None = None,
    **options: Any,
) -> Trajectory:
    """Return a path in joint space with a law; every limit that is given is kept, or refused with the reason.

    Parameters
    ----------
    path : Path
    law : str
        Key of a timing law.
    limits : Limits or Arm, optional
        Limits of the joints; an arm stands for its own limits. They may be left out only with a duration.
    duration : float, optional
        Seconds; left out: as fast as the limits allow.
    **options
        Of the law.

    Raises
    ------
    InputError
        No limits and no duration, a limit that cannot be kept, or a duration that is too short for the limits; the
        text says the shortest.

    Examples
    --------
    >>> from armlab.kin.motion.path_types import path_type
    >>> line = path_type("line").path([[0.0], [1.0]])
    >>> run_along(line, "cubic", Limits(velocity=1.0), duration=1.0)
    Traceback (most recent call last):
    ...
    armlab.errors.InputError: duration: in 1 s joint 1 exceeds its limit of velocity; it takes at least 1.5 s
    """
    kind = law_type(law)
    if duration is None:
        if limits is None:
            raise InputError("limits: give Limits(velocity=..., acceleration=...), an arm, or a duration")
        return Trajectory(path, kind.along(path, limits, **options))
    seconds = positive(duration, "duration")
    if kind.on_path is not None:
        return _stretched(kind, path, limits, seconds, options)
    motion = Trajectory(path, kind.law(seconds, **options))
    if limits is not None:
        held = limits_of(limits, path.m)
        refuse_jumps(motion, held, moving_ends(options))
        _refuse_short(kind, motion, held, options)
    return motion


def _stretched(
    kind: LawType, path: Path, limits: Limits | Arm | None, duration: float, options: dict[str, Any]
) -> Trajectory:
    """Return the trajectory with a law that depends on the path, slowed down to a duration."""
    if limits is None:
        raise InputError(f"limits: {kind.title} takes its shape from them; give Limits(...) or an arm")
    law = kind.along(path, limits, **options)
    if restless(options):
        raise InputError(f"duration: {kind.title} with speeds at its ends lasts {law.duration:.6g} s; leave it out")
    if duration < law.duration * (1.0 - SLACK):
        raise InputError(
            f"duration: {duration:g} s is too short for the limits; it takes at least {law.duration:.6g} s"
        )
    return Trajectory(path, law.stretched(duration / law.duration))


def _refuse_short(kind: LawType, motion: Trajectory, limits: Limits, options: dict[str, Any]) -> None:
    orders = [order for order, finite in enumerate(limits.bounded, start=1) if finite]
    peak = {order: peaks(motion, order).peak for order in orders}
    if not any(np.any(values) for values in peak.values()):
        return
    scaling = optimal_scaling(limits, *(peak.get(order, 0.0) for order in (1, 2, 3)))
    if scaling.k <= 1.0 + SLACK:
        return
    shortest = scaling.k * motion.duration
    if restless(options):
        # Stretched in time its end speeds would be others.
        shortest = kind.along(motion.path, limits, **options).duration
    raise InputError(
        f"duration: in {motion.duration:g} s joint {scaling.joint} exceeds its limit of {scaling.quantity}; it takes "
        f"at least {shortest:.6g} s"
    )
