"""Sampling motions of 7 joints, and inverse kinematics along a line."""

from collections.abc import Callable, Iterator

import numpy as np
from scipy.interpolate import CubicSpline

import armlab
import peers
from armlab.kin.motion.follow import follow
from armlab.kin.motion.geometry import ByLength
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.minimum_time import minimum_time_spline
from armlab.kin.motion.orientation import about_one_axis
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.tool_path import ToolPath
from armlab.kin.motion.trajectory import Trajectory
from rounds import header, medians, row, sized

TITLE = "Motion: 10 000 samples of q, qdot, qddot of 7 joints, and a line with inverse kinematics, one core"
SAMPLES, KNOTS, JOINTS = sized(10_000, 100), 10, 7
MANY_KNOTS = sized(10_000, 100)
DURATION = 4.0
ORDERS = (0, 1, 2)


def measure() -> Iterator[str]:
    rng = np.random.default_rng(1)
    knots = rng.normal(size=(KNOTS, JOINTS))
    t = np.linspace(0.0, DURATION, SAMPLES)
    yield from header()
    yield row("quintic, sampled", medians(quintic(knots, t)), "ms", 1e3, 2)
    yield row(
        "the same, made and sampled",
        medians({"Armlab": lambda: line(knots, "quintic").derivatives(t, ORDERS)}),
        "ms",
        1e3,
        2,
    )
    yield row("trapezoid of speed, sampled", medians(trapezoid(knots, t)), "ms", 1e3, 2)
    yield row(f"cubic spline through {KNOTS} waypoints, made and sampled", medians(spline(knots, t)), "ms", 1e3, 2)
    many = rng.normal(size=(MANY_KNOTS, JOINTS))
    yield row(
        "cubic spline through 10 000 waypoints, made and sampled", medians(spline(many, t), rounds=5), "ms", 1e3, 1
    )
    yield row("exact peaks of velocity, spline with quintic law", medians(exact(knots), rounds=7), "ms", 1e3, 1)
    yield row("helix by its length, 10 000 samples", medians(by_length(t), rounds=7), "ms", 1e3, 1)
    yield row("line with inverse kinematics, 1000 samples, PUMA 560", medians(followed(), rounds=9), "ms", 1e3, 1)
    yield row("intervals of least time, 7 waypoints", medians(least_time(knots), rounds=3), "ms", 1e3, 0)


def line(knots: np.ndarray, law: str) -> Trajectory:
    return Trajectory(path_type("line").path(knots[:2]), law_type(law).law(DURATION))


def quintic(knots: np.ndarray, t: np.ndarray) -> dict[str, Callable[[], object]]:
    ours = line(knots, "quintic")
    entries: dict[str, Callable[[], object]] = {"Armlab": lambda: ours.derivatives(t, ORDERS)}
    if not peers.is_installed("roboticstoolbox"):
        return entries
    from roboticstoolbox import jtraj

    peer = jtraj(knots[0], knots[1], t)
    for order, values in zip(ORDERS, (peer.q, peer.qd, peer.qdd), strict=True):
        np.testing.assert_allclose(ours.at(t, order), values, rtol=0, atol=1e-9)
    return entries | {"roboticstoolbox jtraj": lambda: jtraj(knots[0], knots[1], t)}


def trapezoid(knots: np.ndarray, t: np.ndarray) -> dict[str, Callable[[], object]]:
    ours = line(knots, "trapezoidal")
    entries: dict[str, Callable[[], object]] = {"Armlab": lambda: ours.derivatives(t, ORDERS)}
    if not peers.is_installed("roboticstoolbox"):
        return entries
    from roboticstoolbox import mstraj, mtraj, trapezoidal

    peer = mtraj(trapezoidal, knots[0], knots[1], SAMPLES)
    np.testing.assert_allclose(peer.q[[0, -1]], ours.at(t)[[0, -1]], rtol=0, atol=1e-6)
    step = DURATION / SAMPLES
    return entries | {
        "roboticstoolbox mtraj": lambda: mtraj(trapezoidal, knots[0], knots[1], SAMPLES),
        "roboticstoolbox mstraj": lambda: mstraj(knots[:2], step, DURATION / 3, tsegment=[DURATION]),
    }


def spline(knots: np.ndarray, t: np.ndarray) -> dict[str, Callable[[], object]]:
    kind, law = path_type("spline"), law_type("constant").law(DURATION)
    times = np.linspace(0.0, DURATION, len(knots))

    def ours() -> list[np.ndarray]:
        return Trajectory(kind.path(knots, times=times), law).derivatives(t, ORDERS)

    def scipy() -> list[np.ndarray]:
        found = CubicSpline(times, knots, bc_type="clamped")
        return [found(t, order) for order in ORDERS]

    for mine, theirs in zip(ours(), scipy(), strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())
    return {"Armlab": ours, "scipy CubicSpline": scipy}


def exact(knots: np.ndarray) -> dict[str, Callable[[], object]]:
    path, law = path_type("spline").path(knots), law_type("quintic").law(DURATION)
    dense = np.linspace(0.0, DURATION, 100 * SAMPLES)
    sampled = Trajectory(path, law)
    np.testing.assert_allclose(peaks(sampled, 1).peak, np.abs(sampled.at(dense, 1)).max(axis=0), rtol=1e-6)
    return {
        "Armlab": lambda: peaks(Trajectory(path, law), 1),
        "10 000 samples (not exact)": lambda: np.abs(sampled.at(dense[::100], 1)).max(axis=0),
    }


def by_length(t: np.ndarray) -> dict[str, Callable[[], object]]:
    path = ByLength(path_type("helix").path([[0, 0, 0], [0, 0, 1]]))
    return {"Armlab": lambda: path.derivatives(t / DURATION, ORDERS)}


def followed() -> dict[str, Callable[[], object]]:
    arm = armlab.load("puma560")
    q = np.array([0.3, -0.6, 0.5, 0.4, 0.7, 0.2])
    start, end = arm.fk(q), arm.fk([0.7, -0.4, 0.6, 0.9, 1.1, -0.3])
    position = path_type("line").path([start[:3, 3], end[:3, 3]])
    tool_path = ToolPath(position, about_one_axis(start[:3, :3], end[:3, :3]))
    found = follow(arm, tool_path, q)
    np.testing.assert_allclose(arm.fk(found.q), tool_path.pose(found.s), rtol=0, atol=1e-9)
    poses = tool_path.pose(found.s)

    def one_by_one() -> None:
        near = q
        for T in poses:
            near = armlab.ik.solve(arm, T, near).q

    return {"Armlab": lambda: follow(arm, tool_path, q), "Armlab ik.solve, pose by pose": one_by_one}


def least_time(knots: np.ndarray) -> dict[str, Callable[[], object]]:
    return {"Armlab": lambda: minimum_time_spline(knots[:7], Limits(2.0, 5.0))}
