"""The same arm in other libraries, and written the naive way. What is not installed is left out."""

import importlib.util
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from armlab import Arm
from armlab.kin.dh import link_transform
from armlab.kin.rotations import euler_zyx

PINOCCHIO, TOOLBOX, IKPY = "pinocchio", "roboticstoolbox (C)", "ikpy"


def is_installed(module: str) -> bool:
    """Return whether a library of others is there to be compared with."""
    return importlib.util.find_spec(module) is not None


def of(arm: Arm) -> "dict[str, Pinocchio | Toolbox | IKPy]":
    """Return the arm in each library that is installed, by the name it has in the tables."""
    kinds = {PINOCCHIO: ("pinocchio", Pinocchio), TOOLBOX: ("roboticstoolbox", Toolbox), IKPY: ("ikpy", IKPy)}
    return {name: kind(arm) for name, (module, kind) in kinds.items() if is_installed(module)}


def fixed_part(arm: Arm, i: int) -> np.ndarray:
    """Return what comes before the turn of joint i of a modified, all-revolute table; d commutes with the turn."""
    row = arm.rows[i]
    return link_transform(row.a, row.alpha, row.d, 0.0, "modified")


class Pinocchio:
    """An arm in pinocchio; built from standard or modified rows alike."""

    def __init__(self, arm: Arm) -> None:
        import pinocchio as pin

        self.pin, model, joint = pin, pin.Model(), 0
        after = np.array(arm.base)
        for i, row in enumerate(arm.rows):
            before = (
                fixed_part(arm, i) if arm.convention == "modified" else link_transform(0, 0, 0, row.theta, "standard")
            )
            joint = model.addJoint(joint, pin.JointModelRZ(), pin.SE3(after @ before), f"q{i + 1}")
            after = (
                np.eye(4) if arm.convention == "modified" else link_transform(row.a, row.alpha, row.d, 0.0, "standard")
            )
        tool = pin.SE3(after @ arm.tool)
        self.frame = model.addFrame(pin.Frame("tool", joint, 0, tool, pin.FrameType.OP_FRAME))
        self.model, self.data, self.limits = model, model.createData(), arm.limits

    def pose(self, q: np.ndarray) -> object:
        self.pin.forwardKinematics(self.model, self.data, q)
        return self.pin.updateFramePlacement(self.model, self.data, self.frame)

    def positions(self, qs: np.ndarray) -> object:
        return [self.pose(q).translation for q in qs]

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        axes = self.pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        return self.pin.computeFrameJacobian(self.model, self.data, q, self.frame, axes)

    def solve(self, goal: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """Return joint values from a damped loop with clipping and restarts, as its examples write it."""
        pin, target = self.pin, self.pin.SE3(goal)
        low, high = self.limits.T
        for _ in range(30):
            q = rng.uniform(low, high)
            for _ in range(100):
                error = pin.log6(self.pose(q).actInv(target)).vector
                if np.linalg.norm(error) < 5e-7:
                    return q
                J = pin.computeFrameJacobian(self.model, self.data, q, self.frame, pin.ReferenceFrame.LOCAL)
                damping = 1e-2 * (error @ error) + 1e-10
                q = np.clip(q + J.T @ np.linalg.solve(J @ J.T + damping * np.eye(6), error), low, high)
        return q


class Toolbox:
    """An arm in the Robotics Toolbox, with its kinematics in C."""

    def __init__(self, arm: Arm) -> None:
        import roboticstoolbox as rtb

        ET, parts = rtb.ET, []
        for i, row in enumerate(arm.rows):
            turn = ET.Rz(qlim=arm.limits[i])
            if arm.convention == "modified":
                parts += [ET.Rx(row.alpha), ET.tx(row.a), turn, ET.tz(row.d)]
            else:
                parts += [ET.Rz(row.theta), turn, ET.tz(row.d), ET.tx(row.a), ET.Rx(row.alpha)]
        import spatialmath

        tool = spatialmath.SE3(arm.tool, check=False)
        self.ets = rtb.ETS([*parts, ET.SE3(tool)])
        self.limits = arm.limits
        self.pose = self.positions = self.ets.eval
        self.jacobian = self.ets.jacob0

    def solve(self, goal: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        start = rng.uniform(*self.limits.T)
        return self.ets.ik_LM(goal, start, ilimit=30, slimit=100, tol=1e-13, joint_limits=True)[0]


class IKPy:
    """A modified, all-revolute arm in ikpy."""

    def __init__(self, arm: Arm) -> None:
        from ikpy.chain import Chain
        from ikpy.link import OriginLink, URDFLink

        links: list[object] = [OriginLink()]
        for i, row in enumerate(arm.rows):
            place, turned = fixed_part(arm, i)[:3, 3], [row.alpha, 0.0, 0.0]
            links.append(URDFLink(f"q{i + 1}", origin_translation=place, origin_orientation=turned, rotation=[0, 0, 1]))
        turned = euler_zyx(arm.tool[:3, :3])[0][::-1]
        links.append(URDFLink("tool", arm.tool[:3, 3], turned, joint_type="fixed"))
        self.chain = Chain(links, active_links_mask=[False, *[True] * arm.n, False])

    def pose(self, q: np.ndarray) -> np.ndarray:
        return self.chain.forward_kinematics([0.0, *q, 0.0])


def modified_matrix(a: float, alpha: float, d: float, theta: float) -> np.ndarray:
    """Return the matrix of a modified row, typed as the books print it."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]], dtype=float
    )


def naive_positions(arm: Arm, qs: np.ndarray) -> np.ndarray:
    """Return tool points as lecture code computes them: a product of 4 x 4 matrices for every q."""
    found = np.empty((len(qs), 3))
    for k, q in enumerate(qs):
        T = arm.base
        for row, value in zip(arm.rows, q, strict=True):
            T = T @ modified_matrix(row.a, row.alpha, row.d, row.theta + value)
        found[k] = (T @ arm.tool)[:3, 3]
    return found


def stacked_positions(arm: Arm, qs: np.ndarray) -> np.ndarray:
    """Return tool points with one batch of 4 x 4 matrices for each joint, as good NumPy code does it."""
    T = np.broadcast_to(arm.base, (len(qs), 4, 4))
    for i, row in enumerate(arm.rows):
        c, s = np.cos(qs[:, i] + row.theta), np.sin(qs[:, i] + row.theta)
        turn = np.zeros((len(qs), 4, 4))
        turn[:, 0, 0], turn[:, 0, 1], turn[:, 1, 0], turn[:, 1, 1] = c, -s, s, c
        turn[:, 2, 2] = turn[:, 3, 3] = 1.0
        T = T @ fixed_part(arm, i) @ turn
    return np.asarray((T @ arm.tool)[:, :3, 3])


class Compiled(NamedTuple):
    """Loops over configurations (N, n) that write into an array."""

    positions: Callable[[np.ndarray, np.ndarray], None]
    manipulability: Callable[[np.ndarray, np.ndarray], None]
    frames: Callable[[np.ndarray, np.ndarray], None]
    jacobians: Callable[[np.ndarray, np.ndarray], None]


@cache
def numba_kernels(arm: Arm) -> Compiled | None:
    """Return compiled loops of a modified, all-revolute arm whose base is the world, if numba is installed."""
    if not is_installed("numba"):
        return None
    import numba

    fixed = np.ascontiguousarray(np.array([fixed_part(arm, i)[:3] for i in range(arm.n)]))
    tool, n = np.ascontiguousarray(arm.tool[:3]), arm.n

    @numba.njit(fastmath=True)
    def chain(q, R, p, axes, origins):
        for r in range(3):
            p[r] = 0.0
            for c in range(3):
                R[r, c] = 1.0 if r == c else 0.0
        for i in range(n):
            for r in range(3):
                p[r] += R[r, 0] * fixed[i, 0, 3] + R[r, 1] * fixed[i, 1, 3] + R[r, 2] * fixed[i, 2, 3]
            co, si = np.cos(q[i]), np.sin(q[i])
            for r in range(3):
                x = R[r, 0] * fixed[i, 0, 0] + R[r, 1] * fixed[i, 1, 0] + R[r, 2] * fixed[i, 2, 0]
                y = R[r, 0] * fixed[i, 0, 1] + R[r, 1] * fixed[i, 1, 1] + R[r, 2] * fixed[i, 2, 1]
                z = R[r, 0] * fixed[i, 0, 2] + R[r, 1] * fixed[i, 1, 2] + R[r, 2] * fixed[i, 2, 2]
                R[r, 0], R[r, 1], R[r, 2] = co * x + si * y, co * y - si * x, z
                axes[i, r], origins[i, r] = z, p[r]
        for r in range(3):
            p[r] += R[r, 0] * tool[0, 3] + R[r, 1] * tool[1, 3] + R[r, 2] * tool[2, 3]

    @numba.njit(fastmath=True)
    def positions(qs, out):
        R, p, axes, origins = np.empty((3, 3)), np.empty(3), np.empty((n, 3)), np.empty((n, 3))
        for k in range(len(qs)):
            chain(qs[k], R, p, axes, origins)
            out[k, 0], out[k, 1], out[k, 2] = p[0], p[1], p[2]

    @numba.njit(fastmath=True)
    def frames(qs, out):
        for k in range(len(qs)):
            for i in range(n + 1):
                for c in range(4):
                    out[k, i, 3, c] = 1.0 if c == 3 else 0.0
            for r in range(3):
                for c in range(4):
                    out[k, 0, r, c] = 1.0 if r == c else 0.0
            for i in range(n):
                co, si, last, T = np.cos(qs[k, i]), np.sin(qs[k, i]), out[k, i], out[k, i + 1]
                for r in range(3):
                    x = last[r, 0] * fixed[i, 0, 0] + last[r, 1] * fixed[i, 1, 0] + last[r, 2] * fixed[i, 2, 0]
                    y = last[r, 0] * fixed[i, 0, 1] + last[r, 1] * fixed[i, 1, 1] + last[r, 2] * fixed[i, 2, 1]
                    z = last[r, 0] * fixed[i, 0, 2] + last[r, 1] * fixed[i, 1, 2] + last[r, 2] * fixed[i, 2, 2]
                    p = last[r, 0] * fixed[i, 0, 3] + last[r, 1] * fixed[i, 1, 3] + last[r, 2] * fixed[i, 2, 3]
                    T[r, 0], T[r, 1], T[r, 2], T[r, 3] = co * x + si * y, co * y - si * x, z, p + last[r, 3]

    @numba.njit(fastmath=True)
    def columns(q, R, p, axes, origins, J):
        chain(q, R, p, axes, origins)
        for i in range(n):
            x, y, z = p[0] - origins[i, 0], p[1] - origins[i, 1], p[2] - origins[i, 2]
            J[0, i] = axes[i, 1] * z - axes[i, 2] * y
            J[1, i] = axes[i, 2] * x - axes[i, 0] * z
            J[2, i] = axes[i, 0] * y - axes[i, 1] * x
            J[3, i], J[4, i], J[5, i] = axes[i, 0], axes[i, 1], axes[i, 2]

    @numba.njit(fastmath=True)
    def jacobians(qs, out):
        R, p, axes, origins = np.empty((3, 3)), np.empty(3), np.empty((n, 3)), np.empty((n, 3))
        for k in range(len(qs)):
            columns(qs[k], R, p, axes, origins, out[k])

    @numba.njit(fastmath=True)
    def manipulability(qs, out):
        R, p, axes, origins = np.empty((3, 3)), np.empty(3), np.empty((n, 3)), np.empty((n, 3))
        J, A = np.empty((6, n)), np.empty((6, 6))
        for k in range(len(qs)):
            columns(qs[k], R, p, axes, origins, J)
            product = 1.0
            for r in range(6):
                for c in range(r + 1):
                    total = 0.0
                    for i in range(n):
                        total += J[r, i] * J[c, i]
                    for i in range(c):
                        total -= A[r, i] * A[c, i]
                    if r == c:
                        A[r, r] = np.sqrt(max(total, 0.0))
                        product *= A[r, r]
                    else:
                        A[r, c] = total / A[c, c]
            out[k] = product

    return Compiled(positions, manipulability, frames, jacobians)
