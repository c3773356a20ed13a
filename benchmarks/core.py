"""Forward kinematics, Jacobian and manipulability of a 7R arm (Franka Panda)."""

import tracemalloc
from collections.abc import Iterator

import numpy as np

import armlab
import peers
from rounds import header, medians, row

TITLE = "Core: Franka Panda, one core"
MANY, BATCH, FEW, SHORT = 1_000_000, 100_000, 2_000, 1_000


def measure() -> Iterator[str]:
    arm = armlab.load("panda")
    rng = np.random.default_rng(1)
    qs = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (MANY, arm.n))
    q = qs[0].copy()
    pinocchio, toolbox, ikpy = peers.Pinocchio(arm), peers.Toolbox(arm), peers.IKPy(arm)
    compiled = peers.numba_kernels(arm)
    positions, manipulability = compiled.positions, compiled.manipulability
    agree(arm, qs[:20], pinocchio, toolbox, ikpy, compiled)
    yield from header()
    one = {
        "Armlab": lambda: arm.fk(q),
        "pinocchio": lambda: pinocchio.pose(q),
        "roboticstoolbox (C)": lambda: toolbox.pose(q),
        "ikpy": lambda: ikpy.pose(q),
    }
    yield row("tool pose, one q", medians(one), "µs", 1e6)
    one = {
        "Armlab": lambda: arm.jacobian(q),
        "pinocchio": lambda: pinocchio.jacobian(q),
        "roboticstoolbox (C)": lambda: toolbox.jacobian(q),
    }
    yield row("geometric Jacobian, one q", medians(one), "µs", 1e6)
    out, few = np.empty((MANY, 3)), qs[:FEW]
    found = medians({"Armlab": lambda: arm.position(qs, out=out), "numba": lambda: positions(qs, out)}, MANY, 7)
    loops = {
        "stacked NumPy": lambda: peers.stacked_positions(arm, few),
        "pinocchio": lambda: [pinocchio.pose(v).translation for v in few],
        "roboticstoolbox (C)": lambda: toolbox.pose(few),
        "naive NumPy": lambda: peers.naive_positions(arm, few),
    }
    yield row("tool positions, 10⁶ q, float64", found | medians(loops, FEW, 5), "ns each", 1e9, 0)
    singles, out32 = qs.astype(np.float32), np.empty((MANY, 3), np.float32)
    yield row(
        "the same, float32", medians({"Armlab": lambda: arm.position(singles, out=out32)}, MANY, 7), "ns each", 1e9, 0
    )
    w = np.empty(MANY)
    found = medians({"Armlab": lambda: arm.manipulability(qs, out=w), "numba": lambda: manipulability(qs, w)}, MANY, 5)
    loops = {"pinocchio": lambda: [_w(pinocchio.jacobian(v)) for v in few]}
    yield row("manipulability, 10⁶ q, float64", found | medians(loops, FEW, 5), "ns each", 1e9, 0)
    many = qs[:BATCH]
    loops = {
        "Armlab": lambda: arm.frames(many),
        "numba": lambda: compiled.frames(many, np.empty((BATCH, arm.n + 1, 4, 4))),
    }
    yield row("all frames, 10⁵ q, fresh memory", medians(loops, BATCH, 15), "ns each", 1e9, 0)
    few = qs[:SHORT]
    loops = {
        "Armlab": lambda: arm.jacobian(few),
        "numba": lambda: compiled.jacobians(few, np.empty((SHORT, 6, arm.n))),
    }
    yield row("geometric Jacobians, 1000 q, fresh memory", medians(loops, SHORT, 15), "ns each", 1e9, 0)
    tracemalloc.start()
    arm.position(qs, out=out)
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    yield f"| memory over the output, 10⁶ positions | {peak:.0f} MiB | – |"


def _w(J: np.ndarray) -> float:
    return float(np.sqrt(np.linalg.det(J @ J.T)))


def agree(arm, qs, pinocchio, toolbox, ikpy, compiled) -> None:
    """Check that all compute the same, so that the times are of the same work."""
    p, w = np.empty((len(qs), 3)), np.empty(len(qs))
    frames, J = np.empty((len(qs), arm.n + 1, 4, 4)), np.empty((len(qs), 6, arm.n))
    compiled.positions(qs, p)
    compiled.manipulability(qs, w)
    compiled.frames(qs, frames)
    compiled.jacobians(qs, J)
    np.testing.assert_allclose(frames, arm.frames(qs), atol=1e-9)
    np.testing.assert_allclose(J, arm.jacobian(qs), atol=1e-9)
    np.testing.assert_allclose(p, arm.position(qs), atol=1e-9)
    np.testing.assert_allclose(w, arm.manipulability(qs), atol=1e-9)
    np.testing.assert_allclose(peers.naive_positions(arm, qs), p, atol=1e-9)
    np.testing.assert_allclose(peers.stacked_positions(arm, qs), p, atol=1e-9)
    for q in qs:
        T = arm.fk(q)
        np.testing.assert_allclose(pinocchio.pose(q).homogeneous, T, atol=1e-9)
        np.testing.assert_allclose(np.squeeze(toolbox.pose(q)), T, atol=1e-9)
        np.testing.assert_allclose(ikpy.pose(q), T, atol=1e-9)
        np.testing.assert_allclose(pinocchio.jacobian(q), arm.jacobian(q), atol=1e-9)
        np.testing.assert_allclose(toolbox.jacobian(q), arm.jacobian(q), atol=1e-9)
