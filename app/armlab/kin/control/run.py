"""Simulation of a control law on a plant, step by step and in pieces; all numbers stay finite.

References
----------
Notes 5.2 (simulations), 7.1-7.2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.control.control_law import ControlLaw, control_law
from armlab.kin.control.controller import Aim, Controller
from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.encoder import read_off
from armlab.kin.control.joint_reference import halfway, joints_along
from armlab.kin.control.null_term import checked_wish
from armlab.kin.control.plant import IDEAL, Plant, Push, believed
from armlab.kin.control.rate_inverse import pseudo_inverse_speeds, rate_inverse
from armlab.kin.control.record import Run
from armlab.kin.control.reference import JointAims, Reference, ToolAims
from armlab.kin.control.saturation import limited
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.field import positive
from armlab.kin.work import Work, result_of
from armlab.registry import known_name

Floats = NDArray[np.float64]

INTEGRATORS = {"euler": "Euler", "rk4": "Runge–Kutta 4"}

STEP = 1e-3
"""Default step, seconds."""

MOST_STEPS = 200_000

FASTEST = 1e6
"""Largest speed of a joint, rad/s or m/s: a law that wants more has no usable answer, beside a singularity or as it
diverges."""

FARTHEST = 1.0
"""Largest change of a joint in one step, rad or length scales of the arm: a larger one only jumps from pose to pose."""

PIECE = 400
"""Commands in one piece of work: some 20 ms."""


@dataclass(frozen=True)
class Settings:
    """Settings of a run.

    Attributes
    ----------
    step : float
        Seconds; the last one is the others' length, too: it is changed a little so that a whole number fits.
    integrator : "rk4" or "euler"
        Method for a law that acts continuously; commands that are held for a period are integrated exactly.
    inverse : str
        Key of the inverse of the differential kinematics.
    inverse_options, law_options : mapping
        Options by key.
    null : str
        Key of the null-space term.
    null_gain : float
        1/s.
    plant : Plant
    """

    step: float = STEP
    integrator: str = "rk4"
    inverse: str = "pinv"
    inverse_options: Mapping[str, Any] = field(default_factory=dict)
    law_options: Mapping[str, Any] = field(default_factory=dict)
    null: str = "none"
    null_gain: float = 1.0
    plant: Plant = IDEAL


def clock(duration: float, step: float, sampling: float, held: bool = False) -> tuple[int, float, int]:
    """Return the number of steps of a run, their length, and for how many of them a command is held; 0: for none.

    Parameters
    ----------
    duration, step, sampling : float
        Seconds; the step is shortened so that a whole number fits into the duration.
    held : bool
        Whether the law is made for sampled time: its command is held for one step at least.

    Raises
    ------
    InputError
        The step is not positive, or there are too many.

    Examples
    --------
    >>> clock(1.0, 0.3, 0.4)
    (4, 0.25, 2)
    """
    count = max(1, math.ceil(duration / positive(step, "step") * (1.0 - 1e-12)))
    if count > MOST_STEPS:
        raise InputError(f"step: expected at most {MOST_STEPS} steps, got {count}")
    whole = duration / count
    return count, whole, max(1, round(sampling / whole)) if sampling > 0.0 or held else 0


def simulate(
    arm: Arm, law: str, reference: Reference, q0: ArrayLike | None = None, settings: Settings | None = None
) -> Run:
    """Return the motion of an arm under a control law.

    Parameters
    ----------
    arm : Arm
        The true arm; the controller knows it with the errors of the plant in the settings.
    law : str
        Key of a `ControlLaw`.
    reference : Reference
    q0 : array_like, shape (n,), optional
        Joint values at time 0; those of the reference when left out, which then has to be one of the joints.
    settings : Settings, optional

    Raises
    ------
    InputError
        An unknown name, a number out of range, too many steps, or a law for moving references with none.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
    >>> from armlab.kin.control.reference import LineReference
    >>> run = simulate(arm, "open_loop", LineReference(arm.fk([0.3, 1.0]), [-0.2, 0.0, 0.0], 1.0), [0.3, 1.0])
    >>> run.finished, bool(run.error_position[-1] < 1e-9)
    (True, True)
    """
    return result_of(simulating(arm, law, reference, q0, settings))


def simulating(
    arm: Arm, law: str, reference: Reference, q0: ArrayLike | None = None, settings: Settings | None = None
) -> Work[Run]:
    """Do the same as `simulate` in pieces of some 20 ms, and return the run at the end."""
    given = settings or Settings()
    kind, plant = control_law(law), given.plant
    known_name("integrator", given.integrator, INTEGRATORS)
    count, step, every = clock(reference.duration, given.step, plant.sampling, kind.held)
    known = ScaledTask(believed(arm, plant))
    times = np.linspace(0.0, reference.duration, 2 * count + 1)
    tool = reference.tool(arm, times)
    start = _start(arm, reference, q0)
    joints, reason = yield from _joint_aims(kind, known, reference, tool, times, start, step)
    if joints is not None:
        count = min(count, (len(joints.q) - 1) // 2)
    if count < 1:
        return _still(arm, start, tool, reason)
    loop = _Loop(arm, kind, known, given, tool, joints, start, (step, count, every))
    yield from loop.go()
    return loop.run(reason)


def _start(arm: Arm, reference: Reference, q0: ArrayLike | None) -> Floats:
    if q0 is None:
        aims = reference.joints(arm, np.zeros(1))
        if aims is None:
            raise InputError(
                "q0: expected the joint values at the beginning: this reference has only poses of the tool"
            )
        return np.array(aims.q[0])
    return finite_floats(q0, "q0", (arm.n,), f"{arm.n} finite joint values")


def _joint_aims(
    kind: ControlLaw, task: ScaledTask, reference: Reference, tool: ToolAims, times: Floats, q0: Floats, step: float
) -> Work[tuple[JointAims | None, str]]:
    """Return the wanted joint values at all times of the grid, where the law or the reference has any, and a reason."""
    own = reference.joints(task.arm, times)
    if own is not None or kind.space == "tool":
        return own, ""
    found = yield from joints_along(task, ToolAims(tool.poses[::2], tool.twists[::2]), q0)
    if not len(found.aims.q):
        return JointAims(np.zeros((0, task.n)), np.zeros((0, task.n))), found.reason
    return halfway(found.aims, step), found.reason


def _still(arm: Arm, q: Floats, tool: ToolAims, reason: str) -> Run:
    """Return a run of one instant, with the reason why there are no more."""
    nothing = np.zeros((1, arm.n))
    return _recorded(
        arm, tool, None, np.zeros(1), q[None], (nothing, nothing, np.zeros(1), np.zeros(1, bool)), 1.0, reason, ()
    )


class _Loop:
    """State of one simulation while it runs."""

    def __init__(
        self,
        arm: Arm,
        kind: ControlLaw,
        known: ScaledTask,
        given: Settings,
        tool: ToolAims,
        joints: JointAims | None,
        q0: Floats,
        clock: tuple[float, int, int],
    ) -> None:
        self._arm, self._kind, self._given, self._plant = arm, kind, given, given.plant
        self._tool, self._joints = tool, joints
        self._step, self._count, self._every = clock
        method = rate_inverse(given.inverse)
        self._controller = Controller(
            known,
            method,
            method.options(given.inverse_options),
            checked_wish(given.null),
            float(finite_floats(given.null_gain, "gain of the null-space term", (), "a finite number")),
        )
        self._options = kind.prepare(known, kind.options(given.law_options))
        self._limits = given.plant.limits(arm)
        self._bounds = (FARTHEST / self._step * np.where(arm.revolute, 1.0, arm.length_scale)).tolist()
        counts = given.plant.encoder
        self._resolution = None if counts is None else counts.resolution(arm.revolute)
        self._pushes = sorted(given.plant.pushes, key=lambda push: push.time)
        self._pushed: list[float] = []
        self._stopped = ""
        self._none = np.zeros(arm.n)
        shape = (self._count + 1, arm.n)
        self._q, self._qdot, self._wanted = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        self._damping, self._saturated = np.zeros(self._count + 1), np.zeros(self._count + 1, dtype=bool)
        self._q[0] = q0
        self._at = 0

    def go(self) -> Work[None]:
        """Take all steps, or stop at the first that has no answer."""
        held = (self._none, self._none, 0.0, False)
        q, h = self._q[0], self._step
        euler, every = self._given.integrator == "euler" or self._every > 0, self._every
        rest = max(1, PIECE if euler else PIECE // 4)
        for k in range(self._count + 1):
            self._at = k
            if k % rest == rest - 1:
                yield
            q = self._q[k] = self._displaced(q, k)
            if every == 0 or k % every == 0:
                told = self._told(q, 2 * k)
                if told is None:
                    return
                held = told
            self._qdot[k], self._wanted[k], self._damping[k], self._saturated[k] = held
            if k == self._count:
                return
            after = q + h * held[0] if euler else self._runge_kutta(q, 2 * k, held[0])
            if after is None:
                return
            q = after

    def _runge_kutta(self, q: Floats, grid: int, first: Floats) -> Floats | None:
        """Return the joint values after a step of the classical fourth-order method; None if the law has no answer."""
        h, rates = self._step, [first]
        for part, later in ((0.5, 1), (0.5, 1), (1.0, 2)):
            told = self._told(q + part * h * rates[-1], grid + later)
            if told is None:
                return None
            rates.append(told[0])
        k1, k2, k3, k4 = rates
        return np.asarray(q + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4))

    def _told(self, q: Floats, grid: int) -> tuple[Floats, Floats, float, bool] | None:
        """Return actual and commanded joint speeds, damping, and whether motors saturate; None without an answer."""
        seen = q if self._resolution is None else read_off(q, self._resolution)
        told = self._kind.command(self._controller, seen, self._aim(grid), self._options)
        if told.qdot is None:
            self._stopped = told.says
            return None
        if not all(abs(speed) <= FASTEST for speed in told.qdot.tolist()):
            self._stopped = f"joint {_fastest(told.qdot)} would have to be faster than a million rad/s or m/s"
            return None
        actual, changed = limited(self._plant.saturation, told.qdot, self._limits)
        if not all(abs(speed) <= most for speed, most in zip(actual.tolist(), self._bounds, strict=True)):
            self._stopped = self._jumps(actual)
            return None
        return actual, told.qdot, told.damping, changed

    def _jumps(self, qdot: Floats) -> str:
        """Return the reason why joint speeds cannot be followed; empty when they can."""
        joint = _fastest(qdot / np.array(self._bounds))
        least = f"{math.degrees(FARTHEST):.0f}°" if self._arm.revolute[joint - 1] else "half the reach of the arm"
        return (
            f"joint {joint} would have to move by more than {least} in one step of {1e3 * self._step:.3g} ms: "
            "beside a singularity, beyond the workspace, or with gains too high no step is short enough"
        )

    def _aim(self, grid: int) -> Aim:
        poses, twists = self._tool
        whole = 2 * max(self._every, 1)
        later = min(grid + whole, len(poses) - 1)
        # The grid has two times a step; the last period may be shorter than the others.
        ahead = 0.5 * self._step * ((later - grid) or whole)
        q, qdot = (self._none, self._none) if self._joints is None else (self._joints.q[grid], self._joints.qdot[grid])
        return Aim(poses[grid], twists[grid], q, qdot, poses[later], ahead)

    def _displaced(self, q: Floats, k: int) -> Floats:
        """Return the joint values after the pushes that are due by instant k."""
        while self._pushes and self._pushes[0].time <= (k + 1e-6) * self._step:
            push = self._pushes.pop(0)
            q = q + pushed_joints(self._arm, q, push)
            self._pushed.append(k * self._step)
        return q

    def run(self, reason: str) -> Run:
        """Return the record up to the instant at which the simulation stopped."""
        last = self._at + 1
        series = (self._qdot[:last], self._wanted[:last], self._damping[:last], self._saturated[:last])
        return _recorded(
            self._arm,
            self._tool,
            self._joints,
            self._step * np.arange(float(last)),
            self._q[:last],
            series,
            self._step,
            # Where q_d ends, beside a singularity, its last rates are beyond all bounds, too.
            reason if reason and self._at >= self._count - 1 else self._stopped or reason,
            tuple(self._pushed),
        )


def _fastest(qdot: Floats) -> int:
    """Return the joint with the largest speed, 1-based."""
    return int(np.argmax(np.abs(np.nan_to_num(qdot, nan=np.inf)))) + 1


def pushed_joints(arm: Arm, q: Floats, push: Push) -> Floats:
    """Return the joint changes (n,) of a push: the shortest of those that come closest to its displacement."""
    task = ScaledTask(arm)
    found = decomposed(np.asarray(arm.jacobian(q)[:3] * task.joint_units))
    return task.speeds(pseudo_inverse_speeds(found, np.array(push.by)))


def _recorded(
    arm: Arm,
    tool: ToolAims,
    joints: JointAims | None,
    t: Floats,
    q: Floats,
    series: tuple[Floats, Floats, Floats, NDArray[np.bool_]],
    step: float,
    stopped: str,
    pushed: tuple[float, ...],
) -> Run:
    """Return a run, with everything that follows from its joint values."""
    task, whole = ScaledTask(arm), slice(0, 2 * len(t) - 1, 2)
    poses, wanted = np.asarray(arm.fk(q), dtype=np.float64), tool.poses[whole]
    error = task.errors(wanted, poses)
    place, turn = task.kinds(error)
    sigma = np.linalg.svd(task.jacobians(q, poses), compute_uv=False)
    return Run(
        arm,
        t,
        q,
        series[0],
        series[1],
        poses[:, :3, 3],
        wanted[:, :3, 3],
        error,
        place,
        turn,
        None if joints is None or not len(joints.q) else joints.q[whole] - q,
        np.array(sigma[:, -1]) if sigma.shape[1] else np.zeros(len(t)),
        series[2],
        series[3],
        step,
        stopped,
        pushed,
        task.sigma_unit,
    )
