"""One run of the film of iterations: a method with its parameters, and the colour it is drawn in."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Self

from armlab.errors import InputError, UnknownName
from armlab.kin.ik.iterate import Parameter, iteration_methods
from armlab.session.state import Json

MOST_RUNS = 4

FLOW = "flow"
"""Key of the continuous Jacobian transpose among the methods."""

MOST_INSTANTS = 400
"""Steps of the integration of a flow: more would take seconds and be seen by nobody."""


@dataclass(frozen=True)
class Method:
    """What a run may be made by.

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
def methods() -> dict[str, Method]:
    """Return all methods: the iterative ones in their order, then the continuous Jacobian transpose."""
    found = {
        each.key: Method(each.key, each.title, each.parameters, tall=each.tall) for each in iteration_methods().values()
    }
    times = (
        Parameter("gain", "K", "gain of the error", 1.0, 0.01, 100.0, "1/s"),
        Parameter("duration", "T", "how long it runs", 10.0, 0.1, 100.0, "s"),
        Parameter("dt", "Δt", "time step of the integration", 0.05, 0.001, 1.0, "s"),
    )
    return {**found, FLOW: Method(FLOW, "Jacobian transpose in continuous time", times, flow=True)}


def method_named(key: str) -> Method:
    """Return a method by key; `UnknownName` when there is none."""
    if not isinstance(key, str) or key not in methods():
        raise UnknownName("method", key, methods())
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
        """Return the run with one parameter changed; `InputError` when it is unknown or out of its range."""
        checked = _checked(self.kind, {**self.values, self.kind.parameter(key).key: value})
        return replace(self, parameters=checked)

    def to_json(self) -> Json:
        """Write it down."""
        return [self.method, self.values, self.colour]


def run_of(method: str, parameters: Mapping[str, float] | None = None, colour: int = 0) -> Run:
    """Return a checked run; parameters not given stand at their defaults.

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


def free_colour(runs: tuple[Run, ...]) -> int:
    """Return the first colour that no run has; `InputError` when there are as many runs as can be shown."""
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
