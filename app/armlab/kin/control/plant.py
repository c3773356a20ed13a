"""The arm as a plant: it follows commanded joint speeds with a delay, within limits, and with errors of the model.

References
----------
Notes 7.1 (initial errors, discrete time, uncertain parameters) and 7.2 (the robot as an ideal integrator of joint
speeds); 5.106.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number, wrong
from armlab.kin.control.encoder import Encoder
from armlab.kin.control.saturation import checked_saturation
from armlab.kin.field import positive_bounds
from armlab.kin.transforms import as_pose

Floats = NDArray[np.float64]

MOST_WRONG = 0.5
"""Largest relative error of the lengths of the links."""


@dataclass(frozen=True)
class Push:
    """A sudden displacement of the tool point while the arm runs.

    Attributes
    ----------
    time : float
        Seconds.
    by : (float, float, float)
        Metres, in the world. The joints give way by the least squares J# by, as far as the arm can move so.
    """

    time: float
    by: tuple[float, float, float]


@dataclass(frozen=True)
class Plant:
    """Deviations of the arm from the ideal; make them with `plant`.

    Attributes
    ----------
    sampling : float
        Seconds between two commands, which are held in between; 0: the law acts at every instant.
    saturation : str
        See `armlab.kin.control.saturation`.
    speed_limits : tuple of float
        rad/s or m/s, one for each joint, or one for all; empty for those of the arm.
    encoder : Encoder or None
        None: the controller knows the joint values exactly.
    wrong : float
        Relative error of the length that the controller believes: by this part the link is longer.
    link : int
        The wrong link, 1-based; 0 for all.
    pushes : tuple of Push
    """

    sampling: float = 0.0
    saturation: str = "none"
    speed_limits: tuple[float, ...] = ()
    encoder: Encoder | None = None
    wrong: float = 0.0
    link: int = 0
    pushes: tuple[Push, ...] = field(default=())

    def limits(self, arm: Arm) -> Floats:
        """Return the limits of the joint speeds, (n,)."""
        given = np.array(self.speed_limits)
        return arm.speed_limits if not len(given) else np.asarray(np.broadcast_to(given, (arm.n,)))


IDEAL = Plant()


def plant(
    arm: Arm,
    *,
    sampling: float = 0.0,
    saturation: str = "none",
    speed_limits: ArrayLike | None = None,
    encoder: Encoder | None = None,
    wrong_by: float = 0.0,
    link: int = 0,
    pushes: tuple[Push, ...] = (),
) -> Plant:
    """Return a checked plant; see `Plant` for what each argument is.

    Raises
    ------
    InputError
        A number out of range, or a link the arm does not have.
    """
    held = float(finite_floats(sampling, "sampling time", (), "seconds, 0 for none"))
    if held < 0.0:
        raise wrong("sampling time", "seconds, 0 for none", sampling)
    limits = () if speed_limits is None else tuple(positive_bounds(speed_limits, "speed limit", arm.n).tolist())
    share = float(finite_floats(wrong_by, "link length", (), "a part of the length"))
    if abs(share) > MOST_WRONG:
        raise InputError(f"link length: expected at most {100.0 * MOST_WRONG:g} % wrong, got {100.0 * share:g} %")
    if whole_number(link, "link", 0) > arm.n:
        raise InputError(f"link: expected 1 to {arm.n}, or 0 for all, got {link}")
    for push in pushes:
        finite_floats(push.by, "push", (3,), "three finite numbers")
        if not (math.isfinite(push.time) and push.time >= 0.0):
            raise wrong("time of a push", "seconds, not negative", push.time)
    return Plant(held, checked_saturation(saturation), limits, encoder, share, link, pushes)


def believed(arm: Arm, plant: Plant) -> Arm:
    """Return the arm as the controller knows it, the same one in both conventions.

    Its link i is shorter by the factor 1 / (1 + wrong): the constant lengths a_i and, of a joint that turns, d_i. In a
    modified table a_i is in row i + 1, and that of the last link is the part of the tool along x of frame n, where
    `armlab.kin.convert.converted` puts it. The link before joint 1 belongs to the base, and the rest of a tool is
    mounted on the last link: both are known.
    """
    if plant.wrong == 0.0:
        return arm
    known = 1.0 / (1.0 + plant.wrong)
    factors = [1.0] + [known if plant.link in (0, link) else 1.0 for link in range(1, arm.n + 1)]
    of_a = factors[1:] if arm.convention == "standard" else factors[:-1]
    rows = tuple(
        replace(row, a=row.a * a, d=row.d * d if row.revolute else row.d)
        for row, a, d in zip(arm.rows, of_a, factors[1:], strict=True)
    )
    if arm.convention == "standard":
        return replace(arm, rows=rows)
    tool = arm.tool.copy()
    tool[0, 3] *= factors[-1]
    return replace(arm, rows=rows, tool=as_pose(tool, "tool"))
