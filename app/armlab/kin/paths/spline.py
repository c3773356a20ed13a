"""The cubic spline through timed waypoints: continuous up to the acceleration, with little oscillation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import PolynomialPath, timed
from armlab.kin.motion.path_types import PathType, coordinates
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths._spline_system import SplineSystem, clamped_system, cubics, natural_system

Floats = NDArray[np.float64]

VELOCITIES, ACCELERATIONS, BOTH = (
    (("ends", kinds),) for kinds in (("clamped", "both"), ("natural", "both"), ("both",))
)
"""Conditions for options at the ends: the kinds of ends with which each can be given."""


class Spline(PolynomialPath):
    """A cubic spline, with the system it comes from.

    Attributes
    ----------
    system : SplineSystem
        Tridiagonal matrix and right side (notes 6.93-6.95), time in seconds.
    times : ndarray, shape (K,)
        Times of all knots, virtual ones included.
    positions, velocities : ndarray, shape (K, m)
        Positions and velocities at these times.
    virtual : tuple of int
        Numbers (from 1) of the virtual knots among them.
    """

    def __init__(
        self, times: Floats, positions: Floats, velocities: Floats, system: SplineSystem, virtual: tuple[int, ...]
    ) -> None:
        path = timed(Piecewise(times, cubics(np.diff(times), positions, velocities)))
        super().__init__(path.curve, path.duration)
        self.times, self.positions, self.velocities = times, positions, velocities
        self.system, self.virtual = system, virtual

    @property
    def equations(self) -> int:
        """Number of conditions, which is that of the coefficients: 4 for each cubic."""
        return 4 * (len(self.times) - 1)


def make(knots: Floats, options: dict[str, Any]) -> Spline:
    """Return the spline.

    Among all curves with continuous second derivative through the waypoints, with these end velocities (or with free
    ones, natural), it has the smallest integral of the squared acceleration.

    References
    ----------
    Notes, section 6.2.2; errata in `armlab.kin.paths._spline_system`. "Minimum curvature" there means that integral.
    """
    times = knot_times(knots, options)
    m = knots.shape[1]
    v_start, v_end, a_start, a_end = (
        coordinates(options[key], key, m) for key in ("v_start", "v_end", "a_start", "a_end")
    )
    ends: str = options["ends"]
    _refuse_unused(options, ends)
    if ends == "natural":
        system = natural_system(np.diff(times), knots, a_start, a_end)
        return Spline(times, knots, system.solve(), system, ())
    if ends == "clamped":
        system = clamped_system(np.diff(times), knots, v_start, v_end)
        return Spline(times, knots, np.concatenate([v_start[None], system.solve(), v_end[None]]), system, ())
    return _with_virtual_knots(times, knots, (v_start, v_end), (a_start, a_end), options["virtual"])


def _refuse_unused(options: dict[str, Any], ends: str) -> None:
    """Raise `InputError` when something is given that this kind of ends cannot satisfy."""
    for field in PATH.fields:
        given_up = field.only and field.only[0][0] == "ends" and not field.usable(options)
        if given_up and options[field.key] is not None:
            given = {"clamped": "velocities", "natural": "accelerations"}[ends]
            instead = {"v": "velocities, or both", "a": "accelerations, or both"}.get(field.symbol[0], "both")
            raise InputError(
                f"{field.key}: cannot be used while {given} are given at both ends of the spline; choose {instead}"
            )


def _with_virtual_knots(
    times: Floats, knots: Floats, v: tuple[Floats, Floats], a: tuple[Floats, Floats], given: Floats | None
) -> Spline:
    """Return the spline with end velocities and accelerations: two knots more, whose positions are found.

    The accelerations at the ends depend linearly on the two positions: the spline is solved for none and for each of
    them alone, and two equations for each coordinate remain (notes 6.98-6.99; in 6.98 read t_1 and t_N).
    """
    extra = _virtual_times(times, given)
    moments = np.concatenate([times[:1], extra[:1], times[1:-1], extra[1:], times[-1:]])
    h, m, count = np.diff(moments), knots.shape[1], len(moments)
    # Columns: the m coordinates with the virtual positions at zero, then a unit at each virtual knot alone.
    q = np.zeros((count, m + 2))
    q[[0, *range(2, count - 2), count - 1], :m] = knots
    q[1, m] = q[count - 2, m + 1] = 1.0
    ends = [np.concatenate([value, [0.0, 0.0]]) for value in v]
    rates = np.concatenate([ends[0][None], clamped_system(h, q, *ends).solve(), ends[1][None]])
    bends = np.stack([_end_acceleration(h[0], q[:2], rates[:2], 0), _end_acceleration(h[-1], q[-2:], rates[-2:], 1)])
    found = np.linalg.solve(bends[:, m:], np.stack(a) - bends[:, :m])
    positions = q[:, :m].copy()
    positions[[1, count - 2]] = found
    velocities = rates[:, :m] + rates[:, m:] @ found
    system = clamped_system(h, positions, *v)
    return Spline(moments, positions, velocities, system, (2, count - 1))


def _end_acceleration(h: float, q: Floats, v: Floats, end: int) -> Floats:
    """Return the acceleration at an end of the first or last cubic, from positions and velocities at both its ends."""
    bend = (6.0 * (q[1] - q[0]) / h - 4.0 * v[0] - 2.0 * v[1]) / h
    return np.asarray(bend if end == 0 else (-6.0 * (q[1] - q[0]) / h + 2.0 * v[0] + 4.0 * v[1]) / h)


def _virtual_times(times: Floats, given: Floats | None) -> Floats:
    if given is None:
        part = 1.0 / 3.0 if len(times) == 2 else 0.5
        first, last = times[1] - times[0], times[-1] - times[-2]
        return np.array([times[0] + part * first, times[-1] - part * last])
    inside = given.shape == (2,) and times[0] < given[0] < times[1] and times[-2] < given[1] < times[-1]
    if not inside or not given[0] < given[1]:
        raise InputError(
            f"virtual: expected one time inside the first interval ({times[0]:g} to {times[1]:g} s) and one inside the "
            f"last ({times[-2]:g} to {times[-1]:g} s), got {' and '.join(f'{t:.6g} s' for t in given)}"
        )
    return given


PATH = PathType(
    "spline",
    "Cubic spline",
    10,
    make,
    fields=(
        Field(
            "ends",
            "",
            "given at both ends",
            "choice",
            "clamped",
            choices=(
                ("clamped", "velocities (zero: rest)"),
                ("natural", "accelerations (zero: natural spline)"),
                ("both", "velocities and accelerations, with two virtual knots"),
            ),
        ),
        Field("v_start", "v_1", "velocity at the start", "vector", unit="q/s", only=VELOCITIES),
        Field("v_end", "v_N", "velocity at the end", "vector", unit="q/s", only=VELOCITIES),
        Field("a_start", "a_1", "acceleration at the start", "vector", unit="q/s²", only=ACCELERATIONS),
        Field("a_end", "a_N", "acceleration at the end", "vector", unit="q/s²", only=ACCELERATIONS),
        Field(
            "virtual", "t_a, t_b", "times of the virtual knots; left out: in the middle", "list", unit="s", only=BOTH
        ),
        *TIMES,
    ),
    apart=False,
    formula=r"X_j(s)=\sum_{k=0}^{3}a_{jk}(s-s_j)^k",
    says="A cubic from each knot to the next, with equal velocities and accelerations where two meet.",
)
