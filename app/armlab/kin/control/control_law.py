"""Control laws: from measured joint values and a reference to joint speeds.

References
----------
Notes 7.1-7.2; with feed-forward alone 5.99.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.control import laws as _folder
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.field import Field, checked_options
from armlab.plugins import discover
from armlab.registry import Registry

Floats = NDArray[np.float64]

Command = Callable[[Controller, Floats, Aim, Mapping[str, Any]], Told]
"""``command(controller, q (n,) as measured, aim, options) -> Told``; all options are present and checked."""

Prepare = Callable[[ScaledTask, dict[str, Any]], dict[str, Any]]


@dataclass(frozen=True)
class ControlLaw:
    """The constant ``LAW`` of a module in `armlab.kin.control.laws`.

    Parameters
    ----------
    key, title : str
    order : int
    command : callable
        See `Command`.
    space : "tool" or "joints"
        The space in which the error is taken; a law for joints needs q_d.
    fields : tuple of Field
        Options.
    held : bool
        Whether it is made for sampled time: its command is for a whole period.
    inverts : bool
        Whether it needs an inverse of the differential kinematics.
    feedback : bool
        Whether it looks at the error at all.
    formula : str
        The law in LaTeX.
    prepare : callable
        ``prepare(task, options)`` returns the options made fit for the arm, such as one gain for each joint.
    """

    key: str
    title: str
    order: int
    command: Command
    space: Literal["tool", "joints"]
    fields: tuple[Field, ...] = ()
    held: bool = False
    inverts: bool = True
    feedback: bool = True
    formula: str = ""
    prepare: Prepare = lambda task, options: options

    def options(self, given: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Return all options by key, those not given at their defaults; `InputError` when one is wrong."""
        return checked_options(self.key, self.fields, given or {})


@cache
def control_laws() -> Registry[ControlLaw]:
    """Return all laws by key, in the order of lists."""
    return discover(_folder, "LAW", ControlLaw, "control law")


def control_law(key: str) -> ControlLaw:
    """Return a law by key; `UnknownName` when there is none."""
    return control_laws()[key]


def task_gains(task: ScaledTask, options: dict[str, Any]) -> dict[str, Any]:
    """Return options with one gain for each task component, (m,), under ``"K"``.

    Raises
    ------
    InputError
        Not one gain, and not one for each controlled coordinate.
    """
    place, given = len(task.arm.task.position), options["Kp"]
    if place and len(given) not in (1, place):
        raise InputError(f"K_p: expected one gain, or {place}, one for each controlled coordinate, got {len(given)}")
    K = np.full(task.m, float(options["Ko"]))
    K[:place] = given[:place] if len(given) == place else given[0]
    return {**options, "K": K}


def joint_gains(task: ScaledTask, options: dict[str, Any]) -> dict[str, Any]:
    """Return the options with one gain for each joint, (n,), under ``"K"``; `InputError` when their number is wrong."""
    if len(options["K"]) not in (1, task.n):
        raise InputError(f"K: expected one gain, or {task.n}, one for each joint, got {len(options['K'])}")
    return {**options, "K": np.array(np.broadcast_to(options["K"], (task.n,)))}


MOST_GAIN = 1e4
"""Largest gain, 1/s."""

TASK_GAINS = (
    Field("Kp", "K_p", "gain of the position error", "list", (5.0,), 0.0, MOST_GAIN, unit="1/s"),
    Field("Ko", "K_o", "gain of the orientation error", "number", 5.0, 0.0, MOST_GAIN, unit="1/s"),
)

JOINT_GAINS = (
    Field("K", "K", "gains of the joint errors: one, or one for each", "list", (5.0,), 0.0, MOST_GAIN, unit="1/s"),
)
