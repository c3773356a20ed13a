"""The bodies of an arm, put together."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.ui.figure.anatomy import Anatomy, anatomy_of
from armlab.ui.figure.glb import Part, body_glb, joint_material
from armlab.ui.figure.gripper import NATURAL, SHORTEST, gripper, pointer
from armlab.ui.figure.housings import HALF_LENGTH, RADIUS, half_length, housing_offsets
from armlab.ui.figure.mesh import placed, shifted
from armlab.ui.figure.slides import is_rail, rail, ram
from armlab.ui.figure.solids import WIDE_SIDES, band, block, drum, lathe, lid
from armlab.ui.figure.tubes import tube

BOLT_SIDES = 12

Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Figure:
    """The drawn arm.

    Attributes
    ----------
    anatomy : Anatomy
    parts : list of list of Part
        Solids of bodies 0 to n, each in the node of its body.
    foot : float
        Lowest height of the base, along z of its node.
    housings : list of float
        Place of each housing along z of its node.
    """

    anatomy: Anatomy
    parts: list[list[Part]]
    foot: float
    housings: list[float]

    def glbs(self) -> list[bytes | None]:
        """Return the GLB file of each body; None for a body without solids."""
        return [body_glb(parts) if parts else None for parts in self.parts]

    def poses(self, q: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """Return the poses (4, 4), in the world, of the nodes of bodies 0 to n at a configuration."""
        poses = [self.anatomy.root]
        for body, value in zip(self.anatomy.bodies, q.tolist(), strict=True):
            poses.append(poses[-1] @ body.mount @ _joint_motion(body.revolute, body.offset, value))
        return poses

    def bounds(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the corners (2, 3), in the world, of the box around the arm at a configuration."""
        corners = []
        for T, parts in zip(self.poses(q), self.parts, strict=True):
            corners += [_corners(mesh.bounds) @ T[:3, :3].T + T[:3, 3] for _, mesh in parts]
        points = np.vstack(corners)
        return np.array([points.min(axis=0), points.max(axis=0)])


def _joint_motion(revolute: bool, offset: float, q: float) -> NDArray[np.float64]:
    T = np.eye(4)
    if revolute:
        T[0, 0] = T[1, 1] = math.cos(q)
        T[1, 0] = math.sin(q)
        T[0, 1] = -T[1, 0]
    else:
        T[2, 3] = offset + q
    return T


