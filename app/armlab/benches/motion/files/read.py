"""Files of a planned motion: a table of samples for other tools, and the whole plan to be read back."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.pick.state import Pick
from armlab.benches.motion.plan.question import Grip
from armlab.benches.motion.plan.state import Plan
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import Motion
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

RATE, FASTEST_RATE = 200.0, 10_000.0
"""Initial and largest number of samples a second of a table."""

MOST_SAMPLES = 100_000
"""Largest number of rows of a table that is written: 25 MB for six joints."""

FINE, COARSE = 12, 9
"""Decimals of times and positions, and of their derivatives. Accelerations follow from second differences when the
table is read: at 200 samples a second an error of 10⁻¹² of a position is one of 10⁻⁷ of an acceleration."""

FORMAT, VERSION = "armlab plan", 1
"""Name and version of the format in a file of a plan."""

OF_THE_SCREEN = ("before", "handled")
"""Entries of a plan that describe the state of the lab, not the motion."""

UNITS = {"q": ("rad", "m"), "qdot": ("rad_s", "m_s"), "qddot": ("rad_s2", "m_s2")}
"""Columns of a table for each joint, with the units of a revolute and of a prismatic one."""


def checked_rate(rate: float) -> float:
    """Return a number of samples a second; `InputError` if it is out of range."""
    if not (math.isfinite(rate) and 0.0 < rate <= FASTEST_RATE):
        raise InputError(f"samples a second: expected more than 0 and at most {FASTEST_RATE:g}, got {rate:g}")
    return float(rate)


def count_of(duration: float, rate: float) -> int:
    """Return the least number of evenly spaced samples, both ends included, for at least the given rate."""
    return int(np.ceil(duration * rate * (1.0 - 1e-12))) + 1


def column_names(arm: Arm) -> tuple[str, ...]:
    """Return the header of a table: names that are variables in MATLAB and pandas, each with its unit.

    >>> import armlab
    >>> column_names(armlab.load("planar_2r"))[:4]
    ('time_s', 'q1_rad', 'q2_rad', 'qdot1_rad_s')
    """
    names = [
        f"{symbol}{i + 1}_{turning if revolute else sliding}"
        for symbol, (turning, sliding) in UNITS.items()
        for i, revolute in enumerate(arm.revolute)
    ]
    return ("time_s", *names)


def motion_csv(arm: Arm, motion: Motion, rate: float, grips: Sequence[Grip] = ()) -> str:
    """Return a motion as comma-separated values in s, rad, m, with one header line without comment signs.

    Parameters
    ----------
    arm : Arm
    motion : Motion
    rate : float
        Samples a second, at least: they are evenly spaced, with both ends.
    grips : sequence of Grip
        If there are some, a last column has 1 where the gripper is closed and 0 where it is open, as it is at first.

    Raises
    ------
    InputError
        A rate that cannot be written, or more than `MOST_SAMPLES` rows.
    """
    refuse_long(motion.duration, rate)
    samples = motion.sample(rate=rate)
    whole = np.column_stack([samples.t, samples.q, samples.qdot, samples.qddot])
    decimals = [FINE] * (1 + arm.n) + [COARSE] * (2 * arm.n)
    if not grips:
        return table_text(column_names(arm), whole, decimals)
    closed = [0.0, *(float(grip.closes) for grip in grips)]
    last = np.searchsorted([grip.time for grip in grips], samples.t + 1e-9, side="right")
    names = (*column_names(arm), "gripper_closed")
    return table_text(names, np.column_stack([whole, np.array(closed)[last]]), [*decimals, 0])


def refuse_long(duration: float, rate: float) -> None:
    """Raise `InputError` if a table would have too many rows."""
    count = count_of(duration, checked_rate(rate))
    if count > MOST_SAMPLES:
        raise InputError(
            f"samples a second: {rate:g} give {count} rows for {duration:.4g} s; expected at most {MOST_SAMPLES} rows"
        )


def table_text(names: Sequence[str], table: Floats, decimals: Sequence[int]) -> str:
    """Return a table as text, with the given decimals in each column; zeros have no sign."""
    line = ",".join(f"%.{each}f" for each in decimals)
    small = np.abs(table) < 0.5 * 0.1 ** np.array(decimals)
    rows = np.where(small, 0.0, table).tolist()
    return "\n".join([",".join(names), *(line % tuple(row) for row in rows)]) + "\n"


def plan_json(state: State) -> str:
    """Return the plan of a state with its arm, and boxes and goal where there are some, for `ReadPlan`.

    Raises
    ------
    InputError
        The arm has a task without a name.
    """
    plan = {key: value for key, value in state[Plan].to_json().items() if key not in OF_THE_SCREEN}
    data = {"format": FORMAT, "version": VERSION, "robot": state[RobotPart].to_json(), "plan": plan}
    if state[Pick].boxes:
        data["pick"] = {key: value for key, value in state[Pick].to_json().items() if key not in Pick.looks}
    # Line by line a person can read it; thousands of samples nobody reads.
    return json.dumps(data, indent=None if state[Plan].recorded else 1, ensure_ascii=False) + "\n"
