"""The characteristic curve of a sensor: its errors, the figures that describe them, and its calibration.

Input u and output y are parts of full scale: an ideal sensor has y = u on [0, 1].

References
----------
Notes, section 2.3: linearity error, offset error, resolution error; calibration leads to high accuracy.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import whole_number, wrong
from armlab.registry import known_name

Floats = NDArray[np.float64]

SHAPES = {"arch": "arch", "wave": "S"}
"""Shapes of a curve that is no line, both zero at the ends of the range and of height 1."""

FEWEST_POINTS, MOST_POINTS = 2, 400
MOST_DEGREE = 9

FINE = 4001
"""Number of points of the cycle on which the dead band is looked for."""

SAME = 1e-12
"""Difference of outputs that is rounding."""

SLOPES = {"arch": (-4.0, 4.0), "wave": (-9.0 / math.sqrt(3.0), 18.0 / math.sqrt(3.0))}
"""Least and largest slope of each shape: of the arch at the ends, of the wave in the middle and at the ends."""


def _shape(kind: str, u: Floats) -> Floats:
    # The wave u (1 - u) (1 - 2 u) is sqrt(3) / 18 high.
    arch = u * (1.0 - u)
    return 4.0 * arch if kind == "arch" else 18.0 / math.sqrt(3.0) * arch * (1.0 - 2.0 * u)


@dataclass(frozen=True)
class Sensor:
    """A sensor with errors, all in parts of full scale.

    Parameters
    ----------
    offset : float
        Output at the input zero.
    gain : float
        Error of the slope: 0.02 is 2 % too steep.
    bend : float
        Height of the curve over the line.
    shape : str
        Some of `SHAPES`.
    hysteresis : float
        Play between the quantity and the sensor, such as that of a gear: the sensor follows only when it is used up.
    resolution : float
        Step of the input that can be told apart; 0: any.
    noise : float
        Standard deviation of each single output.

    Raises
    ------
    InputError
        A number is not finite, or one of the last three is negative; `UnknownName` for another shape.
    """

    offset: float = 0.0
    gain: float = 0.0
    bend: float = 0.0
    shape: str = "arch"
    hysteresis: float = 0.0
    resolution: float = 0.0
    noise: float = 0.0

    def __post_init__(self) -> None:
        known_name("shape", self.shape, SHAPES)
        for name in ("offset", "gain", "bend", "hysteresis", "resolution", "noise"):
            value = getattr(self, name)
            if not math.isfinite(value):
                raise wrong(name, "a finite number", value)
            if value < 0.0 and name in ("hysteresis", "resolution", "noise"):
                raise wrong(name, "no negative number", value)

    @property
    def turns_back(self) -> bool:
        """Whether the curve without play, steps and noise both rises and falls: two inputs have one output."""
        slopes = [1.0 + self.gain + self.bend * slope for slope in SLOPES[self.shape]]
        return min(slopes) < 0.0 < max(slopes)

    def followed(self, inputs: ArrayLike, start: float) -> Floats:
        """Return what reaches the sensor through the play while the input goes through values (N,), (N,).

        ``z = min(max(z, u - h / 2), u + h / 2)``, from z = ``start`` on.
        """
        at, half, found = start, 0.5 * self.hysteresis, []
        for u in np.asarray(inputs, dtype=np.float64).tolist():
            at = min(max(at, u - half), u + half)
            found.append(at)
        return np.array(found)

    def output(self, followed: ArrayLike) -> Floats:
        """Return outputs without noise for what reaches the sensor, any shape."""
        z = np.asarray(followed, dtype=np.float64)
        if self.resolution > 0.0:
            z = self.resolution * np.round(z / self.resolution)
        return np.asarray(self.offset + (1.0 + self.gain) * z + self.bend * _shape(self.shape, z))


@dataclass(frozen=True, eq=False)
class Cycle:
    """A sensor whose input goes up through the range and down again, as it has done before.

    Parameters
    ----------
    sensor : Sensor
    points : int
        Inputs on each way, evenly spread, `FEWEST_POINTS` to `MOST_POINTS`.
    seed : int
        Of the noise.
    inset : float
        How far the first and the last input lie inside of the range.

    Raises
    ------
    InputError
        The numbers are not as above.
    """

    sensor: Sensor
    points: int
    seed: int = 0
    inset: float = 0.0

    def __post_init__(self) -> None:
        if whole_number(self.points, "points", FEWEST_POINTS) > MOST_POINTS:
            raise wrong("points", f"at most {MOST_POINTS}", self.points)
        whole_number(self.seed, "seed", 0)

    def between(self, seed: int) -> Cycle:
        """Return a cycle of the same sensor with inputs in the middles between these, and noise of its own."""
        return Cycle(self.sensor, self.points - 1, seed, 0.5 / (self.points - 1))

    @cached_property
    def inputs(self) -> Floats:
        """Inputs, up and then down, (2 points,)."""
        return _there_and_back(self.points, self.inset)

    @cached_property
    def outputs(self) -> Floats:
        """Outputs beside them."""
        # Before the first input the range has been gone through: the play is used up downwards.
        half = 0.5 * self.sensor.hysteresis
        z = self.sensor.followed(self.inputs, self.inputs[0] + half)
        noise = np.random.default_rng(self.seed).standard_normal(2 * self.points)
        return np.asarray(self.sensor.output(z) + self.sensor.noise * noise)

    @property
    def largest_error(self) -> float:
        """Largest difference of the output from that of an ideal sensor."""
        return float(np.abs(self.outputs - self.inputs).max())

    @cached_property
    def line(self) -> tuple[float, float]:
        """Intercept and slope of the straight line that fits the outputs best, by least squares."""
        return best_line(self.inputs, self.outputs)

    @property
    def linearity(self) -> float:
        """Linearity error: the largest deviation from that line."""
        return linearity_error(self.inputs, self.outputs)

    @property
    def offset(self) -> float:
        """Offset error: the output for the null input, the mean of the beginning and the end of the cycle."""
        return float(0.5 * (self.outputs[0] + self.outputs[-1]))

    @property
    def hysteresis(self) -> float:
        """Largest difference of the outputs for one input between the way down and the way up."""
        return float(np.abs(self.outputs[: self.points] - self.outputs[: self.points - 1 : -1]).max())


def _there_and_back(points: int, inset: float = 0.0) -> Floats:
    up = np.linspace(inset, 1.0 - inset, points)
    return np.concatenate([up, up[::-1]])


def dead_band(sensor: Sensor) -> float:
    """Return the largest change of the input that does not change the output, noise left aside: the resolution error.

    It is looked for on a cycle of `FINE` points, so that it is known to about a part in as many; the play counts at the
    ends, where the input turns back.
    """
    inputs = _there_and_back(FINE)
    outputs = sensor.output(sensor.followed(inputs, inputs[0] + 0.5 * sensor.hysteresis))
    best = 0.0
    for way in (slice(None, FINE), slice(FINE, None)):
        u, y = inputs[way], outputs[way]
        changes = np.flatnonzero(np.abs(np.diff(y)) > SAME) + 1
        begins, ends = np.concatenate([[0], changes]), np.concatenate([changes - 1, [len(u) - 1]])
        best = max(best, float(np.abs(u[ends] - u[begins]).max()))
    return best


def best_line(u: ArrayLike, y: ArrayLike) -> tuple[float, float]:
    """Return intercept and slope of the line through points (N,) by least squares.

    >>> best_line([0, 1, 2], [1, 3, 5])
    (1.0, 2.0)
    """
    x, v = np.asarray(u, dtype=np.float64), np.asarray(y, dtype=np.float64)
    away = x - x.mean()
    slope = float(away @ v / (away @ away))
    return float(v.mean() - slope * x.mean()), slope


def linearity_error(u: ArrayLike, y: ArrayLike) -> float:
    """Return the largest deviation of points (N,) from the line that fits them best."""
    intercept, slope = best_line(u, y)
    return float(np.abs(np.asarray(y) - intercept - slope * np.asarray(u)).max())


@dataclass(frozen=True, eq=False)
class Calibration:
    """A polynomial that tells the input from the output, fitted to a cycle by least squares.

    Parameters
    ----------
    cycle : Cycle
        Its inputs are known from a reference.
    degree : int
        1 for a line, up to `MOST_DEGREE`, and with fewer coefficients than inputs.

    Raises
    ------
    InputError
        The degree is not as above, or the outputs do not differ enough to tell inputs apart.
    """

    cycle: Cycle
    degree: int

    def __post_init__(self) -> None:
        if whole_number(self.degree, "degree", 1) > min(MOST_DEGREE, self.cycle.points - 1):
            most = min(MOST_DEGREE, self.cycle.points - 1)
            raise wrong("degree", f"1 to {most}, with {self.cycle.points} points", self.degree)
        if len(set(np.round(self.cycle.outputs, 12).tolist())) <= self.degree:
            raise InputError(f"degree: {self.degree} needs more outputs that differ than this sensor has")

    @cached_property
    def polynomial(self) -> Polynomial:
        """The input as a polynomial of the output."""
        return Polynomial.fit(self.cycle.outputs, self.cycle.inputs, self.degree)

    @property
    def coefficients(self) -> Floats:
        """Coefficients of the powers of the output, from the constant on, (degree + 1,)."""
        return np.asarray(self.polynomial.convert().coef)

    def corrected(self, outputs: ArrayLike) -> Floats:
        """Return the inputs that outputs are taken for, any shape."""
        return np.asarray(self.polynomial(np.asarray(outputs, dtype=np.float64)))

    @cached_property
    def residuals(self) -> Floats:
        """Errors that are left at the inputs of the cycle, (2 points,)."""
        return np.asarray(self.corrected(self.cycle.outputs) - self.cycle.inputs)

    def checked(self, again: Cycle, drift: float = 0.0) -> Floats:
        """Return the errors at the inputs of another cycle, after the offset has drifted by a part of full scale."""
        return np.asarray(self.corrected(again.outputs + drift) - again.inputs)
