"""One inverse-kinematics solution where no start is given, inside the limits."""

import time
from collections.abc import Callable, Iterator

import numpy as np

import armlab
import peers
from armlab.kin import ik
from rounds import sized

TITLE = "Inverse kinematics: one solution, 1000 random poses, error below 1e-6 m and rad, inside the limits"
ARMS = ("puma560", "ur10e", "panda", "iiwa7")
POSES, POSES_OF_A_LOOP = sized((1000, 100), (4, 1))
STRIDES = {peers.TOOLBOX: 1, peers.PINOCCHIO: POSES // POSES_OF_A_LOOP}
"""Who solves, and every how many poses; the loop of pinocchio runs in Python."""


def measure() -> Iterator[str]:
    yield "| arm | solver | solved | median | p99 | median × Armlab |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for key in ARMS:
        arm = armlab.load(key)
        solvers: dict[str, tuple[int, Callable]] = {
            "Armlab": (1, lambda T, k, rng, arm=arm: ik.solve(arm, T, seed=k).q)
        }
        for name, peer in peers.of(arm).items():
            if stride := STRIDES.get(name):
                solvers[name] = (stride, lambda T, k, rng, peer=peer: peer.solve(T, rng))
        first = 0.0
        for name, (seconds, solved, count) in compare(arm, solvers).items():
            first = first or float(np.median(seconds))
            median, slow = np.median(seconds), np.quantile(seconds, 0.99)
            share = f"{100 * solved / count:.1f} %"
            times = f"{median * 1e3:.3f} ms | {slow * 1e3:.1f} ms | {median / first:.1f}"
            yield f"| {arm.name} | {name} | {share} | {times} |"


def compare(arm, solvers):
    """Give every pose to all solvers in turn; those with a stride get only some of the poses."""
    rng = np.random.default_rng(1)
    found = {name: ([], 0, 0) for name in solvers}
    for k in range(POSES):
        T = arm.fk(rng.uniform(arm.limits[:, 0], arm.limits[:, 1]))
        for name, (stride, solve) in solvers.items():
            if k % stride:
                continue
            seconds, solved, count = found[name]
            draws = np.random.default_rng(k)  # made before the clock starts: peers only draw from it
            start = time.process_time()
            q = solve(T, k, draws)
            seconds.append(time.process_time() - start)
            found[name] = (seconds, solved + reaches(arm, q, T), count + 1)
    return found


def reaches(arm, q, T) -> bool:
    """Judge all solvers alike."""
    E = arm.fk(q)
    angle = np.linalg.norm(E[:3, :3] - T[:3, :3]) / np.sqrt(2.0)
    return bool(np.linalg.norm(E[:3, 3] - T[:3, 3]) < 1e-6 and angle < 1e-6 and arm.within_limits(q))
