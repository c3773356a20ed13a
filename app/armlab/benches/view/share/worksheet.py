"""A worksheet of an arm in its present configuration, for paper: table, matrices and numbers to check by hand."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.view.share.worksheet_formats import Latex, Markdown, Text, Writer
from armlab.benches.view.share.worksheet_symbols import COLUMN, jacobian_in_symbols, row_in_symbols, tool_in_symbols
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import Row, link_transform
from armlab.kin.ellipsoid import velocity_ellipsoid
from armlab.kin.graph.printing import Style
from armlab.kin.joint_scale import angular_size, counted_speeds, joint_scale, linear_size
from armlab.kin.length_power import length_power
from armlab.kin.rotations import axis_angle, euler_zyx
from armlab.kin.task import Task
from armlab.registry import known_name

Array = NDArray[np.float64]

FORMATS = ("markdown", "latex")
ANGLES = ("deg", "rad")

PRODUCTS = {
    "standard": Text("Aᵢ = Rz(θᵢ) Tz(dᵢ) Tx(aᵢ) Rx(αᵢ).", r"$A_i = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$."),
    "modified": Text(
        "Aᵢ = Rx(αᵢ₋₁) Tx(aᵢ₋₁) Rz(θᵢ) Tz(dᵢ).",
        r"$A_i = R_x(\alpha_{i-1})\,T_x(a_{i-1})\,R_z(\theta_i)\,T_z(d_i)$.",
    ),
}
"""Products of the four factors of a row, by convention."""

SHORT = Text("", r" In it $c_{12}$ is $\cos(q_1 + q_2)$, and $s_{12}$ the sine.")
"""The short forms of cosines and sines that only LaTeX uses."""

MINUS_ONE = Text("−1", "$-1$")

_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def worksheet(robot: Robot, q: ArrayLike, format: str = "markdown", *, angle: str = "deg") -> str:
    """Return the worksheet of a robot at a configuration.

    Title, table in the arm's own convention and its order, joint values, every A_i, the product T with base and tool,
    position and orientation, geometric and task Jacobian, and the measures of manipulability; all with units. A_i is
    also there in symbols, and T and the Jacobian where these are short.

    Parameters
    ----------
    robot : Robot
    q : array_like, shape (n,)
        Radians and metres.
    format : "markdown" or "latex"
        LaTeX is a complete article that needs amsmath, booktabs and geometry.
    angle : "deg" or "rad"
        Unit of angles in the table, the joint values and the orientation. Lengths are in metres; Jacobians are in
        radians.

    Returns
    -------
    str
        Four decimals; ends with a line break.

    Raises
    ------
    UnknownName
        Another format or unit.
    InputError
        q is not n finite numbers.

    References
    ----------
    Notes 4.10-4.16 (standard); Craig, *Introduction to Robotics*, 3.6 (modified); notes 5.52-5.65 and 5.144.
    """
    known_name("format", format, FORMATS)
    known_name("angle", angle, ANGLES)
    arm = robot.arm
    values = np.array(q, dtype=np.float64)
    if values.shape != (arm.n,) or not np.isfinite(values).all():
        raise InputError(f"q: expected {arm.n} finite numbers, got {values.tolist()}")
    sheet = _Sheet(Markdown() if format == "markdown" else Latex(), arm, values, angle == "deg")
    sheet.out.title(robot.name)
    for part in (sheet.table, sheet.joints, sheet.links, sheet.product, sheet.pose, sheet.jacobians, sheet.measures):
        part()
    return sheet.out.finished()


def task_jacobian(arm: Arm, q: ArrayLike) -> Array:
    """Return the rows of the geometric Jacobian that the arm's task controls, shape (m, n).

    In the axes of frame 0: the controlled coordinates, then the turns; for an approach direction those about the
    tool's x and y axes. Metres and radians per unit of each joint.
    """
    turn = arm.base[:3, :3].T
    J, tool = arm.jacobian(q), turn @ arm.fk(q)[:3, :3]
    turns = {"none": np.eye(3)[:0], "phi": np.eye(3)[2:], "approach": tool[:, :2].T, "full": np.eye(3)}
    linear, angular = turn @ J[:3], turn @ J[3:]
    return np.vstack([linear[arm.task.coordinates], turns[arm.task.rotation] @ angular])


class _Sheet:
    """The content of a worksheet, in either format."""

    def __init__(self, out: Writer, arm: Arm, q: Array, in_degrees: bool) -> None:
        self.out, self.arm, self.q, self.in_degrees = out, arm, q, in_degrees
        self.angle_unit = out.choose(Text("°", r"$^\circ$")) if in_degrees else "rad"
        self.standard = arm.convention == "standard"
        self.style: Style = out.choose(Text("text", "latex"))  # type: ignore[assignment]

    def turn(self, value: float) -> str:
        """Return an angle given in radians with its unit."""
        return self.out.degrees(math.degrees(value)) if self.in_degrees else f"{self.out.number(value)} rad"

    def table(self) -> None:
        """Write the columns in the order of the convention's factors, with lengths of a link first as in books."""
        out, link = self.out, "i" if self.standard else "i-1"
        book = "standard (distal), as Paul, Spong and Siciliano" if self.standard else "modified (proximal), as Craig"
        out.heading("Denavit-Hartenberg table")
        out.line(f"Convention: {book}. {out.choose(PRODUCTS[self.arm.convention])}")
        columns = {
            "a": f"{out.symbol('a', link)} [m]",
            "alpha": f"{out.symbol('alpha', link)} [{self.angle_unit}]",
            "d": f"{out.symbol('d', 'i')} [m]",
            "theta": f"{out.symbol('theta', 'i')} [{self.angle_unit}]",
        }
        order = ("a", "alpha", "d", "theta") if self.standard else ("alpha", "a", "d", "theta")
        body = [
            [f"{i + 1} {row.kind}", *(self._cell(row, i, field) for field in order)]
            for i, row in enumerate(self.arm.rows)
        ]
        out.table(["joint", *(columns[field] for field in order)], body)

    def _cell(self, row: Row, i: int, field: str) -> str:
        value: float = getattr(row, field)
        shown = math.degrees(value) if self.in_degrees and field in ("alpha", "theta") else value
        if field != ("theta" if row.revolute else "d"):
            return self.out.number(shown)
        variable = self.out.symbol("q", str(i + 1))
        return variable if value == 0.0 else self.out.plus(variable, shown)

    def joints(self) -> None:
        out = self.out
        out.heading("Joint values")
        body = []
        for i, (row, value) in enumerate(zip(self.arm.rows, self.q.tolist(), strict=True)):
            written = self.turn(value) if row.revolute else f"{out.number(value)} m"
            body.append([f"{i + 1} {row.kind}", out.symbol("q", str(i + 1)), written])
        out.table(["joint", "variable", "value"], body)

    def links(self) -> None:
        out = self.out
        out.heading("Transforms of the rows")
        out.line(f"{out.symbol('A', 'i')} is the pose of frame i in frame i{out.choose(MINUS_ONE)}; positions in m.")
        out.formulas(out.symbol("A", "i"), row_in_symbols(self.arm.convention, self.style))
        for i, (row, value) in enumerate(zip(self.arm.rows, self.q.tolist(), strict=True)):
            d, theta = (row.d, row.theta + value) if row.revolute else (row.d + value, row.theta)
            A = np.asarray(link_transform(row.a, row.alpha, d, theta, self.arm.convention), dtype=np.float64)
            out.matrix(out.symbol("A", str(i + 1)), A)

    def product(self) -> None:
        out = self.out
        out.heading("Pose of the tool")
        factors = [out.symbol("A", str(i + 1)) for i in range(self.arm.n)]
        for name, T, last in (("base", self.arm.base, False), ("tool", self.arm.tool, True)):
            if np.array_equal(T, np.eye(4)):
                continue
            symbol = out.symbol("T", name)
            factors = [*factors, symbol] if last else [symbol, *factors]
            out.matrix(symbol, T)
        out.line(f"{out.symbol('T')} = {' '.join(factors)} is the pose of the tool in the world; positions in m.")
        self._in_symbols(out.symbol("T"), tool_in_symbols(self.arm, self.style))
        out.matrix(out.symbol("T"), np.asarray(self.arm.fk(self.q), dtype=np.float64))

    def _in_symbols(self, symbol: str, entries: list[list[str]] | None) -> None:
        if entries is None:
            self.out.line(f"{symbol} in symbols is too long to read here.")
        else:
            short = self.out.choose(SHORT)
            self.out.line(f"{symbol} in symbols is in axes of frame 0, with the tool and without the base.{short}")
            self.out.formulas(symbol, entries)

    def pose(self) -> None:
        out = self.out
        T = self.arm.fk(self.q)
        point = ", ".join(out.number(float(value)) for value in T[:3, 3])
        out.line(f"Position {out.symbol('p')} = ({point}) m.")
        angles, singular = euler_zyx(T[:3, :3])
        yaw, pitch, roll = (self.turn(float(value)) for value in angles)
        rule = out.choose(
            Text("R = Rz(yaw) Ry(pitch) Rx(roll)", r"$R = R_z(\text{yaw})\,R_y(\text{pitch})\,R_x(\text{roll})$")
        )
        free = " Yaw and roll turn about one line here: only their sum or difference is determined." if singular else ""
        out.line(f"Orientation: yaw {yaw}, pitch {pitch}, roll {roll}, with {rule}.{free}")
        axis, turned = axis_angle(T[:3, :3])
        direction = ", ".join(out.number(float(value)) for value in axis)
        about = f" about the axis ({direction})" if float(turned) > 0.0 else ""
        out.line(f"The same as one turn: {self.turn(float(turned))}{about}.")

    def jacobians(self) -> None:
        out = self.out
        out.heading("Jacobians")
        out.line(
            "Geometric Jacobian at the tool point, in world axes. Rows: linear velocity x, y, z, then angular velocity "
            f"x, y, z. Columns: joints. {self._units_of_columns()}"
        )
        out.line(out.choose(COLUMN))
        self._in_symbols(out.symbol("J"), jacobian_in_symbols(self.arm, self.style))
        out.matrix(out.symbol("J"), np.asarray(self.arm.jacobian(self.q), dtype=np.float64))
        out.line(f"Task Jacobian, in the axes of frame 0. Rows: {', '.join(_row_names(self.arm.task))}.")
        out.matrix(out.symbol("J", "task"), task_jacobian(self.arm, self.q))

    def _units_of_columns(self) -> str:
        turning = "linear entries in m/rad, angular ones in rad/rad"
        sliding = "linear entries in m/m, angular ones in rad/m"
        if self.arm.revolute.all():
            return f"All joints turn: {turning}."
        if not self.arm.revolute.any():
            return f"All joints slide: {sliding}."
        return f"Columns of joints that turn (R): {turning}; of joints that slide (P): {sliding}."

    def measures(self) -> None:
        """Write singular values, separately for each kind of velocity, as metres and radians are not combined."""
        out, arm = self.out, self.arm
        out.heading("Manipulability")
        power = length_power(arm)
        unit = "terms of different units" if power is None else _power_of_metre(out, power)
        body = [[f"manipulability {out.symbol('w')} of the task", out.number(float(arm.manipulability(self.q))), unit]]
        J, p = task_jacobian(arm, self.q), len(arm.task.position)
        scale, speeds = counted_speeds(arm), joint_scale(arm)
        blocks = (
            ("linear velocity", J[:p], "m/s", linear_size(arm, speeds)),
            ("angular velocity", J[p:], "rad/s", angular_size(arm, speeds)),
        )
        for name, block, speed, size in blocks:
            if len(block) == 0:
                continue
            shape = velocity_ellipsoid(block, scale, size)
            each = "" if scale is not None else f" per {'rad/s' if arm.revolute.any() else 'm/s'}"
            body.append([f"{out.symbol('sigma', 'min')} of {name}", out.number(shape.sigma_min), f"{speed}{each}"])
            finite = math.isfinite(shape.condition)
            condition = out.number(shape.condition) if finite else out.choose(Text("∞", r"$\infty$"))
            body.append([f"condition of {name}", condition, "" if finite else "singular"])
        out.table(["measure", "value", "unit"], body)
        if scale is not None:
            listed = ", ".join(
                f"{out.number(float(value))} {'rad/s' if turns else 'm/s'}"
                for value, turns in zip(scale, arm.revolute, strict=True)
            )
            out.line(f"Singular values are of joint speeds measured by these limits: {listed}; w is not scaled.")


def _row_names(task: Task) -> list[str]:
    """Return the names of the velocities in the rows of the task Jacobian."""
    turns = {
        "none": (),
        "phi": ("turn about z",),
        "approach": ("turn about the tool's x", "turn about the tool's y"),
        "full": ("turn about x", "turn about y", "turn about z"),
    }
    return [*(f"velocity along {letter}" for letter in task.position), *turns[task.rotation]]


def _power_of_metre(out: Writer, power: int) -> str:
    if power in (0, 1):
        return "m" if power else ""
    return out.choose(Text("m" + str(power).translate(_POWERS), f"m$^{{{power}}}$"))
