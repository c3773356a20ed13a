"""Which closed form of the inverse kinematics an arm has, and which of its axes give it.

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
*   Axes 2, 3, 4 parallel, 5 perpendicular to them and meeting 6: the component of the point of axes 5 and 6 along the
    parallel axes gives q1 (2), the angle between axis 6 and them q5 (2), then q6 (1) and a planar 3R (2): 8 (notes,
    figure 4.8). Mirrored the same for 3, 4, 5.
*   Three slides of six joints: the turns alone make the orientation (2), then everything is linear (1).
*   General 6R: 16. Lee and Liang 1988, Raghavan and Roth 1990; Manseur and Doty 1989 show an arm that has them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.relations import Axes

SAMPLES = 8
"""Random configurations, one seed, that stand for the generic one."""

RANK_TOLERANCE = 1e-9
"""Singular values of the task Jacobian, lengths over the arm's length scale, below this are zero."""

MOST_6R = 16


@dataclass(frozen=True)
class Structure:
    """How the inverse kinematics of an arm can be solved.

    Attributes
    ----------
    key, title : str
    closed_form : bool
        Whether a closed form follows from the geometry; where joints are left over, for the hand's other components
        given. False says only that none of the known sufficient conditions holds.
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
    found = next(structure for find in _FINDERS if (structure := find(axes)) is not None)
    free = _free(arm)
    if not free:
        return found
    spare = f"The task, {arm.task.title}, leaves {free} of {arm.n} joints free: a {free}-parameter family of solutions."
    return replace(found, why=f"{found.why} {spare}", most_solutions=None, free=free)


def _free(arm: Arm) -> int:
    """Return the joints the task leaves over: n minus the rank of the task Jacobian in a generic configuration."""
    rng = np.random.default_rng(0)
    samples = rng.uniform(-3.0, 3.0, (SAMPLES, arm.n))
    return arm.n - max(int(np.linalg.matrix_rank(_task_jacobian(arm, q), tol=RANK_TOLERANCE)) for q in samples)


def _task_jacobian(arm: Arm, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rows the task controls, in the axes of frame 0, lengths over the length scale; shape (m, n)."""
    turn = arm.base[:3, :3].T
    J = arm.jacobian(q)
    linear, angular = turn @ J[:3] / arm.length_scale, turn @ J[3:]
    tool = turn @ arm.fk(q)[:3, :3]
    rotation = {"none": np.eye(3)[:0], "phi": np.eye(3)[2:], "approach": tool[:, :2].T, "full": np.eye(3)}
    return np.vstack([linear[arm.task.coordinates], rotation[arm.task.rotation] @ angular])


def _single(axes: Axes) -> Structure | None:
    if axes.arm.n != 1:
        return None
    if axes.kinds == "P":
        return Structure("single", "One slide", True, "The position is linear in the joint value.", 1, (1,))
    turned = axes.arm.task.rotation in ("phi", "full")
    why = "The angle is the joint value." if turned else "The tool point moves on a circle."
    return Structure("single", "One turn", True, why, 1 if turned else 2, (1,))


def _cartesian(axes: Axes) -> Structure | None:
    if "R" in axes.kinds:
        return None
    why = "All joints slide: the position is linear in the joint values."
    return Structure("cartesian", "Cartesian arm", True, why, 1, _joints(axes))


def _planar(axes: Axes) -> Structure | None:
    """Find the arms whose turns have one direction: a planar arm, alone or with a lift."""
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
    why = f"{_axes(turning)} are parallel" if len(turning) > 1 else f"joint {turning[0]} is the only one that turns"
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
        why = "Axes 1, 2 and 3 meet in one point: the hand turns about it, each orientation in at most two ways."
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
    why += ", and joint 5 rolls the hand about an axis in that plane." if n == 5 else "."
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
    facts = f"{_axes(_three(triple))} {fact}, but " if triple else ""
    why = f"{facts}{axes.arm.n} joints are more than the six components of a pose."
    return Structure("redundant", "Redundant arm", False, _capital(why), None, _three(triple) if triple else ())


def _meeting(axes: Axes) -> Structure | None:
    i, n = axes.last_triple(axes.meet), axes.arm.n
    if i is None:
        return None
    last = i == n - 2
    # Undoing the joints behind the three brings them in front of those before the three.
    others = axes.kinds[i + 2 :] + axes.kinds[: i - 1]
    most = 2 * _ways(others) if n == 6 and axes.arm.task.key == "pose" else None
    named = f"{_axes(_three(i))} meet in one point" + (" (spherical wrist)" if last else "")
    why = f"{named}: position and orientation separate (Pieper)."
    key, title = ("spherical_wrist", "Spherical wrist") if last else ("three_meeting", "Three axes through one point")
    return Structure(key, title, True, _capital(why), most, _three(i))


def _parallel(axes: Axes) -> Structure | None:
    i = axes.last_triple(axes.three_parallel)
    if i is None:
        return None
    why = f"{_axes(_three(i))} are parallel: they form a planar 3R, and the other joints separate from it (Pieper)."
    proven = axes.turns(1, 6) and axes.arm.n == 6 and axes.arm.task.key == "pose" and _like_ur(axes, i)
    return Structure("three_parallel", "Three parallel axes", True, _capital(why), 8 if proven else None, _three(i))


def _like_ur(axes: Axes, i: int) -> bool:
    """Return whether the count of 8 in the module's text applies."""
    beside = {2: (4, 5), 3: (2, 1)}.get(i)
    if beside is None or axes.parallel(1) or axes.parallel(5):
        return False
    crossing, meeting = beside
    return axes.perpendicular(crossing) and axes.touching(meeting)


def _three_slides(axes: Axes) -> Structure | None:
    if axes.arm.n != 6 or axes.kinds.count("P") != 3:
        return None
    sliding = [i for i in _joints(axes) if axes.kinds[i - 1] == "P"]
    why = f"{_capital(_slides(sliding))}: the three turns alone make the orientation, then the position is linear."
    most = 2 if axes.arm.task.key == "pose" else None
    return Structure("three_slides", "Three slides", True, why, most, tuple(sliding))


def _general(axes: Axes) -> Structure:
    n = axes.arm.n
    none = "No three neighbouring axes meet in one point or are parallel: the conditions for a closed form do not hold."
    if axes.kinds == "RRRRRR":
        most = MOST_6R if axes.arm.task.key == "pose" else None
        return Structure("general_6r", "General 6R", False, f"{none} A polynomial of degree 16 remains.", most, ())
    return Structure("general", f"General arm of {n} joints", False, none, None, ())


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
    _general,
)
"""From the special to the general; the last one always finds."""


def _ways(kinds: str) -> int:
    """Return in how many ways three joints of these types can place a point, at most."""
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
