"""A curve through timed knots of one coordinate: its motion, and measures of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.knots import Knot
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.breaks import ORDERS
from armlab.kin.motion.extremes import exceeding, extremes_of_series
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType, path_type, path_types
from armlab.kin.motion.peaks import QUANTITIES, Violation
from armlab.kin.motion.series import COUNT, Series, series_of
from armlab.kin.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

FROM_KNOTS = ("times", "duration", "spacing")
"""Options of a path that are replaced by the times of the knots."""

VIRTUAL = "virtual"
"""Option of a path for the times of its virtual knots."""

CONSTANT = Chosen("constant")

LEAST_CUTS, MOST_CUTS = 2, 24
"""Least and largest number of cuts of a piece that is no polynomial of low degree."""

CUTS = 8
"""Number of cuts of all pieces together if they are no polynomials."""

CUT_DEGREE = 10
"""Degree of a polynomial of high degree for each cut."""

LARGEST = 1e15
"""Largest absolute value of a derivative; beyond it digits are lost."""


def kinds() -> dict[str, PathType]:
    """Return the kinds of paths that can be used for joints."""
    return {key: kind for key, kind in path_types().items() if "joint" in kind.spaces}


def free_options(kind: PathType) -> tuple[Field, ...]:
    """Return the options of a kind that remain to be chosen when the knots have times."""
    return tuple(replace(field, title=in_knots(field.title)) for field in kind.fields if field.key not in FROM_KNOTS)


def why_not(kind: PathType, knots: tuple[Knot, ...]) -> str:
    """Return in a few words why a kind cannot go through these knots; empty if it can."""
    if kind.dimensions and 1 not in kind.dimensions:
        return "needs several coordinates"
    count = len(knots)
    if count < kind.least or (kind.most is not None and count > kind.most):
        if kind.most == kind.least:
            return f"exactly {kind.least} knots"
        return f"at least {kind.least} knots" if count < kind.least else f"at most {kind.most} knots"
    still = [k for k in range(1, count) if knots[k][1] == knots[k - 1][1]]
    return f"knot {still[0] + 1} does not move" if kind.apart and still else ""


def path_through(knots: tuple[Knot, ...], chosen: Chosen) -> Path:
    """Return the path of a kind through knots; `InputError` if there is none."""
    kind = path_type(chosen.key)
    times, keys = [t for t, _ in knots], {field.key for field in kind.fields}
    options = chosen.options
    if "times" in keys:
        options["times"] = times
    elif "duration" in keys:
        options["duration"] = times[-1] - times[0]
    return kind.path([[q] for _, q in knots], **options)


@dataclass(frozen=True)
class Drawn:
    """The settings of one curve.

    Attributes
    ----------
    colour : int
        0 to 2.
    path : Chosen
        Kind of path, by `armlab.kin.motion.path_types`.
    law : Chosen
        Timing law by which s goes from 0 to 1; with the constant one timed paths meet the knots at their times.
    dropped : bool
        Whether its virtual times did not fit other knots and were left out; not written down.
    """

    colour: int
    path: Chosen
    law: Chosen = CONSTANT
    dropped: bool = False


@dataclass(frozen=True, eq=False)
class Made:
    """A computed curve.

    Attributes
    ----------
    drawn : Drawn
    knots : tuple of (float, float)
    trajectory : Trajectory
        Of one coordinate, over the time since the first knot.
    """

    drawn: Drawn
    knots: tuple[Knot, ...]
    trajectory: Trajectory

    @property
    def title(self) -> str:
        """The name of the path, and of the law if it is not the constant one."""
        law = self.drawn.law.key
        after = "" if law == "constant" else f", {law_type(law).title.lower()} law"
        return f"{path_type(self.drawn.path.key).title}{after}"

    @property
    def start(self) -> float:
        """The time of the first knot, seconds."""
        return self.knots[0][0]

    def at(self, t: Floats) -> list[Floats]:
        """Return q and its first three derivatives at times, each (N,)."""
        return [values[:, 0] for values in self.trajectory.derivatives(t - self.start)]

    @cached_property
    def series(self) -> tuple[Series, ...]:
        """Position and derivatives 1 to 3 as Chebyshev series over the time since the first knot."""
        return tuple(_series(self.trajectory, order) for order in ORDERS)

    @cached_property
    def peaks(self) -> tuple[float, float, float]:
        """The largest absolute values of q', q'' and q''' (between its jumps), exact."""
        first, second, third = (float(extremes_of_series(each).peak[0]) for each in self.series[1:])
        return first, second, third

    def largest(self, order: int) -> float:
        """Return the largest absolute value of a derivative of order 1 to 3; infinite where the one below it jumps."""
        return math.inf if self.trajectory.continuity < order - 1 else self.peaks[order - 1]

    @cached_property
    def overshoot(self) -> float:
        """The largest distance of the curve beyond the range of the knots (notes, figure 6.1: wandering)."""
        found, values = extremes_of_series(self.series[0]), [q for _, q in self.knots]
        beyond = max(float(found.highest[0]) - max(values), min(values) - float(found.lowest[0]))
        # What is rounding at the ends of the range is none.
        return beyond if beyond > 1e-9 * max(max(values) - min(values), 1e-9) else 0.0

    @cached_property
    def bending(self) -> float:
        """The integral of q'' squared over time, which is least for a natural spline (notes, end of 6.2.2).

        It is infinite where the velocity jumps.
        """
        if math.isinf(self.largest(2)):
            return math.inf
        series = self.series[2]
        nodes, weights = np.polynomial.legendre.leggauss(series.coefficients.shape[1])
        values = np.polynomial.chebyshev.chebval(nodes, np.moveaxis(series.coefficients[:, :, 0], 1, 0))
        return float(0.5 * np.diff(series.edges, axis=1)[:, 0] @ (values**2 @ weights))

    def missed(self) -> float:
        """Return the largest distance of the curve from a knot at its time."""
        t, q = np.array(self.knots).T
        return float(np.abs(self.at(t)[0] - q).max())

    def beyond(self, v_max: float | None, a_max: float | None) -> list[Violation]:
        """Return when limits are exceeded, that of acceleration also at jumps; times count from the first knot."""
        found = []
        for order, limit in ((1, v_max), (2, a_max)):
            if limit is not None:
                (intervals,) = exceeding(self.series[order], np.array([limit]))
                found += [Violation(1, QUANTITIES[order], start, end) for start, end in intervals]
        if a_max is not None:
            inside = [time for _, time in self.trajectory.jumps(1) if 0.0 < time < self.trajectory.duration]
            over = [time for time in inside if not any(each.start <= time <= each.end for each in found)]
            found += [Violation(1, "acceleration", time, time) for time in over]
        return found


def _series(trajectory: Trajectory, order: int) -> Series:
    """Return a derivative as series of few terms.

    They are exact for a polynomial of low degree. Otherwise each piece, in which the motion is smooth, is cut into so
    many that terms of degree `COUNT` - 1 resolve it: halving until rounding is reached, as the core does, takes seconds
    where short intervals follow long ones, because their derivatives carry more rounding than it waits for.
    """
    degree, edges = trajectory.degree, trajectory.edges
    most = COUNT - 1
    if degree is None or degree - order > most:
        wanted = CUTS // (len(edges) - 1) if degree is None else degree // CUT_DEGREE
        cuts = min(max(wanted, LEAST_CUTS), MOST_CUTS)
        shares = np.arange(cuts) / cuts
        edges = np.append((edges[:-1, None] + np.diff(edges)[:, None] * shares).ravel(), edges[-1])
        degree = most + order
    return series_of(lambda t: trajectory.at(t, order), edges, max(degree - order, 0))


def made(knots: tuple[Knot, ...], drawn: Drawn) -> Made:
    """Return the curve through knots.

    Raises
    ------
    InputError
        The kind does not take these knots or options, or the law leaves the path; the text names knot or option.
    """
    try:
        with np.errstate(all="ignore"):
            path = path_through(knots, drawn.path)
            law = law_type(drawn.law.key).law(knots[-1][0] - knots[0][0], **drawn.law.options)
            found = Made(drawn, knots, Trajectory(path, law))
            sizes = [float(np.abs(values).max()) for values in found.at(grid(knots))]
    except InputError as refusal:
        raise InputError(in_knots(str(refusal))) from None
    except np.linalg.LinAlgError:
        raise InputError("the equations of this curve have no single solution") from None
    if not all(size < LARGEST for size in sizes):
        raise InputError("options: with these numbers a derivative of the curve becomes larger than 10¹⁵")
    return found


def fitted(knots: tuple[Knot, ...], drawn: Drawn) -> Drawn:
    """Return a curve for other knots, without times of virtual knots that are not in the right interval."""
    kind = kinds()[drawn.path.key]
    if VIRTUAL not in drawn.path.options:
        return drawn
    without = replace(drawn, path=drawn.path.with_option(kind, VIRTUAL, None), dropped=True)
    # Where these knots give no curve at all, the times are not to blame.
    return without if _refused(knots, drawn) and not _refused(knots, without) else drawn


def _refused(knots: tuple[Knot, ...], drawn: Drawn) -> bool:
    try:
        path_through(knots, drawn.path)
    except InputError:
        return True
    return False


def grid(knots: tuple[Knot, ...], count: int = 400) -> Floats:
    """Return the times at which a curve is drawn: evenly spaced ones, and those of the knots."""
    times = np.array([t for t, _ in knots])
    return np.union1d(np.linspace(times[0], times[-1], count), times)


def in_knots(text: str) -> str:
    """Return a text of the core with its waypoints called knots."""
    return text.replace("Waypoint", "Knot").replace("waypoint", "knot")
