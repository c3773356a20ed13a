"""One run of the film of iterations: a method with its parameters, and its colour."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Self

import numpy as np

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import Parameter, TaskVector, iteration_methods
from armlab.kin.ik.iterate.problem import Problem
from armlab.registry import Registry
from armlab.session.state import Json

MOST_RUNS = 4

FLOW = "flow"
"""Key of the continuous Jacobian transpose among the methods."""

STEP_SIZE = "1/sigma²"
"""Unit of the parameters that are step sizes of a gradient."""

SAFE = 0.75
"""Share of the bound on a step size: a larger one may diverge, a smaller one is slow."""

CONFIGURATIONS = 48
"""Number of configurations in which the largest singular value of an arm is looked for, in about a millisecond."""

MOST_INSTANTS = 400
"""Largest number of steps in the integration of a flow: more would take seconds without being visible."""


@dataclass(frozen=True)
class Method:
    """A method for runs.

    Attributes
    ----------
    key, title : str
    parameters : tuple of Parameter
    flow : bool
        Whether it is continuous: its iterates are instants.
    tall : bool
        Whether it can be used with more task components than free joints.
    """

    key: str
    title: str
    parameters: tuple[Parameter, ...]
    flow: bool = False
    tall: bool = True

    def parameter(self, key: str) -> Parameter:
        """Return a parameter by key."""
        for parameter in self.parameters:
            if parameter.key == key:
                return parameter
        raise UnknownName(f"parameter of {self.title}", key, [each.key for each in self.parameters])


@cache
def methods() -> Registry[Method]:
    """Return all methods: the iterative ones in their order, then the continuous Jacobian transpose."""
    found = [Method(each.key, each.title, each.parameters, tall=each.tall) for each in iteration_methods().values()]
    times = (
        Parameter("gain", "K", "gain of the error", 1.0, 0.01, 100.0, "1/s"),
        Parameter("duration", "T", "how long it runs", 10.0, 0.1, 100.0, "s"),
        Parameter("dt", "Δt", "time step of the integration", 0.05, 0.001, 1.0, "s"),
    )
    return Registry("method", [*found, Method(FLOW, "Jacobian transpose in continuous time", times, flow=True)])


def method_named(key: str) -> Method:
    """Return a method by key; `UnknownName` if there is none."""
    return methods()[key]


@dataclass(frozen=True)
class Run:
    """One run; make one with `run_of`.

    Attributes
    ----------
    method : str
        Key of a `Method`.
    parameters : tuple of (str, float)
        All of them, in the order of the method.
    colour : int
        Which of `MOST_RUNS` colours it is drawn in; no other run has it.
    """

    method: str
    parameters: tuple[tuple[str, float], ...] = ()
    colour: int = 0

    @property
    def kind(self) -> Method:
        """The method."""
        return methods()[self.method]

    @property
    def values(self) -> dict[str, float]:
        """The parameters by key."""
        return dict(self.parameters)

    def with_parameter(self, key: str, value: float) -> Self:
        """Return the run with one parameter changed; `InputError` if it is unknown or out of its range."""
        checked = _checked(self.kind, {**self.values, self.kind.parameter(key).key: value})
        return replace(self, parameters=checked)

    def to_json(self) -> Json:
        """Write the run."""
        return [self.method, self.values, self.colour]


def run_of(method: str, parameters: Mapping[str, float] | None = None, colour: int = 0) -> Run:
    """Return a checked run; parameters that are not given have their defaults.

    Raises
    ------
    InputError
        An unknown method or parameter, or a number out of its range.
    """
    chosen = method_named(method)
    given = dict(parameters or {})
    for key in given:
        chosen.parameter(key)
    values = {each.key: given.get(each.key, each.default) for each in chosen.parameters}
    if type(colour) is not int or not 0 <= colour < MOST_RUNS:
        raise InputError(f"colour: expected 0 to {MOST_RUNS - 1}, got {colour!r}")
    return Run(method, _checked(chosen, values), colour)


def fitting(method: str, arm: Arm, vector: TaskVector, colour: int = 0) -> Run:
    """Return a run with its parameters at their defaults, and a step size that suits the arm."""
    return refitted(run_of(method, colour=colour), arm, vector)


def refitted(run: Run, arm: Arm, vector: TaskVector | None = None) -> Run:
    """Return the run with a step size that suits the arm and its task, or the given task vector."""
    for each in run.kind.parameters:
        if each.unit == STEP_SIZE:
            value = step_size(arm, vector or TaskVector(arm.task))
            run = run.with_parameter(each.key, min(max(value, each.low), each.high))
    return run


@lru_cache(maxsize=64)
def step_size(arm: Arm, vector: TaskVector) -> float:
    """Return `SAFE` times the bound 2 / sigma_max^2 of the gradient, for the largest sigma_max of the arm.

    m⁻² or a pure number, with two digits: 0.3 m⁻² for a planar 2R with links of 1 m. The largest singular value is
    that of seeded configurations and of all joints at zero, where most tables are stretched.
    """
    rng, low, high = np.random.default_rng(0), *arm.limits.T
    q = np.vstack([np.zeros(arm.n), rng.uniform(low, high, (CONFIGURATIONS, arm.n))])
    problem = Problem(arm, np.asarray(arm.fk(q[0]), dtype=np.float64), vector, range(arm.n), clamp=False)
    largest = float(problem.at(q).sigma_max.max())
    return float(f"{SAFE * 2.0 / largest**2:.2g}") if largest > 0.0 else 1.0


def free_colour(runs: tuple[Run, ...]) -> int:
    """Return the first colour that no run has; `InputError` if no colour is left."""
    taken = {run.colour for run in runs}
    for colour in range(MOST_RUNS):
        if colour not in taken:
            return colour
    raise InputError(f"at most {MOST_RUNS} runs can be told apart in one picture: remove one first")


def _checked(method: Method, values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
    checked = []
    for parameter in method.parameters:
        value = float(values[parameter.key])
        if not (math.isfinite(value) and parameter.low <= value <= parameter.high):
            raise InputError(
                f"{parameter.title} {parameter.symbol}: expected {parameter.low:g} to {parameter.high:g}, got {value:g}"
            )
        checked.append((parameter.key, value))
    found = dict(checked)
    if method.flow and found["duration"] / found["dt"] > MOST_INSTANTS * (1.0 + 1e-9):
        raise InputError(
            f"T / Δt: expected at most {MOST_INSTANTS} steps, got {found['duration']:g} s / {found['dt']:g} s"
        )
    return tuple(checked)
