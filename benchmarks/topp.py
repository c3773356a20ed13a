"""The time-optimal law along random paths, against toppra on the same grid, and against one uniform scaling."""

import logging
import statistics
import time
from collections.abc import Callable, Iterator

import numpy as np

import peers
from armlab.kin.motion import Limits, Path, Trajectory, law_type, path_type, violations
from rounds import sized

TITLE = "Time-optimal laws: 100 random splines of 1 to 7 joints, limits of velocity and acceleration, 1000 steps"
PATHS, STEPS, DENSE = sized((100, 1000, 20_001), (2, 100, 201))


def measure() -> Iterator[str]:
    logging.disable(logging.WARNING)
    law, cases = law_type("time_optimal"), list(drawn(np.random.default_rng(16)))
    law.along(*cases[0][:2])
    ours, theirs, excess, over, scaled = [], [], [], 0, []
    seconds: dict[str, list[float]] = {"ours": [], "theirs": []}
    for path, limits, knots, places in cases:
        found = law.along(path, limits)
        ours.append(found.duration)
        works: dict[str, Callable[[], object]] = {"ours": lambda case=(path, limits): law.along(*case)}
        if peers.is_installed("toppra"):
            works["theirs"] = toppra_of(limits, knots, places)
            theirs.append(works["theirs"]())
        motion = Trajectory(path, found)
        over += len(violations(motion, limits))
        excess.append(worst(motion, limits))
        scaled.append(law_type("trapezoidal").along(path, limits).duration)
        for name, work in works.items():
            seconds[name].append(min(timed(work) for _ in range(3)))
    gain = np.array(scaled) / np.array(ours)
    yield "| | median | worst |"
    yield "| --- | --- | --- |"
    if theirs:
        ratio = np.array(ours) / np.array(theirs)
        yield f"| time of Armlab over time of toppra | {np.median(ratio):.5f} | {ratio.max():.5f} |"
        yield f"| the same, least | – | {ratio.min():.5f} |"
    yield f"| limit exceeded at {DENSE} samples, relative | {np.median(excess):.1e} | {max(excess):.1e} |"
    yield f"| trapezoid scaled uniformly over time of Armlab | {np.median(gain):.2f} | {gain.max():.2f} |"
    for title, key in (("Armlab, ms", "ours"), ("toppra 0.6 with seidel (compiled), ms", "theirs")):
        if not seconds[key]:
            continue
        yield f"| {title} | {1e3 * statistics.median(seconds[key]):.1f} | {1e3 * max(seconds[key]):.1f} |"
    yield ""
    yield f"Intervals in which a limit is exceeded, by exact peaks: {over} in {PATHS} motions."


def drawn(rng: np.random.Generator) -> Iterator[tuple[Path, Limits, np.ndarray, np.ndarray]]:
    """Yield paths and limits, and knots and their places for the peer."""
    for _ in range(PATHS):
        m, count = int(rng.integers(1, 8)), int(rng.integers(3, 12))
        knots, places = rng.normal(size=(count, m)), np.linspace(0.0, 1.0, count)
        path = path_type("spline").path(knots, ends="natural", times=places)
        yield path, Limits(rng.uniform(0.5, 3.0, m), rng.uniform(0.5, 6.0, m)), knots, places


def toppra_of(limits: Limits, knots: np.ndarray, places: np.ndarray) -> Callable[[], float]:
    """Return what works out the time of toppra: of both ends of each step, as ours, from rest to rest."""
    from toppra import SplineInterpolator
    from toppra.algorithm import TOPPRA
    from toppra.constraint import DiscretizationType, JointAccelerationConstraint, JointVelocityConstraint

    path = SplineInterpolator(places, knots, bc_type="natural")
    v, a = (np.stack([-each, each], axis=1) for each in (limits.velocity, limits.acceleration))
    grid = np.linspace(0.0, 1.0, STEPS + 1)

    def time_of() -> float:
        scheme = DiscretizationType.Interpolation
        held = [JointVelocityConstraint(v), JointAccelerationConstraint(a, discretization_scheme=scheme)]
        solver = TOPPRA(held, path, gridpoints=grid, solver_wrapper="seidel")
        _, speed, _ = solver.compute_parameterization(0, 0)
        return float(np.sum(2.0 * np.diff(grid) / (speed[1:] + speed[:-1])))

    return time_of


def worst(motion: Trajectory, limits: Limits) -> float:
    q_dot, q_ddot = motion.derivatives(np.linspace(0.0, motion.duration, DENSE), (1, 2))
    return max((np.abs(q_dot) / limits.velocity).max(), (np.abs(q_ddot) / limits.acceleration).max()) - 1.0


def timed(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start
