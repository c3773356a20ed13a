"""The moves of a Denavit-Hartenberg table, joint by joint, for a `Walker` to follow in either direction."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from armlab.kin.dh import Convention, Row, common_normals
from armlab.kin.graph.expression import Graph, Number
from armlab.kin.graph.walker import ORIGIN, Frame, Walker, exact

Constant = Callable[[str, float], Number]
"""A function of name and value of a constant of the table, such as ``("a2", 0.4318)``, to a number or a symbol."""


def as_number(_name: str, value: float) -> Number:
    """Return the value of a constant as a number, so that products and sums with it are computed at once."""
    return exact(value)


@dataclass(frozen=True)
class Chain:
    """A table bound to a graph, whose variables are the joint values.

    Walked forward it is link 0, joint 0, link 1, joint 1, ..., link n: joint i (0-based) is Rz(theta) Tz(d), link i is
    Tx(a) Rx(alpha). In both conventions joint i turns about, or moves along, the z axis the walker has before it.
    """

    graph: Graph
    rows: Sequence[Row]
    convention: Convention
    constant: Constant = as_number

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.rows)

    @cached_property
    def _links(self) -> list[tuple[float, float]]:
        return common_normals(self.rows, self.convention)

    def joint(self, walker: Walker, i: int, direction: int = 1) -> None:
        """Apply joint i, or undo it with ``direction=-1``."""
        row, q = self.rows[i], self.graph.variable(i)
        offset = self._length(f"d{i + 1}", row.d)
        walker.turn_z(direction * row.theta)
        if row.revolute:
            walker.turn_z(direction * q)
            walker.move_z(direction * offset)
        else:
            walker.move_z(direction * (q + offset))

    def link(self, walker: Walker, i: int, direction: int = 1) -> None:
        """Apply link i, or undo it with ``direction=-1``; its two moves commute."""
        a, alpha = self._links[i]
        walker.move_x(direction * self._length(f"a{i}", a))
        walker.turn_x(
            self._twist(f"cos(alpha{i})", math.cos(alpha)),
            direction * self._twist(f"sin(alpha{i})", math.sin(alpha)),
        )

    def frames(self, start: Frame = ORIGIN) -> list[Frame]:
        """Return frames 0 to n, in the axes ``start`` is given in; frame 0 is ``start``."""
        walker, found = Walker.at(start), [start]
        self.link(walker, 0)
        for i in range(self.n):
            self.joint(walker, i)
            if self.convention == "modified":
                found.append(walker.frame())
            self.link(walker, i + 1)
            if self.convention == "standard":
                found.append(walker.frame())
        return found

    def axes(self, start: Frame = ORIGIN) -> tuple[list[Frame], Walker]:
        """Return for each joint a frame with z along its axis, and the walker at the end of the chain."""
        walker = Walker.at(start)
        self.link(walker, 0)
        return self._axes_from(walker, 0), walker

    def axes_seen_from(self, k: int) -> tuple[list[Frame], Walker]:
        """Return `axes` as seen from the axes of joint k before it moves; the first joint drops out of all formulas."""
        forward, backward = Walker(), Walker()
        found = self._axes_from(forward, k)
        for i in reversed(range(k)):
            self.link(backward, i + 1, -1)
            self.joint(backward, i, -1)
            found.insert(0, backward.frame())
        return found, forward

    def _axes_from(self, walker: Walker, first: int) -> list[Frame]:
        found = []
        for i in range(first, self.n):
            found.append(walker.frame())
            self.joint(walker, i)
            self.link(walker, i + 1)
        return found

    def _length(self, name: str, value: float) -> Number:
        return self.constant(name, value) if value else 0.0

    def _twist(self, name: str, value: float) -> Number:
        value = exact(value)
        return value if value in (0.0, 1.0, -1.0) else self.constant(name, value)
