"""Place the frames of an arm by the Denavit-Hartenberg rules, and judge frames and tables that a person has made.

A person chooses for each frame the directions of z and x in one configuration; the rules of the standard convention
give the origins and so the whole table. Axes are taken as they are drawn: a sliding axis, whose place means nothing,
lies where the arm's own table puts it. Notes, section 4.1 with the corrections of `relations`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, wrong
from armlab.kin.convert import converted
from armlab.kin.dh import Row
from armlab.kin.graph.walker import SNAP
from armlab.kin.relations import axis_relations
from armlab.kin.transforms import as_pose, inverse, transform
from armlab.registry import known_name

Vector = NDArray[np.float64]

ANGLE_TOLERANCE = DIRECTION_TOLERANCE = 1e-3
"""Tolerance, in radians (0.06 degrees): within it an angle in a cell is right, and a direction given with three
decimals is taken as exact."""

LENGTH_TOLERANCE = 5e-4
"""Tolerance, in metres, of a length in a cell: half a millimetre."""

REACH_TOLERANCE = 1e-3
"""Tolerance of a length in a cell of a small arm, as a fraction of its reach."""

SCALE_TOLERANCE = 0.01
"""Relative tolerance for recognising a value that was typed in the wrong unit: two digits agree."""

Quantity = Literal["angle", "length"]
Mistake = Literal[
    "", "not a number", "sign", "half turn", "degrees", "radians", "millimetres", "metres", "swapped", "wrong"
]
CELLS: dict[str, Quantity] = {"a": "length", "alpha": "angle", "d": "length", "theta": "angle"}
SWAPS = (("a", "d"), ("alpha", "theta"))


@dataclass(frozen=True, eq=False)
class Choice:
    """The directions a person gives one frame, in the world; their length does not matter.

    Attributes
    ----------
    z, x : array_like, shape (3,)
    """

    z: ArrayLike
    x: ArrayLike


@dataclass(frozen=True)
class FrameVerdict:
    """Whether the directions of one frame obey the rules; the text says which rule is met or broken."""

    frame: int
    ok: bool
    text: str


@dataclass(frozen=True, eq=False)
class Assignment:
    """The table that belongs to legal choices.

    Attributes
    ----------
    rows : tuple of Row
        Standard convention; the variable's entry is its offset.
    base, tool : ndarray, shape (4, 4)
        Frame 0 in the world and the tool in frame n, both constant.
    reversed : tuple of int
        Joints, 1-based, whose z was chosen against the arm's axis: their joint value changes its sign.
    frames : ndarray, shape (n + 1, 4, 4)
        The frames in the world in the configuration they were chosen in.
    """

    rows: tuple[Row, ...]
    base: Vector
    tool: Vector
    reversed: tuple[int, ...]
    frames: Vector

    @property
    def signs(self) -> Vector:
        """Factors, 1 or -1, from the arm's joint values to those of this table, shape (n,)."""
        return np.array([-1.0 if i + 1 in self.reversed else 1.0 for i in range(len(self.rows))])

    def arm(self, like: Arm) -> Arm:
        """Return the arm of this table, with the limits, speeds and name of the arm it was made for."""
        turned = np.sort(like.limits * self.signs[:, None], axis=1)
        return Arm.from_dh(
            self.rows,
            base=self.base,
            tool=self.tool,
            limits=turned,
            speed_limits=like.speed_limits,
            acceleration_limits=like.acceleration_limits,
            name=like.name,
        )


@dataclass(frozen=True)
class CellVerdict:
    """Whether a cell of the table is right; ``mistake`` is the kind of mistake, and the text explains it."""

    ok: bool
    mistake: Mistake
    text: str


def own_choices(arm: Arm, q: ArrayLike) -> tuple[Choice, ...]:
    """Return the directions that the arm's own table, in the standard convention, gives its frames."""
    return tuple(Choice(T[:3, 2], T[:3, 0]) for T in _frames(converted(arm, "standard"), q))


