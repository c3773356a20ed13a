"""The structure of an arm: which closed form of the inverse kinematics it has, and which axes cause it.

Everything is read off the table (links a and alpha, offsets d, joint types), so it holds in every configuration.
Tolerances are those of `relations`: an angle, and a length relative to the arm.

The numbers of solutions hold without joint limits, for a target that is not singular, and only where the task leaves
nothing free. They are upper bounds, with these reasons:

*   Planar part: 2R, RP and PR cut two circles, or a circle and a line; with the angle given, a third joint changes
    nothing (notes 4.44-4.65).
*   Three joints that place a point: the orbit of the point under joint 3 (a circle or a line) cuts the surface that
    the target sweeps when joints 1 and 2 are undone. Two turns sweep a torus-like surface of degree 4 that holds the
    imaginary circle at infinity twice; a circle cuts it in 4 other points, a line in 4. A turn and a slide sweep a
    quadric, 4 and 2; two slides a plane, 2 and 1. Pieper 1968; notes 4.66-4.105 for RRP and 3R.
*   Three turns about axes through one point: an orientation in at most 2 ways. The point where they meet is placed by
    the other three joints alone, wherever in the chain the three are, so the numbers multiply (Pieper 1968).
*   Three neighbouring parallel axes of a 6R: 8. Undoing the joints behind the three and those before them, the other
    three turns R1, R2, R3 must carry the direction e behind the parallel axes into the direction u before them and
    give one point its height along u. With w = R1^T u and v = R3 e this is R2 v = w; it needs w.z2 = v.z2, and the
    height is const + w.p1 + v.p2, p1 and p2 being the constant ways from axis to axis: R2 falls out, as R2^T w = v.
    Both equations are linear in (cos q1, sin q1, cos q3, sin q3), so two circles become two conics in a plane, which
    cut in 4 points; each gives one q2, and the planar 3R that is left has 2 solutions. The notes' UR (figure 4.8) is
    the case in which q1 stands alone.
*   A planar part with slides: as above. Two of the turns outside it make its direction (2) where a third joint, a
    slide inside or outside, makes the height (1); three turns and the height 4. Times the ways of the planar part.
*   Three slides: the turns alone make the orientation (three: 2, two: 2 for a direction, one: 1), then everything is
    linear (1).
*   General 6R: 16. Lee and Liang 1988, Raghavan and Roth 1990; Manseur and Doty 1989 show an arm that has them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.lines import PARALLEL_ANGLE
from armlab.kin.relations import Axes, is_zero_length
from armlab.kin.spare import spare_joints

MOST_6R = 16


@dataclass(frozen=True)
class Structure:
    """The kind of solution of the inverse kinematics that an arm has.

    Attributes
    ----------
    key, title : str
    closed_form : bool
        Whether a closed form follows from the geometry; where joints are left over, with as many of them fixed.
        False says only that none of the sufficient conditions known here holds.
    why : str
        Sentences that name the axes, 1-based.
    most_solutions : int or None
        Upper bound of the number of solutions of the arm's task; None where there is a family of them or no bound is
        known here.
    joints : tuple of int
        The joints the reason rests on, 1-based.
    free : int
        Dimension of the family of solutions of the arm's task.
    """

    key: str
    title: str
    closed_form: bool
    why: str
    most_solutions: int | None
    joints: tuple[int, ...]
    free: int = 0


def structure_of(arm: Arm) -> Structure:
    """Return the structure of an arm: the first of the known ones that its table shows.

    References
    ----------
    Pieper 1968; notes, section 4.3.2; Siciliano et al., *Robotics*, 2.12.

    Examples
    --------
    >>> structure_of(Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)])).most_solutions
    2
    """
    axes = Axes(arm)
    found = _found(axes)
    spare = spare_joints(arm)
    if not spare.free:
        return found
    number = _NUMBERS.get(spare.free, str(spare.free))
    family = (
        f"The task, {arm.task.title}, leaves {spare.free} of {arm.n} joints free: "
        f"a {number}-parameter family, infinitely many solutions."
    )
    sentences, closed = [found.why, family], found.closed_form
    if not closed:
        rests = ((fixed, _found(Axes(left))) for fixed, left in spare.with_fixed(special=True))
        known = next(((fixed, rest) for fixed, rest in rests if rest.closed_form), None)
        closed = known is not None
        general = found.key in ("general", "general_6r")
        last = _with_fixed(*known, arm.n) if known else f"With {number} fixed, {_NONE[0].lower()}{_NONE[1:]}"
        sentences = [*([] if general else [found.why]), family, last]
    why = " ".join(sentence for sentence in sentences if sentence)
    return replace(found, why=why, closed_form=closed, most_solutions=None, free=spare.free)


_NUMBERS = {1: "one", 2: "two", 3: "three", 4: "four", 5: "five", 6: "six"}

_NONE = (
    "None of the sufficient conditions known to this lab was found: three revolute axes through one point, a planar "
    "part of three joints, three prismatic joints."
)


def _found(axes: Axes) -> Structure:
    return next(structure for find in _FINDERS if (structure := find(axes)) is not None)


def _with_fixed(fixed: tuple[int, ...], rest: Structure, n: int) -> str:
    """Return the sentence on the structure that remains of an arm of n joints; ``rest`` is without fixed ones."""
    kept = [k for k in range(1, n + 1) if k not in fixed]
    named = [kept[k - 1] for k in rest.joints]
    where = f" ({'joint' if len(named) == 1 else 'joints'} {_listed(named)})" if named else ""
    return f"With {'joint' if len(fixed) == 1 else 'joints'} {_listed(fixed)} fixed: {rest.title}{where}."


def _single(axes: Axes) -> Structure | None:
    if axes.arm.n != 1:
        return None
    if axes.kinds == "P":
        return Structure("single", "One prismatic joint", True, "The position is linear in the joint value.", 1, (1,))
    turned = axes.arm.task.rotation in ("phi", "full")
    why = (
        "The angle gives the joint value, up to its sign and a constant."
        if turned
        else "The tool point moves on a circle."
    )
    return Structure("single", "One revolute joint", True, why, 1 if turned else 2, (1,))


def _cartesian(axes: Axes) -> Structure | None:
    if "R" in axes.kinds:
        return None
    why = "All joints are prismatic: the position is linear in the joint values."
    return Structure("cartesian", "Cartesian arm", True, why, 1, _joints(axes))


def _planar(axes: Axes) -> Structure | None:
    """Return the structure of an arm whose revolute axes are parallel: planar, alone or with a lift; None otherwise."""
    lifts = axes.beside_plane
    if lifts is None:
        return None
    flat = [i for i in _joints(axes) if i not in lifts]
    kinds = "".join(axes.kinds[i - 1] for i in flat)
    closed = len(flat) <= 3 and len(lifts) <= 1
    two = kinds.count("P") <= (0 if len(kinds) == 1 else 1)
    most = (2 if two else 1) if closed else None
    planar = f"{len(kinds)}R" if set(kinds) == {"R"} else kinds
    turning = [i for i in flat if axes.kinds[i - 1] == "R"]
    why = f"{_axes(turning)} are parallel" if len(turning) > 1 else f"joint {turning[0]} is the only revolute one"
    sliding = [i for i in flat if i not in turning]
    if sliding:
        why += f" and {_slides(sliding)} at a right angle to {'them' if len(turning) > 1 else 'its axis'}"
    if not lifts:
        why = f"{why}: the arm moves in a plane."
        return Structure("planar", f"Planar {planar}", closed, _capital(why), most, _joints(axes))
    why += (
        f"; {_slides(lifts)} parallel to {'them' if len(turning) > 1 else 'it'}: height and planar {planar} separate."
    )
    key, title = ("cylindrical", "Cylindrical arm") if len(turning) == 1 else ("scara", "SCARA")
    return Structure(key, title, closed, _capital(why), most, _joints(axes))


def _three_joints(axes: Axes) -> Structure | None:
    if axes.arm.n != 3:
        return None
    if axes.meet(1):
        why = (
            "Axes 1, 2 and 3 meet in one point: the tool rotates about it and takes each orientation in at most "
            "two ways."
        )
        most = 2 if axes.arm.task.rotation == "full" else None
        return Structure("wrist", "Spherical wrist alone", True, why, most, (1, 2, 3))
    most = _ways(axes.kinds) if _position_only(axes) else None
    if axes.turns(1, 3) and axes.perpendicular(1) and axes.parallel(2) and not axes.touching(2):
        why = "Axis 1 is perpendicular to the parallel axes 2 and 3: joint 1 turns the plane of a 2R."
        return Structure("elbow", "Elbow (anthropomorphic) arm", True, why, most, (1, 2, 3))
    crossed = axes.perpendicular(1) and axes.perpendicular(2) and axes.touching(1)
    if axes.kinds == "RRP" and crossed:
        why = (
            "Axes 1 and 2 meet at a right angle and joint 3 slides at a right angle to axis 2: two angles and a length."
        )
        return Structure("polar", "Polar (spherical) arm", True, why, most, (1, 2, 3))
    why = "Three joints place the tool point: a polynomial of degree four at most (Pieper)."
    return Structure("positioning", f"Positioning arm {axes.kinds}", True, why, most, (1, 2, 3))


def _two_joints(axes: Axes) -> Structure | None:
    if axes.arm.n != 2:
        return None
    why = "The path of the tool point under joint 2 cuts the path of the target under joint 1, two circles or lines."
    most = 2 if _position_only(axes) else None
    return Structure("two_joints", f"Two joints {axes.kinds}", True, why, most, (1, 2))


def _turning_plane(axes: Axes) -> Structure | None:
    n = axes.arm.n
    if n not in (4, 5) or not axes.turns(1, n) or not axes.three_parallel(2) or not axes.perpendicular(1):
        return None
    if n == 5 and not axes.perpendicular(4):
        return None
    why = "Axes 2, 3 and 4 are parallel and axis 1 is perpendicular to them: joint 1 turns the plane of a 3R"
    why += ", and joint 5 rotates the tool about an axis in that plane." if n == 5 else "."
    most = 4 if axes.arm.task.key == "pose" else None
    return Structure("turning_plane", f"{n}R with a turning plane", True, why, most, (1, 2, 3, 4))


def _seven_and_more(axes: Axes) -> Structure | None:
    if axes.arm.n < 7:
        return None
    if axes.arm.n == 7 and axes.turns(1, 7) and axes.meet(1) and axes.meet(5):
        why = (
            "Axes 1, 2 and 3 meet in one point (shoulder) and axes 5, 6 and 7 in another (wrist): their distance gives "
            "q4, and the elbow turns about the line between them, by an angle that may be chosen."
        )
        return Structure("srs", "S-R-S arm", True, why, None, (1, 2, 3, 5, 6, 7))
    triple, fact = axes.last_triple(axes.meet), "meet in one point"
    if triple is None:
        triple, fact = axes.last_triple(axes.three_parallel), "are parallel"
    why = _capital(f"{_axes(_three(triple))} {fact}.") if triple else ""
    return Structure("redundant", "Redundant arm", False, why, None, _three(triple) if triple else ())


def _meeting(axes: Axes) -> Structure | None:
    i, n = axes.last_triple(axes.meet), axes.arm.n
    if i is None:
        return None
    last = i == n - 2
    # Undoing the joints behind the three brings them in front of those before the three.
    others = axes.kinds[i + 2 :] + axes.kinds[: i - 1]
    most = 2 * _ways(others) if n == 6 and axes.arm.task.key == "pose" else None
    why = f"{_axes(_three(i))} meet in one point: position and orientation separate (Pieper)."
    key, title = ("spherical_wrist", "Spherical wrist") if last else ("three_meeting", "Three axes through one point")
    return Structure(key, title, True, _capital(why), most, _three(i))


def _parallel(axes: Axes) -> Structure | None:
    i = axes.last_triple(axes.three_parallel)
    if i is None:
        return None
    why = f"{_axes(_three(i))} are parallel: they form a planar 3R, and the other joints separate from it (Pieper)."
    most = _ways_around(axes, list(_three(i)), [])
    return Structure("three_parallel", "Three parallel axes", True, _capital(why), most, _three(i))


def _ways_around(axes: Axes, run: list[int], lifts: list[int]) -> int | None:
    """Return the largest number of solutions of a pose with a planar part in the run; None when none is known."""
    if axes.arm.n != 6 or axes.arm.task.key != "pose":
        return None
    slides = sum(axes.kinds[j - 1] == "P" for j in _joints(axes) if j not in run)
    across = sum(axes.kinds[j - 1] == "P" for j in run if j not in lifts)
    outside = {(0, 0): 4, (0, 1): 2, (1, 0): 2}.get((len(lifts), slides))
    return None if outside is None else outside * (1 if across == 2 else 2)


def _three_slides(axes: Axes) -> Structure | None:
    n = axes.arm.n
    if n not in (4, 5, 6) or axes.kinds.count("P") != 3:
        return None
    sliding = [i for i in _joints(axes) if axes.kinds[i - 1] == "P"]
    alone = (
        "revolute joint determines the angle"
        if n == 4
        else f"{_NUMBERS[n - 3]} revolute joints determine the orientation"
    )
    why = f"{_capital(_slides(sliding))}: the {alone}, then the position is linear."
    most = {(4, "xyz phi"): 1, (5, "xyz approach"): 2, (6, "pose"): 2}.get((n, axes.arm.task.key))
    if n == 4 and not _about_z(axes, axes.kinds.index("R") + 1):
        most = None
    return Structure("three_slides", "Three prismatic joints", True, why, most, tuple(sliding))


def _about_z(axes: Axes, i: int) -> bool:
    """Return whether the axis of joint i, with only prismatic joints before it, is parallel to z of frame 0."""
    whole = axes.arm.frames(np.zeros(axes.arm.n))
    turned = whole[i - 1 if axes.arm.convention == "standard" else i, :3, 2]
    return bool(np.linalg.norm(np.cross(turned, whole[0, :3, 2])) <= PARALLEL_ANGLE)


def _planar_part(axes: Axes) -> Structure | None:
    """Return the structure with three neighbouring joints that move in a plane, with lifts or slides, or None."""
    for size in (4, 3):
        for i in range(axes.arm.n - size + 1, 0, -1):
            run = list(range(i, i + size))
            lifts = axes.lifts(i, i + size - 1)
            if lifts is not None and len(lifts) == size - 3 and _apart(axes, run, lifts):
                return _with_planar_part(axes, run, lifts)
    return None


def _apart(axes: Axes, run: list[int], lifts: list[int]) -> bool:
    """Return whether no two revolute joints in succession, lifts between them aside, have one axis."""
    flat = [j for j in run if j not in lifts]
    for j, k in pairwise(flat):
        if axes.kinds[j - 1] + axes.kinds[k - 1] != "RR":
            continue
        # The second link is turned against the first by the constant angle of the lift between them.
        way: complex = axes.links[j][0]
        if k == j + 2:
            way += axes.links[j + 1][0] * np.exp(1j * axes.arm.rows[j].theta)
        if is_zero_length(abs(way), axes.arm):
            return False
    return True


def _with_planar_part(axes: Axes, run: list[int], lifts: list[int]) -> Structure:
    flat = [j for j in run if j not in lifts]
    kinds = "".join(axes.kinds[j - 1] for j in flat)
    planar = "3R" if kinds == "RRR" else kinds
    why = f"joints {_listed(flat)} form a planar {planar}"
    why += f" and {_slides(lifts)} at a right angle to its plane" if lifts else ""
    why = f"{_capital(why)}: the other joints separate from it."
    return Structure("planar_part", f"Planar {planar} inside", True, why, _ways_around(axes, run, lifts), tuple(run))


def _general(axes: Axes) -> Structure:
    n = axes.arm.n
    if axes.kinds == "RRRRRR":
        most = MOST_6R if axes.arm.task.key == "pose" else None
        why = f"{_NONE} A polynomial of degree at most {MOST_6R} remains."
        return Structure("general_6r", "General 6R", False, why, most, ())
    return Structure("general", f"General arm of {n} joints", False, _NONE, None, ())


_FINDERS: tuple[Callable[[Axes], Structure | None], ...] = (
    _single,
    _cartesian,
    _planar,
    _two_joints,
    _three_joints,
    _turning_plane,
    _seven_and_more,
    _meeting,
    _parallel,
    _three_slides,
    _planar_part,
    _general,
)
"""Tests from the special to the general structure; the last one always succeeds."""


def _ways(kinds: str) -> int:
    """Return the largest number of ways in which three joints of these types can position a point."""
    slides = kinds.count("P")
    return 4 if slides <= 1 else 3 - slides + 1


def _position_only(axes: Axes) -> bool:
    return axes.arm.task.position == "xyz" and axes.arm.task.rotation == "none"


def _joints(axes: Axes) -> tuple[int, ...]:
    return tuple(range(1, axes.arm.n + 1))


def _three(i: int) -> tuple[int, int, int]:
    return i, i + 1, i + 2


def _listed(joints: tuple[int, ...] | list[int]) -> str:
    *front, last = map(str, joints)
    return f"{', '.join(front)} and {last}" if front else last


def _axes(joints: tuple[int, ...] | list[int]) -> str:
    return f"axes {_listed(joints)}"


def _slides(joints: list[int]) -> str:
    return f"joint {joints[0]} slides" if len(joints) == 1 else f"joints {_listed(joints)} slide"


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]
