"""At which kind of singularity an arm stands, what has become dependent, and which motion of the tool is lost.

Where position and orientation separate, the determinant is a product, and each factor has a name: the shoulder (the
centre of the wrist in the plane through axis 1), the elbow (a planar part stretched or folded) and the wrist (two of
its axes in line). For any other arm the columns that have become dependent are named.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.joint_scale import joint_scale
from armlab.kin.velocity import _centre
from armlab.kin.velocity._layout import IN_LINE, Layout, Posture, layout_of
from armlab.kin.velocity.dependence import Dependence, dependent_columns, independent_sets
from armlab.kin.velocity.subspaces import Subspaces, task_lengths, task_matrix, task_subspaces

Array = NDArray[np.float64]
Kind = Literal["shoulder", "elbow", "wrist", "dependent"]

VANISHES = 1e-5
"""Value of a factor of the determinant, as a sine or in length scales, below which it is the vanishing one. The rank is
decided before; this only selects the factor."""

BOUNDARY = " The tool is at a boundary: joint values near these take it to one side only. Others may reach beyond."
"""Sentence on a boundary found from second derivatives, which are local: the whole workspace may be larger."""

CURVED = 1e-6
"""Second derivative, in length scales, above which the path of the tool is curved."""

DIFFERENCE, FAR = 1e-4, 0.3
"""Step of the central differences of the Jacobian, with an error of 1e-8, and size of a motion that is not small; rad
or m."""


@dataclass(frozen=True, eq=False)
class Singularity:
    """One reason why an arm is singular.

    Attributes
    ----------
    kind : "shoulder", "elbow", "wrist" or "dependent"
    says : str
        Sentences that name the joints (1-based) and what is lost.
    joints : tuple of int
        The joints of which it depends, 1-based.
    direction : ndarray, shape (3,), or None
        Unit vector in the world of the lost motion, of either sense; None where it is no pure motion.
    turning : bool
        Whether turning about it is lost, else moving along it.
    boundary : bool
        Whether joint values near these take the tool point to one side only. In another posture the arm may reach
        beyond.
    """

    kind: Kind
    says: str
    joints: tuple[int, ...]
    direction: Array | None
    turning: bool = False
    boundary: bool = False


def singularities(arm: Arm, q: ArrayLike) -> tuple[Singularity, ...]:
    """Return why an arm is singular in a configuration; empty where it is not.

    It is singular where the rank of its task Jacobian is below the usual one. An arm that never reaches all components
    of its task, because it has too few joints or because of how its axes lie, is not singular for that. Where several
    ranks are lost there are at least as many reasons.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
        Radians and metres.

    Raises
    ------
    InputError
        Not n finite numbers.

    References
    ----------
    Notes, section 5.1.4; Siciliano et al., *Robotics*, 3.3.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> [(each.kind, each.boundary) for each in singularities(arm, [0.4, 0.0])]
    [('elbow', True)]
    """
    values = finite_floats(q, "q", (arm.n,), f"{arm.n} finite numbers")
    spaces = task_subspaces(arm, values)
    layout = layout_of(arm)
    if spaces.rank >= layout.rank:
        return ()
    posture = Posture(arm, values, layout)
    boundary = _on_boundary(arm, values, spaces)
    named = (
        _shoulder(posture, layout),
        _elbow(posture, layout, boundary),
        _wrist(posture, layout),
    )
    found = tuple(each for each in named if each is not None)
    if layout.spherical and not layout.run:
        about = _centre.reasons(posture, layout)
        found = tuple(Singularity(*each) for each in about)
    missing = layout.rank - spaces.rank - len(found)
    if not found and missing == 1:
        return (_dependent(posture, layout, spaces, boundary),)
    all_found = (*found, *_more(posture, layout, spaces, found, missing, boundary))
    return all_found or (_dependent(posture, layout, spaces, boundary),)


def usual_rank(arm: Arm) -> int:
    """Return the rank of the task Jacobian where the arm is not singular."""
    return layout_of(arm).rank


def _shoulder(posture: Posture, layout: Layout) -> Singularity | None:
    centre = posture.shoulder_point
    if centre is None:
        return None
    z, arm = posture.run_axis, posture.arm
    way = centre - posture.points[0]
    across = float(z @ np.cross(posture.axes[0], way))
    if abs(across) > VANISHES * arm.length_scale:
        return None
    # A slide that is oblique to the planar part may still move it that way.
    if np.abs(z @ posture.centre_jacobian[:, 1:]).max(initial=0.0) > VANISHES * arm.length_scale:
        return None
    run, centre_name = _listed([k + 1 for k in layout.run]), layout.centre_name
    off = float(np.linalg.norm(np.cross(posture.axes[0], way)))
    if off <= VANISHES * arm.length_scale:
        says = f"Shoulder: {centre_name} lies on axis 1, so joint 1 does not move it."
    else:
        says = (
            f"Shoulder: {centre_name} lies in the plane through axis 1 that is parallel to axes {run}, so joint 1 "
            "does not move it out of the plane of the arm."
        )
    says += f" It cannot move along the direction of axes {run}."
    return Singularity("shoulder", says, (1,), z)


def _elbow(posture: Posture, layout: Layout, boundary: bool) -> Singularity | None:
    points = posture.elbow_points
    if points is None:
        return None
    ways = np.diff(points, axis=0)
    _, sizes, lines = np.linalg.svd(ways)
    if sizes[0] <= 0.0 or (len(sizes) > 1 and sizes[1] > VANISHES * sizes[0]):
        return None
    along = ways @ lines[0]
    # Points that coincide, as the tool point on the last axis, have no sense along the line.
    along = along[np.abs(along) > VANISHES * sizes[0]]
    stretched = bool(np.all(along > 0.0) or np.all(along < 0.0))
    end, axes = layout.end_name, [k + 1 for k in layout.run]
    what = f"axes {_listed(axes)} and {end}" if end else f"axes {_listed(axes)}"
    says = f"Elbow: the arm is {'stretched' if stretched else 'folded'}: {what} are in line, seen along the axes. "
    says += f"Joints {_listed(axes)} do not move {end or f'axis {axes[-1]}'} along that line."
    if boundary:
        says += BOUNDARY
    return Singularity("elbow", says, tuple(axes), _lost_along(posture, layout, lines[0]), False, boundary)


def _lost_along(posture: Posture, layout: Layout, line: Array) -> Array | None:
    """Return the direction (3,) that the end of a stretched planar part loses; None where it is none, or not one.

    It is the line, unless a joint before or behind the planar part moves its end along the line: beside an offset of
    the shoulder joint 1 does, and another direction, oblique to the line, is lost instead.
    """
    if posture.arm.task.rotation == "none":
        J, rows = posture.arm.jacobian(posture.q)[:3], posture.task_axes
    elif layout.ends_at_centre:
        J, rows = posture.centre_jacobian, np.eye(3)
    else:
        # The last axis of the part moves along the line only by what comes before the part.
        return np.asarray(line) if layout.run[0] == 0 else None
    U, sigma, _ = np.linalg.svd(rows @ J)
    sizes = np.pad(sigma, (0, len(rows) - len(sigma)))
    lost = U[:, sizes <= VANISHES * sizes[0]]
    if lost.shape[1] == 1:
        return np.asarray(lost[:, 0] @ rows)
    held = np.linalg.norm(line @ J) <= VANISHES * np.linalg.norm(J)
    return np.asarray(line) if held else None


def _wrist(posture: Posture, layout: Layout) -> Singularity | None:
    if layout.wrist is None:
        return None
    first, middle, last = layout.wrist
    z1, z2, z3 = posture.axes[[first, middle, last]]
    if abs(float(np.cross(z1, z2) @ z3)) > VANISHES:
        return None
    names = (first + 1, middle + 1, last + 1)
    normal = np.cross(z1, z2)
    if float(np.linalg.norm(np.cross(z1, z3))) <= VANISHES:
        line = "in one line" if layout.spherical else "parallel"
        what = f"axes {names[0]} and {names[2]} are {line}, so both joints turn the hand the same way"
        joints: tuple[int, ...] = (names[0], names[2])
    else:
        what, joints = f"axes {_listed(names)} lie in one plane", names
    across = f"the direction across axes {names[0]} and {names[1]}"
    normal = np.asarray(normal / np.linalg.norm(normal))
    if layout.spherical and _turned_by_others(posture, normal):
        says = f"Wrist: {what}. About {across} the hand turns here only because joints before the wrist can turn it "
        says += f"with {layout.centre_name} held."
        return Singularity("wrist", says, joints, None, True)
    says = f"Wrist: {what}. With {layout.centre_name} held, the hand cannot turn about {across}."
    return Singularity("wrist", says, joints, normal, True)


def _turned_by_others(posture: Posture, normal: Array) -> bool:
    """Return whether joint speeds before the wrist that keep its centre in place turn the hand about a direction."""
    J = posture.centre_jacobian
    _, sigma, V_T = np.linalg.svd(J)
    still = V_T[int(np.sum(sigma > VANISHES * sigma[0])) :] * posture.arm.revolute[: J.shape[1]]
    return bool(np.abs(still @ posture.axes[: J.shape[1]] @ normal).max(initial=0.0) > VANISHES)


# -- any arm ---------------------------------------------------------------------------------------------------------


def _dependent(posture: Posture, layout: Layout, spaces: Subspaces, boundary: bool) -> Singularity:
    arm = posture.arm
    scaled = _scaled(arm, posture.q)
    sets = dependent_columns(scaled, layout.usual)
    whats = [_what(posture, each) for each in sets[:2]]
    says = f"{_capital('; '.join(whats))}." if whats else "The columns of J have become dependent."
    direction, turning = _pure(arm, posture, spaces)
    if direction is not None:
        says += f" The tool cannot {'turn about' if turning else 'move along'} one direction of its task."
    if boundary:
        says += BOUNDARY
    joints = tuple(sorted({joint for each in sets for joint in each.joints}))
    zero = [each.joints[0] for each in sets if len(each.joints) == 1]
    kind: Kind = "shoulder" if zero == [1] else "dependent"
    if kind == "shoulder":
        says = f"Shoulder: {_lowered(says)}"
    return Singularity(kind, says, joints, direction, turning, boundary)


def _more(
    posture: Posture, layout: Layout, spaces: Subspaces, named: tuple[Singularity, ...], missing: int, boundary: bool
) -> tuple[Singularity, ...]:
    """Return up to ``missing`` further reasons, each a set of columns that the others do not make dependent."""
    if missing <= 0:
        return ()
    arm = posture.arm
    count = missing + len(named)
    sets = [*independent_sets(_scaled(arm, posture.q), layout.usual, arm.n)]
    # Sets with a name are reported already.
    told = [each for each in sets if any(set(each.joints) <= set(known.joints) for known in named)]
    sets = [each for each in sets if not any(each is one for one in told)]
    sets = [*sets, *told[len(named) :]][:missing]
    ways = _pure_directions(posture, spaces) if not named else []
    found = []
    for k, each in enumerate(sets):
        direction, turning = ways[k] if k < len(ways) else (None, False)
        kind: Kind = "shoulder" if each.joints == (1,) else "dependent"
        says = f"{_what(posture, each)}."
        says = f"Shoulder: {says}" if kind == "shoulder" else _capital(says)
        says += f" This is one of {count} motions that the tool has lost."
        if direction is not None:
            says += f" It cannot {'turn about' if turning else 'move along'} one direction of its task."
        if boundary and not named:
            says += BOUNDARY
        found.append(Singularity(kind, says, each.joints, direction, turning, boundary and not named))
    return tuple(found)


def _pure_directions(posture: Posture, spaces: Subspaces) -> list[tuple[Array, bool]]:
    """Return lost directions in the world that are pure translations or rotations, and whether they are rotations."""
    lost, p = spaces.lost * spaces.lengths[:, None], len(posture.arm.task.position)
    found = []
    for part, other, turning in ((slice(0, p), slice(p, None), False), (slice(p, None), slice(0, p), True)):
        rest = lost[other]
        _, sigma, V_T = np.linalg.svd(rest) if rest.size else (None, np.zeros(0), np.eye(lost.shape[1]))
        for vector in V_T[int(np.sum(sigma > VANISHES)) :]:
            way = (lost[part] @ vector) @ posture.task_axes[part]
            if np.linalg.norm(way) > VANISHES:
                found.append((np.asarray(way / np.linalg.norm(way)), turning))
    return found


def _what(posture: Posture, found: Dependence) -> str:
    """Return a sentence on why some columns are dependent."""
    joints = [joint - 1 for joint in found.joints]
    turns = posture.arm.revolute[joints]
    columns = posture.point_columns[:, joints]
    if len(joints) == 1:
        still = posture.arm.task.rotation == "none" and np.linalg.norm(columns) <= IN_LINE * posture.arm.length_scale
        where = " (its axis passes through the tool point)" if turns[0] and posture.on_axis(joints[0]) else ""
        return f"joint {joints[0] + 1} does not move the tool{'' if still else ' in its task'}{where}"
    names = _listed(found.joints)
    if len(joints) == 2 and turns.all() and posture.same_line(*joints):
        return f"joints {names} turn about the same line"
    if len(joints) == 2 and not turns.any():
        return f"joints {names} slide the same way"
    if len(joints) == 2 and posture.arm.task.rotation == "none" and _are_parallel(*columns.T):
        return f"joints {names} move the tool point along the same line"
    return f"the columns of joints {names} are dependent"


def _are_parallel(a: Array, b: Array) -> bool:
    """Return whether two velocities (3,) have one line, also across the coordinates that the task leaves out."""
    return float(np.linalg.norm(np.cross(a, b))) <= IN_LINE * float(np.linalg.norm(a) * np.linalg.norm(b))


def _pure(arm: Arm, posture: Posture, spaces: Subspaces) -> tuple[Array | None, bool]:
    """Return the lost direction in the world if there is one, and it is purely of translation or rotation."""
    if spaces.lost.shape[1] != 1:
        return None, False
    lost, p = spaces.lost[:, 0] * spaces.lengths, len(arm.task.position)
    for part, turning in ((slice(0, p), False), (slice(p, None), True)):
        rest = np.linalg.norm(lost) ** 2 - np.linalg.norm(lost[part]) ** 2
        if rest <= VANISHES**2:
            vector = lost[part] @ posture.task_axes[part]
            return np.asarray(vector / np.linalg.norm(vector)), turning
    return None, False


def _on_boundary(arm: Arm, q: Array, spaces: Subspaces) -> bool:
    """Return whether, to second order, every motion of the joints takes the tool point to one side.

    Along joint speeds of the null space the tool has no speed; where its acceleration along a lost direction u,
    ``u^T (dJ/dn) n``, has one sign for all of them, nothing reaches the other side.
    """
    if arm.task.rotation != "none":
        return False
    null = spaces.null
    changes = [task_matrix(arm, q + DIFFERENCE * n) - task_matrix(arm, q - DIFFERENCE * n) for n in null.T]
    slopes = np.array(changes) @ null / (2.0 * DIFFERENCE)
    floor = CURVED * arm.length_scale
    for u in _directions(spaces.lost, slopes, floor):
        bends, ways = np.linalg.eigh(u @ slopes)
        if (bends.max() > floor) == (bends.min() < -floor):
            continue
        # Along what does not bend it, u must stay lost: then it is a motion beside the boundary and not across it.
        level = (null @ ways[:, np.abs(bends) <= floor]).T
        if all(np.abs(u @ task_matrix(arm, q + FAR * n)).max() <= floor for n in level):
            return True
    return False


def _directions(lost: Array, slopes: Array, floor: float) -> Array:
    """Return unit vectors of the lost directions, (k, m), that the arm distinguishes, and no axes that rounding chose.

    Where several are lost, they are those along which the tool bends most and least, over all joint speeds of the null
    space, and its mean bend: turning the bases of either space leaves them alone.

    Parameters
    ----------
    lost : ndarray, shape (m, c)
    slopes : ndarray, shape (k, m, k)
        Derivatives of J n along the k vectors of the null space.
    floor : float
        Bend that counts as none.
    """
    if lost.shape[1] < 2:
        return lost.T
    bends = np.einsum("mc,jmk->cjk", lost, slopes)
    _, principal = np.linalg.eigh(np.einsum("cjk,djk->cd", bends, bends))
    mean = np.trace(bends, axis1=1, axis2=2)
    size = float(np.linalg.norm(mean))
    ways = np.column_stack([principal, mean / size]) if size > floor else principal
    return np.asarray((lost @ ways).T)


def _scaled(arm: Arm, q: Array) -> Array:
    return task_matrix(arm, q) * joint_scale(arm) / task_lengths(arm)[:, None]


def _listed(joints: list[int] | tuple[int, ...]) -> str:
    *front, last = map(str, joints)
    return f"{', '.join(front)} and {last}" if front else last


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]