def judge_frames(arm: Arm, q: ArrayLike, choices: Sequence[Choice]) -> tuple[FrameVerdict, ...]:
    """Return for each frame whether its directions obey the rules of the standard convention.

    z_i lies along the axis of joint i+1, in either sense; z_n is free. x_0 is any direction perpendicular to z_0. Each
    other x_i is perpendicular to z_{i-1} and z_i, and for parallel axes that are apart lies along the perpendicular
    between them, in either sense.

    Parameters
    ----------
    arm : Arm
        In any convention.
    q : array_like, shape (n,)
        The configuration the directions are chosen in.
    choices : sequence of n + 1 Choice

    Raises
    ------
    InputError
        Another number of choices, or a direction that is not three finite numbers or has no length.
    """
    standard = converted(arm, "standard")
    frames, directions = _frames(standard, q), _directions(choices, arm.n)
    return tuple(_judge_frame(i, standard, frames, *directions[i]) for i in range(arm.n + 1))


def expected_table(arm: Arm, q: ArrayLike, choices: Sequence[Choice]) -> Assignment:
    """Return the table, base and tool that belong to legal choices.

    Origins: O_0 where the arm has it. O_i where the common normal meets the axis of joint i+1. Where the axes are
    parallel the place is free: d_i is made zero, of a slide its offset. O_n as near to the arm's own O_n as x_n lets
    it: on the plane of x_n and the axis of joint n. The table moves the tool as the arm does, for all joint values.

    Parameters
    ----------
    arm, q, choices
        As for `judge_frames`.

    Raises
    ------
    InputError
        As `judge_frames`, and for choices that break a rule: the text is the verdict on the first such frame.
    """
    for verdict in judge_frames(arm, q, choices):
        if not verdict.ok:
            raise InputError(f"frame {verdict.frame}: {verdict.text}")
    standard = converted(arm, "standard")
    values, true = finite_floats(q, "q", (arm.n,), f"{arm.n} finite numbers"), _frames(standard, q)
    axes = _exact_axes(standard, true, _directions(choices, arm.n))
    against = tuple(i + 1 for i in range(arm.n) if axes[i][0] @ true[i, :3, 2] < 0.0)
    signed = np.array([-value if i + 1 in against else value for i, value in enumerate(values)])
    origins = _origins(standard, true, axes, signed)
    frames = np.array([_frame(z, x, p) for (z, x), p in zip(axes, origins, strict=True)])
    rows = tuple(_row(standard, i, frames[i], frames[i + 1], float(signed[i])) for i in range(arm.n))
    base, tool = _tidied(frames[0]), _tidied(inverse(frames[-1]) @ true[-1] @ standard.tool)
    return Assignment(rows, as_pose(base, "base"), as_pose(tool, "tool"), against, frames)


def length_tolerance(arm: Arm) -> float:
    """Return the tolerance, in metres, of a length in a cell of this arm: at most half a millimetre."""
    return min(LENGTH_TOLERANCE, REACH_TOLERANCE * 2.0 * arm.length_scale)


def judge_cell(expected: float, got: float | None, kind: Quantity, tolerance: float = LENGTH_TOLERANCE) -> CellVerdict:
    """Return whether a cell is right, or the name of the mistake.

    Parameters
    ----------
    expected : float
        Radians or metres.
    got : float or None
        Radians or metres; None or not finite where no number was given.
    kind : "angle" or "length"
        Angles may differ by a full turn.
    tolerance : float
        Metres, of lengths; see `length_tolerance`.
    """
    if kind not in ("angle", "length"):
        raise UnknownName("kind", kind, ("angle", "length"))
    if got is None or not math.isfinite(got):
        return CellVerdict(False, "not a number", "a number is missing here")
    if _same(expected, got, kind, tolerance):
        return CellVerdict(True, "", "right")
    for mistake, value, text in _shifted(expected, kind):
        if _same(value, got, kind, tolerance):
            return CellVerdict(False, mistake, text)
    for mistake, value, text in _scaled(expected, kind):
        if value != 0.0 and abs(got / value - 1.0) <= SCALE_TOLERANCE:
            return CellVerdict(False, mistake, text)
    return CellVerdict(False, "wrong", "not the value that belongs to these frames")


def judge_row(
    expected: Row, got: Mapping[str, float | None], tolerance: float = LENGTH_TOLERANCE
) -> dict[str, CellVerdict]:
    """Return the verdicts on the cells a, alpha, d and theta of a row; values in swapped cells are recognised.

    The tolerance of lengths is in metres.

    Raises
    ------
    InputError
        A cell that a row does not have; a cell left out counts as "not a number".
    """
    for name in got:
        known_name("cell", name, CELLS)
    verdicts = {
        name: judge_cell(getattr(expected, name), got.get(name), kind, tolerance) for name, kind in CELLS.items()
    }
    for first, second in SWAPS:
        crossed = judge_cell(getattr(expected, first), got.get(second), CELLS[first], tolerance)
        other = judge_cell(getattr(expected, second), got.get(first), CELLS[second], tolerance)
        if crossed.ok and other.ok and not (verdicts[first].ok and verdicts[second].ok):
            swapped = CellVerdict(False, "swapped", f"{first} and {second} have changed places")
            verdicts |= {first: swapped, second: swapped}
    return verdicts