def _corners(bounds: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([[bounds[i, 0], bounds[j, 1], bounds[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])


def build_figure(arm: Arm) -> Figure:
    """Return the drawn arm."""
    anatomy = anatomy_of(arm)
    offsets = housing_offsets(anatomy)
    parts: list[list[Part]] = [[] for _ in range(arm.n + 1)]
    foot = 0.0
    for i, body in enumerate(anatomy.bodies):
        if body.revolute:
            if i == 0:
                parts[0], foot = _base(anatomy, offsets[0])
            parts[i + 1] += _revolute(anatomy, i, offsets[i])
        else:
            fixed, moving, lowest = _prismatic(anatomy, i)
            parts[i] += [(material, placed(mesh, body.mount)) for material, mesh in fixed]
            parts[i + 1] += moving
            if i == 0:
                foot = lowest
    return Figure(anatomy, parts, foot, offsets)


def _base(anatomy: Anatomy, housing: float) -> tuple[list[Part], float]:
    """Return plate, bolts and cone below the first housing, and the height of the foot."""
    r = float(anatomy.radius[0])
    foot = 0.0 if housing > 0.0 else -1.5 * r
    top = max(housing - 1.15 * r, foot + 0.6 * r)
    cone = [(0.0, 0.2), (1.75, 0.28), (1.62, 0.5)]
    parts: list[Part] = [
        ("dark", drum(2.5 * r, 0.14 * r, 0.1 * r, foot + 0.14 * r, sides=WIDE_SIDES)),
        ("dark", lathe([*((x * r, foot + z * r) for x, z in cone), (1.5 * r, top), (0.0, top + 1e-4)], WIDE_SIDES)),
    ]
    bolt = lid(0.17 * r, 0.14 * r, 0.03 * r, foot + 0.28 * r, sides=BOLT_SIDES)
    for k in range(4):
        angle = math.pi / 4.0 + k * math.pi / 2.0
        parts.append(("steel", shifted(bolt, (2.05 * r * math.cos(angle), 2.05 * r * math.sin(angle), 0.0))))
    return parts, foot


def _revolute(anatomy: Anatomy, i: int, at: float) -> list[Part]:
    """Return housing and tube of a revolute joint; at the last one also the hand."""
    body, r, colour = anatomy.bodies[i], float(anatomy.radius[i]), joint_material(i)
    R, h = RADIUS * r, half_length(anatomy, i, at)
    parts: list[Part] = [("shell", drum(R, h, 0.16 * r, at, soft=True))]
    for side in (1.0, -1.0):
        parts.append((colour, band(1.035 * R, 0.17 * r, 0.05 * r, at + side * (h - 0.34 * r))))
        # An inset cap with a bar along x: it shows the turn.
        parts.append(("dark", lid(0.74 * R, 0.07 * r, 0.02 * r, at + side * h, side > 0.0)))
        bar = block((0.62 * R, 0.16 * r, 0.1 * r), 0.02 * r, (0.36 * R, 0.0, at + side * (h + 0.05 * r)))
        parts.append((colour, bar))
    thin = 0.15 * float(anatomy.radius[0])
    last = i == len(anatomy.bodies) - 1
    path = [np.array([0.0, 0.0, at])]
    if abs(body.d - at) > thin and not (last and abs(body.d) < thin):
        path.append(np.array([0.0, 0.0, body.d]))
    if abs(body.a) > thin:
        path.append(np.array([body.a, 0.0, body.d]))
    if last:
        path, hand = _hand(anatomy, path)
        parts += hand
    if len(path) > 1:
        parts.append(("shell", tube(path, 0.92 * r, 0.92 * float(anatomy.radius[i + 1]), 1.6 * r)))
    return parts


def _prismatic(anatomy: Anatomy, i: int) -> tuple[list[Part], list[Part], float]:
    body, last = anatomy.bodies[i], i == len(anatomy.bodies) - 1
    if is_rail(anatomy, i):
        fixed, moving, foot = rail(anatomy, i)
        return fixed, moving + _link_of_rail(anatomy, i, last), foot
    room = max(body.low + body.offset - 1.6 * float(anatomy.radius[i]), 0.0)
    if not last or np.linalg.norm(anatomy.arm.tool[:3, 3]) > 0.0:
        fixed, moving, foot = ram(anatomy, i, 0.0)
        if last:
            moving += _hand(anatomy, [np.zeros(3)])[1]
        return fixed, moving, foot
    # No tool beyond the last frame: the gripper takes the end of the rod, so that its tips are the tool point.
    length = min(NATURAL * float(anatomy.radius[-1]), room) if room > SHORTEST * anatomy.radius[-1] else 0.0
    fixed, moving, foot = ram(anatomy, i, length)
    r = float(anatomy.radius[-1])
    moving += gripper(np.zeros(3), Z, length, r, i) if length else pointer(np.zeros(3), Z, r, i)
    return fixed, moving, foot


def _link_of_rail(anatomy: Anatomy, i: int, last: bool) -> list[Part]:
    """Return the tube that leaves the block of a rail along x, at the last joint with the hand."""
    body = anatomy.bodies[i]
    path, parts = [np.zeros(3)], list[Part]()
    if abs(body.a) > 0.15 * float(anatomy.radius[0]):
        path.append(np.array([body.a, 0.0, 0.0]))
    if last:
        path, parts = _hand(anatomy, path)
    if len(path) > 1:
        start, end = (0.92 * float(anatomy.radius[k]) for k in (i, i + 1))
        parts.append(("shell", tube(path, start, end, 1.6 * float(anatomy.radius[i]))))
    return parts


def _hand(anatomy: Anatomy, path: list[NDArray[np.float64]]) -> tuple[list[NDArray[np.float64]], list[Part]]:
    """Return the path of the last tube, shortened to make room for the gripper, and the hand."""
    r, joint = float(anatomy.radius[-1]), len(anatomy.bodies) - 1
    tool = anatomy.tool_on_last()
    tip, flange = tool[:3, 3], anatomy.bodies[-1].end[:3, 3]
    beyond = tip - flange
    space = float(np.linalg.norm(beyond))
    if space > SHORTEST * r:
        hidden = 0.0
        if len(path) == 1:
            # The housing stands on the way to the tool, or behind the flange: the gripper begins at its face.
            ahead = float((path[0] - flange) @ beyond) / space
            hidden = max(0.0, ahead + HALF_LENGTH * float(anatomy.radius[joint]))
            if ahead < 0.0:
                path = [path[0], flange]
        return path, gripper(tip, beyond, max(space - hidden, 0.5 * space), r, joint)
    if len(path) > 1:
        leg = path[-1] - path[-2]
        length = float(np.linalg.norm(leg))
        take = min(NATURAL * r, length - 1.6 * r)
        if take > SHORTEST * r:
            return [*path[:-1], path[-1] - leg * take / length], gripper(tip, leg, take, r, joint)
    return path, pointer(tip, tool[:3, 2], r, joint)
