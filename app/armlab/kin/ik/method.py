"""Compiled methods of inverse kinematics: each is a rule for one step; loop, limits and stopping are shared.

A step is written once with + - * / and runs on expressions, which makes it fast enough to be behind every drag. Methods
for lessons (`armlab.kin.ik.iterate.method`) may use anything, singular values and memory among it, take several
parameters, and run on many configurations at once: another kind of rule, so another class and another folder.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from armlab.kin.ik import methods as _folder
from armlab.plugins import discover
from armlab.registry import Registry

Step = Callable[[Sequence[Sequence[Any]], Sequence[Any], Any], Sequence[Any]]
"""``step(J, e, gain) -> dq``: task Jacobian (m rows of n), error (m), gain; returns n joint changes.

Rows of positions are divided by the arm's length scale and prismatic columns multiplied by it, so J, e and dq are
pure numbers of the size of radians.
"""

Damping = Callable[[Any, Any], Any]


@dataclass(frozen=True)
class Method:
    """One method, the constant ``METHOD`` of a module in `armlab.kin.ik.methods`.

    Parameters
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    step : callable
        See `Step`. With ``closed=True`` it uses only + - * / on the entries; it is then run once on expressions and
        compiled. Otherwise it is called with NumPy arrays.
    gain : float
        Default of the method's parameter (damping, step size).
    damping : callable, optional
        ``damping(square, gain)``: the number the step adds to the diagonal of J J^T where e^T e is ``square``. A larger
        gain then means a shorter, safer step: the loop raises it when a step fails, and shortens the step otherwise.
    closed : bool
    """

    key: str
    title: str
    order: int
    step: Step
    gain: float
    damping: Damping | None = None
    closed: bool = True

    @property
    def damped(self) -> bool:
        """Whether a larger gain means a shorter, safer step."""
        return self.damping is not None


@cache
def methods() -> Registry[Method]:
    """Return all compiled methods by key, in the order of lists."""
    return discover(_folder, "METHOD", Method)


def method_named(key: str) -> Method:
    """Return a compiled method by key; `UnknownName` when there is none."""
    return methods()[key]