def _same(expected: float, got: float, kind: Quantity, tolerance: float) -> bool:
    if kind == "length":
        return abs(got - expected) <= tolerance
    # One turn, not any number of them: 90 (degrees) is 2.04 rad and fourteen turns, and means something else.
    return min(abs(got - expected - turn) for turn in (0.0, math.tau, -math.tau)) <= ANGLE_TOLERANCE


def _shifted(expected: float, kind: Quantity) -> list[tuple[Mistake, float, str]]:
    """Return mistakes of direction as (mistake, the value it leads to, text), the likelier first."""
    sign: tuple[Mistake, float, str] = ("sign", -expected, "the sign is wrong")
    if kind == "length":
        return [sign]
    # The other half turn is a full turn away from this one.
    return [sign, ("half turn", expected + math.pi, "half a turn off: an axis points the other way")]


def _scaled(expected: float, kind: Quantity) -> list[tuple[Mistake, float, str]]:
    """Return mistakes of unit as (mistake, the value it leads to, text)."""
    if kind == "length":
        return [
            ("millimetres", 1000.0 * expected, "this is the value in millimetres, not in metres"),
            ("metres", expected / 1000.0, "this is a thousandth: the value in metres where millimetres are expected"),
        ]
    return [
        ("degrees", math.degrees(expected), "this is the value in degrees, not in radians"),
        ("radians", math.radians(expected), "this is the value in radians where degrees are expected"),
    ]


def _frames(standard: Arm, q: ArrayLike) -> Vector:
    values = finite_floats(q, "q", (standard.n,), f"{standard.n} finite numbers")
    return np.asarray(standard.frames(values), dtype=np.float64)


def _directions(choices: Sequence[Choice], n: int) -> list[tuple[Vector, Vector]]:
    """Return the unit vectors (z, x) of the choices."""
    if len(choices) != n + 1:
        raise InputError(f"choices: expected {n + 1}, for frames 0 to {n}, got {len(choices)}")
    return [(_unit(c.z, f"frame {i}, z"), _unit(c.x, f"frame {i}, x")) for i, c in enumerate(choices)]


def _unit(direction: ArrayLike, where: str) -> Vector:
    vector = finite_floats(direction, where, (3,), "a direction, three finite numbers")
    length = float(np.linalg.norm(vector))
    if length == 0.0:
        raise wrong(where, "a direction that is not zero", direction)
    return vector / length


def _judge_frame(i: int, standard: Arm, frames: Vector, z: Vector, x: Vector) -> FrameVerdict:
    """Judge one frame against the axes of joints i and i+1, which are z_{i-1} and z_i of the arm's own frames."""
    n, relations = standard.n, axis_relations(standard)
    if i < n and (angle := _from_line(z, frames[i, :3, 2])) > DIRECTION_TOLERANCE:
        return FrameVerdict(i, False, f"z{i} must lie along the axis of joint {i + 1}: it is {_degrees(angle)} away")
    crooked = _crooked(i, i, x, z) or (_crooked(i, i - 1, x, frames[i - 1, :3, 2]) if i else "")
    if crooked:
        return FrameVerdict(i, False, crooked)
    if not 0 < i < n or relations[i - 1].kind == "coincident":
        return FrameVerdict(i, True, f"x{i} is perpendicular to {f'z{i - 1} and ' if i else ''}z{i}")
    angle = _from_line(x, frames[i, :3, 0])
    if angle > DIRECTION_TOLERANCE:
        normal = f"the common normal of the axes of joints {i} and {i + 1}"
        slides = [j for j in (i, i + 1) if not standard.rows[j - 1].revolute]
        if relations[i - 1].kind == "parallel" and slides:  # lawful for another place of the slide's axis
            text = (
                f"joint {slides[-1]} slides and its axis is taken where it is drawn: with it, x{i} lies along {normal}"
            )
            return FrameVerdict(i, False, f"{text}, {_degrees(angle)} away")
        return FrameVerdict(i, False, f"x{i} must lie along {normal}: it is {_degrees(angle)} away")
    where = f"parallel to z{i - 1} × z{i}" if relations[i - 1].kind == "intersecting" else "along the common normal"
    return FrameVerdict(i, True, f"z{i} lies along the axis of joint {i + 1} and x{i} {where}")


