"""A derivation as data: steps with equations, present numbers, branches, and the geometry they are read off.

Nothing here is markup. An equation holds names of quantities in angle brackets; who shows it puts their symbols or
their present values there, in the units of the reader.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm

Vector = NDArray[np.float64]

Unit = Literal["m", "rad", ""]
Case = Literal["direct", "two", "merged", "any", "none"]
Role = Literal["given", "wanted", "found", "helper"]


@dataclass(frozen=True)
class Quantity:
    """A number, or the three coordinates of a point, with its symbol.

    Attributes
    ----------
    symbol : str
        In LaTeX.
    value : float or tuple of float
        In metres or radians, or without a unit.
    unit : str
    """

    symbol: str
    value: float | tuple[float, ...]
    unit: Unit = "m"


@dataclass(frozen=True)
class Line:
    """One equation.

    Attributes
    ----------
    left : str
        Name of the quantity that the equation gives.
    right : str
        LaTeX with names of quantities as ``<name>``; ``<sign>`` is the sign of the chosen branch, in
        general plus or minus.
    """

    left: str
    right: str


@dataclass(frozen=True)
class Branch:
    """One of the values that a step allows.

    Attributes
    ----------
    title : str
        In a word or two, such as ``"elbow up"``.
    value : float or None
        The joint value, rad or m; None where the step finds no joint.
    """

    title: str
    value: float | None


@dataclass(frozen=True, eq=False)
class Segment:
    """A straight line between two points, metres, in frame 0; ``of`` names the quantity written beside it."""

    start: Vector
    end: Vector
    of: str = ""
    role: Role = "given"


@dataclass(frozen=True, eq=False)
class Triangle:
    """A triangle, corners of shape (3, 3), metres, in frame 0."""

    corners: Vector
    role: Role = "given"


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle; centre and unit normal of shape (3,), in frame 0, radius in metres."""

    centre: Vector
    normal: Vector
    radius: float
    role: Role = "helper"


@dataclass(frozen=True, eq=False)
class Arc:
    """An angle, drawn as the way of ``centre + start`` turned about a unit axis.

    Attributes
    ----------
    centre, start, normal : ndarray, shape (3,)
        In frame 0; the length of ``start`` is the radius in metres.
    angle : float
        Radians.
    of : str
        Name of the quantity written beside it.
    """

    centre: Vector
    start: Vector
    normal: Vector
    angle: float
    of: str = ""
    role: Role = "found"


@dataclass(frozen=True, eq=False)
class Point:
    """A point of shape (3,), metres, in frame 0, with a short name."""

    at: Vector
    name: str = ""
    role: Role = "wanted"


Shape = Segment | Triangle | Circle | Arc | Point


@dataclass(frozen=True, eq=False)
class Step:
    """One step of a derivation.

    Attributes
    ----------
    key : str
        Names the step and its choice, such as ``"q3"``.
    symbol : str
        Symbol of the quantity that is found, in LaTeX.
    title : str
        How it is found, in words.
    by : str
        The method in a few words, such as ``"law of cosines"``.
    values : mapping of str to Quantity
        All quantities of the step by name.
    lines : tuple of Line
    branches : tuple of Branch
        Empty where the step chooses nothing; one where two have merged or the value is free; none is left where
        ``case`` is "none".
    chosen : int
    case : str
        ``"direct"``: one value by nature; ``"two"``; ``"merged"``: two that coincide; ``"any"``: every value does;
        ``"none"``: no value does.
    note : str
        Sentence on what is special here; ``{gap}`` stands for `gap`.
    gap : float
        The length, in metres, by which a step without a value fails.
    index : int
        Index in q of the joint value that is found; -1 for none.
    shapes : tuple
        The geometry that the step is read off.
    """

    key: str
    symbol: str
    title: str
    by: str
    values: Mapping[str, Quantity]
    lines: tuple[Line, ...]
    branches: tuple[Branch, ...] = ()
    chosen: int = 0
    case: Case = "direct"
    note: str = ""
    gap: float = 0.0
    index: int = -1
    shapes: tuple[Shape, ...] = ()

    @property
    def sign(self) -> int:
        """The sign that the chosen branch stands for: 1 for the first, -1 for the second."""
        return 1 if self.chosen == 0 else -1


@dataclass(frozen=True, eq=False)
class Derivation:
    """The steps at one target, as far as they lead with the choices that were made.

    Attributes
    ----------
    arm : Arm
    steps : tuple of Step
    q : ndarray, shape (n,), or None
        The joint values; None where a step has no value.
    choices : mapping of str to int
        The branch taken at each step that offered more than one.
    position_error, rotation_error : float
        Of `q` by forward kinematics, metres and radians, in the components of the task; nan without `q`.
    """

    arm: Arm
    steps: tuple[Step, ...]
    q: Vector | None
    choices: Mapping[str, int] = field(default_factory=dict)
    position_error: float = float("nan")
    rotation_error: float = float("nan")

    @property
    def failed(self) -> Step | None:
        """The step that has no value, or None."""
        return self.steps[-1] if self.steps and self.steps[-1].case == "none" else None


@dataclass(frozen=True)
class Worked:
    """How arms of one kind are solved by hand, the constant ``WORKED`` of a module in `armlab.kin.ik.by_hand.arms`.

    Parameters
    ----------
    key, title : str
    order : int
        The first that fits an arm is used.
    fits : callable
        ``fits(arm)``: whether this derivation holds for the arm.
    write : callable
        ``write(work)`` adds the steps to a `armlab.kin.ik.by_hand.work.Work`.
    """

    key: str
    title: str
    order: int
    fits: Callable[[Arm], bool]
    write: Callable[..., None]
