"""The reachable workspace: random configurations, their tool points and manipulability, counted in 64³ voxels."""

import time
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

import armlab
import peers
from armlab import Arm
from armlab.kin.convert import converted
from armlab.kin.workspace.cloud import samples
from armlab.kin.workspace.section_size import Size, size
from armlab.kin.workspace.sections import sections
from armlab.kin.workspace.spherical_wrist import coverage
from armlab.kin.workspace.voxels import Voxels, voxels_for
from rounds import header, medians, row, sized

TITLE = "Workspace: 10⁶ samples with manipulability into 64³ voxels, one core"
MANY, SOME, FEW, FEWEST = sized((1_000_000, 20_000, 2_000, 100), (100, 50, 4, 2))
RESOLUTION, SEED = 64, 1
CELLS, PLACES = sized((256, 96), (32, 12))
"""Cells of the section along its longer side, and of the coverage along each."""

ROBOTS = {"puma560": "6R, PUMA 560", "panda": "7R, Franka Panda"}


Sample = Callable[[np.ndarray], tuple[np.ndarray, float]]


def measure() -> Iterator[str]:
    yield from header()
    for name, title in ROBOTS.items():
        yield row(title, against(armlab.load(name)), "s", MANY, 2)
    planar = armlab.load("planar_3r")
    yield row("planar 3R", medians({"Armlab": lambda: ours(planar, MANY)}, rounds=7), "s", 1.0, 2)
    arm = armlab.load("puma560")
    yield row("6R, 10⁷ samples", medians({"Armlab": lambda: ours(arm, 10 * MANY)}, rounds=3), "s", 1.0, 2)
    held = [memory(arm, count) for count in (MANY, 10 * MANY)]
    yield f"| memory held at once, 6R, 10⁶ and 10⁷ samples | {held[0]:.0f} and {held[1]:.0f} MiB | – |"
    for key, title in (("sigma_min", "smallest singular value"), ("inverse_condition", "inverse condition")):
        found = medians({"Armlab": lambda key=key: ours(arm, SOME, key)}, SOME, 5)
        yield row(f"6R, coloured by {title}", found, "s", MANY, 2)
    yield row(
        "6R, section with volume and error, 256 cells", medians({"Armlab": lambda: followed(arm)}, rounds=3), "s", 1, 2
    )
    found = medians({"Armlab": lambda: coverage(replace(arm), PLACES)}, rounds=3)
    yield row("6R with a spherical wrist, coverage by approach directions, 96³", found, "s", 1, 2)
    yield f"| first 4096 samples of a table that was just edited, 6R | {1e3 * first(arm):.0f} ms | – |"


def ours(arm: Arm, count: int, key: str = "manipulability") -> Voxels:
    """Return the voxels after so many samples."""
    grid = voxels_for(arm, RESOLUTION)
    for piece in samples(arm, count, SEED, key):
        grid.add(piece.points, piece.values)
    return grid


def followed(arm: Arm) -> Size:
    """Return the volume from the section of an arm of which none is known yet."""
    *_, last = sections(replace(arm), CELLS)
    return size(last)


def against(arm: Arm) -> dict[str, float]:
    """Return seconds for one sample of ours and of the others, each with as many samples as it can do in a while."""
    written = converted(arm, "modified")
    kernels = peers.numba_kernels(written)
    toolboxes: dict[str, Sample] = {}
    if peers.is_installed("roboticstoolbox"):
        toolboxes["roboticstoolbox (C), in a loop"] = ets(peers.Toolbox(arm))
        toolboxes["roboticstoolbox DHRobot"] = model(as_users_build_it(arm))
    agree(arm, written, kernels, toolboxes)
    found = medians({"Armlab": lambda: ours(arm, MANY)}, MANY, 9)
    if kernels is not None:
        found |= medians({"numba": lambda: compiled(written, kernels, MANY)}, MANY, 3)
    found |= medians({"stacked NumPy": lambda: stacked(written, SOME)}, SOME, 3)
    found |= medians({"naive NumPy": lambda: looped(arm, naive(written), FEW)}, FEW, 3)
    for (name, sample), count in zip(toolboxes.items(), (FEW, FEWEST), strict=False):
        found |= medians({name: lambda sample=sample, count=count: looped(arm, sample, count)}, count, 3)
    return found


def drawn(arm: Arm, count: int) -> np.ndarray:
    """Return random configurations as everybody draws them."""
    return np.random.default_rng(SEED).uniform(*arm.limits.T, (count, arm.n))