def _crooked(i: int, j: int, x: Vector, z: Vector) -> str:
    """Return the sentence on an x_i that is not perpendicular to z_j; empty when it is."""
    angle = _from_line(x, z)
    if abs(angle - math.pi / 2) <= DIRECTION_TOLERANCE:
        return ""
    seen = "it points along it" if angle <= DIRECTION_TOLERANCE else f"the angle between them is {_degrees(angle)}"
    return f"x{i} must be perpendicular to z{j}: {seen}"


def _from_line(v: Vector, line: Vector) -> float:
    """Return the angle between a unit vector and a line, 0 to pi/2."""
    return math.atan2(float(np.linalg.norm(np.cross(v, line))), abs(float(v @ line)))


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.3g}°"


def _exact_axes(standard: Arm, true: Vector, chosen: list[tuple[Vector, Vector]]) -> list[tuple[Vector, Vector]]:
    """Return z and x of each frame without the small errors that a legal choice may have."""
    n, relations, axes = standard.n, axis_relations(standard), []
    for i, (z, x) in enumerate(chosen):
        if i < n:
            z = math.copysign(1.0, z @ true[i, :3, 2]) * true[i, :3, 2]
        if 0 < i < n and relations[i - 1].kind != "coincident":
            x = math.copysign(1.0, x @ true[i, :3, 0]) * true[i, :3, 0]
        else:
            square = true[i - 1, :3, 2] if i else z
            x = x - (x @ square) * square
            x /= np.linalg.norm(x)
        if i == n:
            z = z - (z @ x) * x
            z /= np.linalg.norm(z)
        axes.append((z, x))
    return axes


def _origins(standard: Arm, true: Vector, axes: list[tuple[Vector, Vector]], signed: Vector) -> list[Vector]:
    """Return the origins; where the axes are not parallel, the frames of the arm itself stand on the common normals."""
    relations, origins = axis_relations(standard), [true[0, :3, 3]]
    for i in range(1, standard.n):
        place = true[i, :3, 3]
        if relations[i - 1].kind in ("parallel", "coincident"):
            z = axes[i - 1][0]
            moved = 0.0 if standard.rows[i - 1].revolute else float(signed[i - 1])
            place = place + ((origins[-1] - place) @ z + moved) * z
        origins.append(place)
    z, x, end = axes[-2][0], axes[-1][1], true[-1, :3, 3]
    offset = end - origins[-1]
    origins.append(origins[-1] + (offset @ z) * z + (offset @ x) * x)
    return origins


def _frame(z: Vector, x: Vector, p: Vector) -> Vector:
    return np.asarray(transform(np.column_stack([x, np.cross(z, x), z]), p), dtype=np.float64)


def _row(standard: Arm, i: int, before: Vector, after: Vector, q: float) -> Row:
    """Return row i+1 from the frames before and after it; the joint value is subtracted from the joint's own entry."""
    kind = standard.rows[i].kind
    z, x, shift = before[:3, 2], after[:3, 0], after[:3, 3] - before[:3, 3]
    theta = math.atan2(x @ before[:3, 1], x @ before[:3, 0]) - (q if kind == "R" else 0.0)
    alpha = math.atan2(np.cross(z, after[:3, 2]) @ x, z @ after[:3, 2])
    d = float(shift @ z) - (q if kind == "P" else 0.0)
    small = SNAP * standard.length_scale
    a, d = (0.0 if abs(value) < small else value for value in (float(shift @ x), d))
    return Row(kind, a, _neat(alpha), d, _neat(theta))


def _neat(angle: float) -> float:
    """Return an angle in (-pi, pi] in which quarter turns are exact."""
    wrapped = math.pi - (math.pi - angle) % math.tau
    quarter = round(wrapped / (math.pi / 2))
    if abs(wrapped - quarter * math.pi / 2) > SNAP:
        return wrapped
    return math.pi if quarter == -2 else quarter * math.pi / 2


def _tidied(pose: Vector) -> Vector:
    nearest = np.round(pose)
    return np.where(np.abs(pose - nearest) < SNAP, nearest, pose) + 0.0
