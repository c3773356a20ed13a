"""Write an arm in the other Denavit-Hartenberg convention; it stays the same arm.

Both conventions are the string of moves Tx Rx | Rz Tz | Tx Rx | ... | Rz Tz | Tx Rx and differ in where they cut it
(`common_normals`). The standard table has no place for the link before joint 1, the modified one none for the link
after joint n: what does not fit goes into the constant base and tool.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import CONVENTIONS, Convention, Row, common_normals
from armlab.kin.graph.walker import SNAP, exact
from armlab.kin.task import Task
from armlab.kin.task_choice import default_task
from armlab.kin.transforms import as_pose
from armlab.registry import known_name


@dataclass(frozen=True)
class Link:
    """The moves Tx(a) Rx(alpha) from one joint axis to the next: a in metres, alpha in radians."""

    a: float
    alpha: float

    @property
    def moves(self) -> bool:
        """Whether the link moves anything, so that a or alpha is not zero."""
        return self.a != 0.0 or self.alpha != 0.0

    @property
    def matrix(self) -> NDArray[np.float64]:
        """Tx(a) Rx(alpha), shape (4, 4); quarter turns are exact."""
        c, s = exact(math.cos(self.alpha)), exact(math.sin(self.alpha))
        return np.array([[1.0, 0.0, 0.0, self.a], [0.0, c, -s, 0.0], [0.0, s, c, 0.0], [0.0, 0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class Remainders:
    """Base and tool after a conversion: ``after.base = before.base @ base``, ``after.tool = tool @ before.tool``.

    A tool that was taken into the last row has moved the other way, and its entries have the other sign.
    ``task_kept`` says whether the arm still controls what it did; see `task_kept`.
    """

    base: Link
    tool: Link
    task_kept: bool = True


def converted(arm: Arm, convention: Convention) -> Arm:
    """Return the same arm written in a convention; the arm itself when it is written in that one.

    Joint values, limits, speeds and name stay, and so do all joint axes and the tool. Standard frame i is modified
    frame i followed by Tx(a_i) Rx(alpha_i), so frame 0 turns when a modified table begins with a twist. The task stays
    where it controls the same things in the axes of the frame 0 that results; a quarter turn of frame 0 exchanges y
    and z in it. Where neither will do the arm gets its default task (`task_kept`).

    To the modified convention: row 1 gets a = alpha = 0, row i the a and alpha of standard row i-1, and those of the
    last row go in front of the tool. To the standard one: those of row 1 go behind the base and every row gets those of
    the next; the last row gets zeros, unless the tool is exactly some Tx(a) Rx(alpha): that goes into the last row, and
    the tool becomes the identity, so that a standard table without a tool comes back from the modified one. There and
    back, frames 1 to n-1 always return; frame n and frame 0 do unless their link has gone into a tool or the base.

    Parameters
    ----------
    arm : Arm
    convention : "standard" or "modified"

    Raises
    ------
    UnknownName
        Another convention.

    References
    ----------
    Notes 4.10-4.16 (standard); Craig, *Introduction to Robotics*, 3.4-3.6 (modified).

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)])
    >>> other = converted(arm, "modified")
    >>> [row.a for row in other.rows], other.tool[0, 3].item()
    ([0.0, 1.0], 0.5)
    """
    known_name("convention", convention, CONVENTIONS)
    if convention == arm.convention:
        return arm
    return _to_modified(arm) if convention == "modified" else _to_standard(arm)


def remainders(before: Arm, after: Arm) -> Remainders:
    """Return the (a, alpha) that `converted` put into the base and in front of the tool."""
    nothing = Link(0.0, 0.0)
    if before.convention == after.convention:
        return Remainders(nothing, nothing)
    if after.convention == "modified":
        return Remainders(nothing, _last(before))
    taken = _last(after)
    return Remainders(_links(before)[0], Link(0.0 - taken.a, 0.0 - taken.alpha), task_kept(before, after))


def task_kept(before: Arm, after: Arm) -> bool:
    """Return whether an arm made by `converted` controls what it did before, possibly under other letters."""
    turned = after.convention == "standard" and before.convention == "modified"
    return after.task == (_turned_task(before.task, _links(before)[0].alpha) if turned else before.task)


def _links(arm: Arm) -> list[Link]:
    return [Link(a, alpha) for a, alpha in common_normals(arm.rows, arm.convention)]


def _last(arm: Arm) -> Link:
    return _links(arm)[-1]


def _to_modified(arm: Arm) -> Arm:
    links = _links(arm)
    return replace(
        arm,
        rows=_with_links(arm.rows, links[:-1]),
        convention="modified",
        tool=_product(links[-1].matrix, arm.tool, "tool"),
    )


def _to_standard(arm: Arm) -> Arm:
    links = _links(arm)
    taken = _as_link(arm.tool)
    rows = _with_links(arm.rows, [*links[1:-1], taken or Link(0.0, 0.0)])
    tool = arm.tool if taken is None else as_pose(np.eye(4), "tool")
    task = _turned_task(arm.task, links[0].alpha)
    return replace(
        arm,
        rows=rows,
        convention="standard",
        base=_product(arm.base, links[0].matrix, "base"),
        tool=tool,
        task=task or default_task(rows, "standard", tool),
    )


def _with_links(rows: tuple[Row, ...], links: list[Link]) -> tuple[Row, ...]:
    return tuple(replace(row, a=link.a, alpha=link.alpha) for row, link in zip(rows, links, strict=True))


def _product(first: NDArray[np.float64], second: NDArray[np.float64], where: str) -> NDArray[np.float64]:
    """Return first @ second, read-only; quarter turns stay exact."""
    if np.array_equal(first, np.eye(4)):
        return as_pose(second, where)
    pose = first @ second
    nearest = np.round(pose[:3, :3])
    pose[:3, :3] = np.where(np.abs(pose[:3, :3] - nearest) < SNAP, nearest, pose[:3, :3])
    return as_pose(pose + 0.0, where)  # + 0.0: no minus zeros


def _as_link(pose: NDArray[np.float64]) -> Link | None:
    """Return a pose as Tx(a) Rx(alpha), or None when it is not one."""
    link = Link(float(pose[0, 3]), math.atan2(pose[2, 1], pose[1, 1]))
    return link if np.all(np.abs(link.matrix - pose) < SNAP) else None


def _turned_task(task: Task, twist: float) -> Task | None:
    """Return the task that controls the same after frame 0 is turned about its x axis by a twist; None without one.

    Half a turn only reverses y and z, a quarter turn exchanges them. Any other leaves x, the plane of y and z, and
    directions in space. The angle about z is kept by half turns only.
    """
    if exact(math.sin(twist)) == 0.0:
        return task
    if task.rotation == "phi":
        return None
    if exact(math.cos(twist)) == 0.0:
        exchanged = task.position.translate(str.maketrans("yz", "zy"))
        return replace(task, position="".join(sorted(exchanged)))
    return task if set(task.position) in (set(), {"x"}, {"y", "z"}, {"x", "y", "z"}) else None
