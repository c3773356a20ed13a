"""Forward kinematics, Jacobian and manipulability of a 7R arm (Franka Panda)."""

import tracemalloc
from collections.abc import Iterator
from functools import partial

import numpy as np

import armlab
import peers
from armlab import Arm
from armlab.kin.graph.scratch import KEPT
from rounds import header, medians, row, sized

TITLE = "Core: Franka Panda, one core"
MANY, BATCH, FEW, SHORT = sized((1_000_000, 100_000, 2_000, 1_000), (100, 100, 20, 10))


def measure() -> Iterator[str]:
    arm = armlab.load("panda")
    rng = np.random.default_rng(1)
    qs = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (MANY, arm.n))
    q = qs[0].copy()
    others, compiled = peers.of(arm), peers.numba_kernels(arm)
    with_jacobian = {name: peer for name, peer in others.items() if hasattr(peer, "jacobian")}
    agree(arm, qs[:20], others, compiled)
    yield from header()
    one = {"Armlab": lambda: arm.fk(q)} | {name: partial(peer.pose, q) for name, peer in others.items()}
    yield row("tool pose, one q", medians(one), "µs", 1e6)
    one = {"Armlab": lambda: arm.jacobian(q)} | {
        name: partial(peer.jacobian, q) for name, peer in with_jacobian.items()
    }
    yield row("geometric Jacobian, one q", medians(one), "µs", 1e6)
    out, few = np.empty((MANY, 3)), qs[:FEW]
    entries = {"Armlab": lambda: arm.position(qs, out=out)}
    if compiled is not None:
        entries["numba"] = lambda: compiled.positions(qs, out)
    loops = {"stacked NumPy": lambda: peers.stacked_positions(arm, few)}
    loops |= {name: partial(peer.positions, few) for name, peer in with_jacobian.items()}
    loops |= {"naive NumPy": lambda: peers.naive_positions(arm, few)}
    found = medians(entries, MANY, 7) | medians(loops, FEW, 5)
    yield row("tool positions, 10⁶ q, float64", found, "ns each", 1e9, 0)
    singles, out32 = qs.astype(np.float32), np.empty((MANY, 3), np.float32)
    found = medians({"Armlab": lambda: arm.position(singles, out=out32)}, MANY, 7)
    yield row("the same, float32", found, "ns each", 1e9, 0)
    w = np.empty(MANY)
    entries = {"Armlab": lambda: arm.manipulability(qs, out=w)}
    if compiled is not None:
        entries["numba"] = lambda: compiled.manipulability(qs, w)
    loops = {
        name: lambda peer=peer: [_w(peer.jacobian(v)) for v in few]
        for name, peer in with_jacobian.items()
        if name == peers.PINOCCHIO
    }
    found = medians(entries, MANY, 5) | medians(loops, FEW, 5)
    yield row("manipulability, 10⁶ q, float64", found, "ns each", 1e9, 0)
    many, short = qs[:BATCH], qs[:SHORT]
    entries = {"Armlab": lambda: arm.frames(many)}
    if compiled is not None:
        entries["numba"] = lambda: compiled.frames(many, np.empty((BATCH, arm.n + 1, 4, 4)))
    yield row("all frames, 10⁵ q, fresh memory", medians(entries, BATCH, 15), "ns each", 1e9, 0)
    entries = {"Armlab": lambda: arm.jacobian(short)}
    if compiled is not None:
        entries["numba"] = lambda: compiled.jacobians(short, np.empty((SHORT, 6, arm.n)))
    yield row("geometric Jacobians, 1000 q, fresh memory", medians(entries, SHORT, 15), "ns each", 1e9, 0)
    # What earlier calls have kept is taken away, so that this one needs what the first of all does.
    kept = KEPT.take(1)
    tracemalloc.start()
    arm.position(qs, out=out)
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    KEPT.give_back(kept)
    yield f"| memory over the output, 10⁶ positions | {peak:.0f} MiB | – |"


def _w(J: np.ndarray) -> float:
    return float(np.sqrt(np.linalg.det(J @ J.T)))


def agree(arm: Arm, qs: np.ndarray, others: dict, compiled: peers.Compiled | None) -> None:
    """Check that all compute the same, so that the times are of the same work."""
    p, w = arm.position(qs), arm.manipulability(qs)
    np.testing.assert_allclose(peers.naive_positions(arm, qs), p, atol=1e-9)
    np.testing.assert_allclose(peers.stacked_positions(arm, qs), p, atol=1e-9)
    if compiled is not None:
        for loop, expected in (
            (compiled.positions, p),
            (compiled.manipulability, w),
            (compiled.frames, arm.frames(qs)),
            (compiled.jacobians, arm.jacobian(qs)),
        ):
            found = np.empty(expected.shape)
            loop(qs, found)
            np.testing.assert_allclose(found, expected, atol=1e-9)
    for peer in others.values():
        for q in qs:
            pose = peer.pose(q)
            np.testing.assert_allclose(np.squeeze(getattr(pose, "homogeneous", pose)), arm.fk(q), atol=1e-9)
            if hasattr(peer, "jacobian"):
                np.testing.assert_allclose(peer.jacobian(q), arm.jacobian(q), atol=1e-9)