def counted(arm: Arm, points: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how many samples lie in each voxel, and the sum of w there, the usual way."""
    box = [(-arm.reach, arm.reach)] * 3
    count = np.histogramdd(points, RESOLUTION, box)[0]
    return count, np.histogramdd(points, RESOLUTION, box, weights=w)[0]


def compiled(arm: Arm, kernels: peers.Compiled, count: int) -> object:
    """Run the loops of numba, which leave the counting to the fastest of NumPy."""
    qs = drawn(arm, count)
    points, w = np.empty((count, 3)), np.empty(count)
    kernels.positions(qs, points)
    kernels.manipulability(qs, w)
    cells = ((points + arm.reach) * (RESOLUTION / (2 * arm.reach))).astype(np.intp) @ (RESOLUTION**2, RESOLUTION, 1)
    return np.bincount(cells, minlength=RESOLUTION**3), np.bincount(cells, w, RESOLUTION**3)


def stacked(arm: Arm, count: int) -> object:
    """Do it with stacks of matrices, as in good lecture code."""
    qs = drawn(arm, count)
    points, J = stacked_jacobians(arm, qs)
    return counted(arm, points, np.sqrt(np.maximum(np.linalg.det(J @ np.swapaxes(J, 1, 2)), 0.0)))


def stacked_jacobians(arm: Arm, qs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return tool points and geometric Jacobians of a modified table, a stack of 4 x 4 matrices for each joint."""
    T, axes, origins = np.broadcast_to(arm.base, (len(qs), 4, 4)), [], []
    for i in range(arm.n):
        c, s = np.cos(qs[:, i] + arm.rows[i].theta), np.sin(qs[:, i] + arm.rows[i].theta)
        turn = np.zeros((len(qs), 4, 4))
        turn[:, 0, 0], turn[:, 0, 1], turn[:, 1, 0], turn[:, 1, 1] = c, -s, s, c
        turn[:, 2, 2] = turn[:, 3, 3] = 1.0
        T = T @ peers.fixed_part(arm, i) @ turn
        axes.append(T[:, :3, 2])
        origins.append(T[:, :3, 3])
    p = (T @ arm.tool)[:, :3, 3]
    columns = [np.hstack([np.cross(z, p - o), z]) for z, o in zip(axes, origins, strict=True)]
    return p, np.stack(columns, axis=2)


def as_users_build_it(arm: Arm) -> object:
    """Return the arm as its users know it: ``rtb.DHRobot`` of a table."""
    import roboticstoolbox as rtb
    import spatialmath

    link = rtb.RevoluteDH if arm.convention == "standard" else rtb.RevoluteMDH
    links = [
        link(a=r.a, alpha=r.alpha, d=r.d, offset=r.theta, qlim=q) for r, q in zip(arm.rows, arm.limits, strict=True)
    ]
    base, tool = (spatialmath.SE3(T, check=False) for T in (arm.base, arm.tool))
    return rtb.DHRobot(links, base=base, tool=tool)


def ets(toolbox: peers.Toolbox) -> Sample:
    """Return tool point and w of one configuration, with the kinematics in C."""

    def of(q: np.ndarray) -> tuple[np.ndarray, float]:
        J = toolbox.jacobian(q)
        return np.squeeze(toolbox.pose(q))[:3, 3], np.sqrt(abs(np.linalg.det(J @ J.T)))

    return of


def model(robot: object) -> Sample:
    """Return tool point and w of one configuration, with the methods of a robot model."""
    return lambda q: (robot.fkine(q).t, robot.manipulability(q))


def naive(arm: Arm) -> Sample:
    """Return tool point and w of one configuration of a modified table, a matrix at a time, as in lecture notes."""

    def of(q: np.ndarray) -> tuple[np.ndarray, float]:
        T, frames = arm.base, []
        for link, value in zip(arm.rows, q, strict=True):
            T = T @ peers.modified_matrix(link.a, link.alpha, link.d, link.theta + value)
            frames.append(T)
        p = (T @ arm.tool)[:3, 3]
        J = np.array([np.hstack([np.cross(F[:3, 2], p - F[:3, 3]), F[:3, 2]]) for F in frames]).T
        return p, np.sqrt(abs(np.linalg.det(J @ J.T)))

    return of


def looped(arm: Arm, sample: Sample, count: int) -> object:
    """Take one configuration after the other."""
    points, w = np.empty((count, 3)), np.empty(count)
    for k, q in enumerate(drawn(arm, count)):
        points[k], w[k] = sample(q)
    return counted(arm, points, w)


def agree(arm: Arm, written: Arm, kernels: peers.Compiled | None, toolboxes: dict[str, Sample]) -> None:
    """Check that all compute the same, so that the times are of the same work."""
    qs = drawn(arm, 20)
    exact = arm.manipulability(qs)
    if kernels is not None:
        points, w = np.empty((len(qs), 3)), np.empty(len(qs))
        kernels.positions(qs, points)
        kernels.manipulability(qs, w)
        np.testing.assert_allclose(points + written.base[:3, 3], arm.position(qs), atol=1e-9)
        np.testing.assert_allclose(w, exact, atol=1e-9)
    p, J = stacked_jacobians(written, qs)
    np.testing.assert_allclose(p, arm.position(qs), atol=1e-9)
    np.testing.assert_allclose(np.sqrt(abs(np.linalg.det(J @ np.swapaxes(J, 1, 2)))), exact, atol=1e-9)
    for sample in (naive(written), *toolboxes.values()):
        for q, w_of_q in zip(qs, exact, strict=True):
            found = sample(q)
            np.testing.assert_allclose(found[0], arm.position(q), atol=1e-9)
            np.testing.assert_allclose(found[1], w_of_q, atol=1e-9)


def memory(arm: Arm, count: int) -> float:
    """Return the largest memory held at once in MiB."""
    tracemalloc.start()
    ours(arm, count)
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    return peak


def first(arm: Arm) -> float:
    """Return seconds to the first piece of an arm of which nothing has been compiled yet."""
    seconds = []
    for k in range(5):
        rows = [(r.kind, r.a + 1e-3 * (k + 1), r.alpha, r.d, r.theta) for r in arm.rows]
        edited = Arm.from_dh(rows, arm.convention, arm.base, arm.tool, arm.limits)
        start = time.perf_counter()
        grid, piece = voxels_for(edited, RESOLUTION), next(samples(edited, MANY, SEED))
        grid.add(piece.points, piece.values)
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds))
