"""Three turns about axes at right angles make a rotation: Euler angles with both signs of the middle one.

With z along the first axis and y along the second, where they are while all joint values are zero, what the three
turns have to make is Rz(phi) Ry(theta) Rz(psi):

    theta = atan2(± sqrt(r13² + r23²), r33),   phi = atan2(± r23, ± r13),   psi = atan2(± r32, -+ r31)

The three may be a spherical wrist, or the common turn of parallel axes and the two joints behind them.

References
----------
Notes 3.82-3.94, corrected; Siciliano et al., *Robotics*, 2.12.5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from armlab.kin.ik.by_hand.step import Arc, Branch, Line, Point, Quantity, Segment, Vector
from armlab.kin.ik.by_hand.turning import MARK, NIL
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed._turning import STRAIGHT
from armlab.kin.ik.screws import angle_about, cross, rotation
from armlab.kin.ik.trig import wrap

AXIS = 2.0
"""Length of a drawn axis, in radii of the arcs."""


@dataclass(frozen=True, eq=False)
class Turns:
    """Three turns and what they have to make.

    Attributes
    ----------
    axes : tuple of ndarray, shape (3,)
        Their axes at q = 0, in frame 0; neighbours at right angles.
    before : ndarray, shape (3, 3)
        The rotation that the joints before them make.
    whole : ndarray, shape (3, 3)
        The rotation that is left for the three, in frame 0 before it is turned by ``before``.
    centre : ndarray, shape (3,)
        Where it is drawn, frame 0.
    joints : tuple of int
        0-based; -1 for a first turn that several joints share.
    what : str
        The rotation that is left, in LaTeX.
    made : str
        How, in LaTeX.
    names : tuple of str
        Of the first and the last axis, in words.
    """

    axes: tuple[Vector, Vector, Vector]
    before: Vector
    whole: Vector
    centre: Vector
    joints: tuple[int, int, int]
    what: str
    made: str
    names: tuple[str, str]


def three_turns(work: Work, turns: Turns) -> float:
    """Find the three angles; return that of the first turn."""
    return _Euler(work, turns).found()


class _Euler:
    """The steps, one after the other."""

    def __init__(self, work: Work, turns: Turns) -> None:
        self.work, self.turns = work, turns
        first, second, third = turns.axes
        self.rest = angle_about(second, first, third)
        self.F = np.column_stack([cross(second, first), second, first])
        self.M = self.F.T @ turns.whole @ rotation(second, self.rest) @ self.F
        self.sine = math.hypot(self.M[0, 2], self.M[1, 2])
        self.straight = self.sine <= STRAIGHT

    def found(self) -> float:
        """Write all steps and return the first angle."""
        turns, M = self.turns, self.M
        r = [[float(value) for value in row] for row in M]
        self.work.add(
            f"R{turns.joints[1] + 1}",
            turns.what,
            f"What is left of the rotation, in axes with z along {turns.names[0]} and y along axis "
            f"{turns.joints[1] + 1}, all as they lie at zero",
            "product of rotations",
            {"M": Quantity(turns.what, tuple(value for row in r for value in row), "")},
            (Line("M", turns.made),),
            shapes=self._axes(),
        )
        self.k = 0 if self.straight else self.work.choose(f"q{turns.joints[1] + 1}", 2)
        self.sign = 1.0 if self.k == 0 else -1.0
        self.theta = math.atan2(0.0 if self.straight else self.sign * self.sine, r[2][2])
        self._angles(r)
        self._middle(r)
        if self.straight and turns.joints[0] < 0:
            self._last(r)
            self._first(r)
        else:
            self._first(r)
            self._last(r)
        return self.phi

    def _angles(self, r: list[list[float]]) -> None:
        """Set the first and the last angle; where only their sum or difference is fixed, one is kept."""
        if not self.straight:
            self.phi = math.atan2(self.sign * r[1][2], self.sign * r[0][2])
            self.psi = math.atan2(self.sign * r[2][1], -self.sign * r[2][0])
            return
        # Rz(phi) Rz(psi), or Rz(phi) Ry(pi) Rz(psi) = Rz(phi - psi) Ry(pi).
        same = r[2][2] > 0.0
        both = math.atan2(r[1][0], r[0][0]) if same else math.atan2(-r[1][0], -r[0][0])
        first, _, last = self.turns.joints
        if first >= 0:
            self.phi = self.work.kept(first)
            self.psi = wrap(both - self.phi if same else self.phi - both)
        else:
            self.psi = self.work.kept(last)
            self.phi = wrap(both - self.psi if same else both + self.psi)

    def _middle(self, r: list[list[float]]) -> None:
        joint = self.turns.joints[1]
        n = joint + 1
        angles = (self.theta,) if self.straight else (abs(self.theta), -abs(self.theta))
        branches = tuple(Branch(self._flip(wrap(angle - self.rest)), wrap(angle - self.rest)) for angle in angles)
        values = {name: Quantity(rf"r_{{{name[1:]}}}", r[i][2], "") for i, name in enumerate(("r13", "r23", "r33"))}
        values["theta"] = Quantity(rf"\theta_{n}", self.theta, "rad")
        lines = [Line("theta", r"\mathrm{atan2}(<sign>\sqrt{<r13>^2 + <r23>^2},\, <r33>)")]
        if abs(self.rest) > NIL:
            values["zero"] = Quantity(rf"\theta_{{{n},0}}", self.rest, "rad")
            values["q"] = Quantity(f"q_{n}", branches[self.k].value or 0.0, "rad")
            lines.append(Line("q", "<theta> - <zero>"))
        one, last = self.turns.names
        note = f"Wrist singularity: {one} and {last} coincide, and both signs give the same angle."
        A, B, _ = self._now()
        work = self.work
        work.add(
            f"q{n}",
            f"q_{n}",
            f"The angle between {one} and {last}, to either side",
            "Euler angles",
            values,
            tuple(lines),
            index=joint,
            branches=branches,
            chosen=self.k,
            case="merged" if self.straight else "two",
            note=note if self.straight else "",
            shapes=(*self._axes(), Arc(self.turns.centre, MARK * work.s.scale * A, B, self.theta, "theta")),
        )

    def _first(self, r: list[list[float]]) -> None:
        joint = self.turns.joints[0]
        free = self.straight and joint >= 0
        symbol = f"q_{joint + 1}" if joint >= 0 else r"\psi"
        A = self.turns.before @ self.turns.axes[0]
        x = self.turns.before @ self.F[:, 0]
        radius = MARK * self.work.s.scale
        one, last = self.turns.names
        values = {"phi": Quantity(symbol, self.phi, "rad")}
        if self.straight and not free:
            lines, note = self._both(values, r, "phi", "psi", self._last_symbol)
        else:
            lines, note = self._of(values, (r[1][2], r[0][2]), ("r23", "r13"), (1.0, 1.0), "phi")
        what = (
            f"Around {one}, the way to {last}" if joint >= 0 else f"Around {one}, the common turn of the three joints"
        )
        if free:
            lines = ()
            note = f"Only the sum or the difference of q{joint + 1} and q{self.turns.joints[2] + 1} is fixed: "
            note += f"q{joint + 1} may be any angle. The present one is kept."
        value = self.phi if joint >= 0 else None
        self.work.add(
            f"q{joint + 1}" if joint >= 0 else "psi",
            symbol,
            what,
            "Euler angles",
            values,
            lines,
            index=joint,
            branches=(Branch("as it is" if free else "", value),) if joint >= 0 else (),
            case="any" if free else "direct",
            note=note,
            shapes=(
                *self._axes(),
                Segment(self.turns.centre, self.turns.centre + AXIS * radius * x, "", "helper"),
                Arc(self.turns.centre, radius * x, A, self.phi, "phi"),
            ),
        )

    def _last(self, r: list[list[float]]) -> None:
        joint = self.turns.joints[2]
        free = self.straight and self.turns.joints[0] < 0
        n = joint + 1
        last = self.turns.names[1]
        values = {"psi": Quantity(f"q_{n}", self.psi, "rad")}
        lines: tuple[Line, ...] = ()
        note = ""
        if free:
            note = f"Only the sum or the difference of q{n} and the common turn is fixed: q{n} may be any angle. "
            note += "The present one is kept."
        elif self.straight:
            lines, note = self._both(values, r, "psi", "phi", f"q_{self.turns.joints[0] + 1}")
        else:
            lines, note = self._of(values, (r[2][1], -r[2][0]), ("r32", "r31"), (1.0, -1.0), "psi")
        C = self._now()[2]
        radius = MARK * self.work.s.scale
        mark = self._marker()
        self.work.add(
            f"q{n}",
            f"q_{n}",
            f"Around {last}, what is left",
            "Euler angles",
            values,
            lines,
            index=joint,
            branches=(Branch("as it is" if free else "", self.psi),),
            case="any" if free else "direct",
            note=note,
            shapes=(
                *self._axes(),
                Segment(self.turns.centre, self.turns.centre + AXIS * radius * mark, "", "helper"),
                Arc(self.turns.centre, radius * mark, C, self.psi, "psi"),
            ),
        )

    @property
    def _last_symbol(self) -> str:
        return f"q_{self.turns.joints[2] + 1}"

    def _of(
        self,
        values: dict[str, Quantity],
        numbers: tuple[float, float],
        names: tuple[str, str],
        signs: tuple[float, float],
        found: str,
    ) -> tuple[tuple[Line, ...], str]:
        """Return the line of an angle from two entries, with the sign of the middle angle."""
        for name, number, sign in zip(names, numbers, signs, strict=True):
            mark = r"\pm" if sign > 0.0 else r"\mp"
            values[name] = Quantity(rf"{mark} r_{{{name[1:]}}}", self.sign * number, "")
        return (Line(found, rf"\mathrm{{atan2}}(<{names[0]}>,\, <{names[1]}>)"),), ""

    def _both(
        self, values: dict[str, Quantity], r: list[list[float]], found: str, other: str, symbol: str
    ) -> tuple[tuple[Line, ...], str]:
        """Return the line of an angle that makes up for a free one."""
        same = r[2][2] > 0.0
        s = 1.0 if same else -1.0
        values["r21"] = Quantity("r_{21}" if same else "-r_{21}", s * r[1][0], "")
        values["r11"] = Quantity("r_{11}" if same else "-r_{11}", s * r[0][0], "")
        values[other] = Quantity(symbol, self.phi if other == "phi" else self.psi, "rad")
        turn = r"\mathrm{atan2}(<r21>,\, <r11>)"
        if same:
            return (Line(found, f"{turn} - <{other}>"),), ""
        return (Line(found, f"{turn} + <{other}>" if found == "phi" else f"<{other}> - {turn}"),), ""

    def _flip(self, value: float) -> str:
        """Return the word for the sign of the middle angle, as the names of solutions have it."""
        if self.straight:
            return "wrist straight"
        sine = math.sin(value + self.work.arm.rows[self.turns.joints[1]].theta)
        return "wrist no flip" if sine > 0.0 else "wrist flip"

    def _now(self) -> tuple[Vector, Vector, Vector]:
        """Return the three axes in frame 0 as the angles place them."""
        before, (A, B, C) = self.turns.before, self.turns.axes
        turned = before @ rotation(A, self.phi)
        middle = turned @ rotation(B, wrap(self.theta - self.rest))
        return np.asarray(before @ A), np.asarray(turned @ B), np.asarray(middle @ C)

    def _marker(self) -> Vector:
        """Return the direction from which the last angle counts, in frame 0."""
        A, B, _ = self.turns.axes
        mark = rotation(B, self.theta) @ self.F[:, 0]
        return np.asarray(self.turns.before @ rotation(A, self.phi) @ mark)

    def _axes(self) -> tuple[Segment | Point, ...]:
        """Return the first axis and the wanted last one."""
        at, length = self.turns.centre, AXIS * MARK * self.work.s.scale
        A = self.turns.before @ self.turns.axes[0]
        C = self.turns.before @ self.turns.whole @ self.turns.axes[2]
        return (
            Segment(at, at + length * A, "", "given"),
            Segment(at, at + length * C, "", "wanted"),
            Point(at + length * A, self.turns.names[0], "given"),
            Point(at + length * C, self.turns.names[1], "wanted"),
        )
