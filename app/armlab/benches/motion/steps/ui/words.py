"""The explanation of each planning step, with its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.plan.moves import TURNINGS
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.steps.state import INVERSE, JOINTS, KNOTS, PATH, SAMPLING
from armlab.benches.motion.steps.ui.formulas import formula_of, rounds_corners, says_of
from armlab.benches.motion.steps.worked import Steps, length_of
from armlab.kin.conditioning import NEAR
from armlab.kin.motion import law_types
from armlab.kin.rotations import euler_zyx
from armlab.kin.transforms import inverse as inverse_transform
from armlab.ui.format import capitalised, dot, lowered, mathml, number, pairs, so_many
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.pose_fields import reference_of
from armlab.ui.small_numbers import NO_BREAK, small, with_unit
from armlab.ui.symbols import with_indices
from armlab.ui.tables import line
from armlab.ui.units import Units

Floats = NDArray[np.float64]

TITLES = {KNOTS: "Knots", PATH: "Path", SAMPLING: "Samples", INVERSE: "IK", JOINTS: "Joints"}
"""Titles of the chips."""

SKIPPED = (PATH, SAMPLING)
"""Steps that a joint move does not have."""

EXACT = 1e-12
"""Length, metres, below which a number is rounding."""

BENT = 1e-6
"""Excess of a path's length over the straight lines, in length scales, below which it is not mentioned."""

LINE = 41
"""Number of characters of joint values, each with a gap, that fit side by side; more are set in blocks below each
other."""

STOPS = 5
"""Largest number of listed places where the path cannot be followed."""


def head_of(step: int, found: Steps) -> Markup:
    """Return the heading of a step."""
    full = {
        KNOTS: "Knots",
        PATH: "Interpolation in task space",
        SAMPLING: "Sampling",
        INVERSE: "Inverse kinematics of each sample",
        JOINTS: "Interpolation of the joints",
    }
    left_out = not found.in_space and step in SKIPPED
    text = "Inverse kinematics of the knots" if step == INVERSE and not found.in_space else full[step]
    return tag("h3", f"{step}\u2002{text}", (" ", tag("small", "– left out")) if left_out else None)


# -- 1 ----------------------------------------------------------------------------------------------------------------


def knots(found: Steps, units: Units) -> Markup:
    """Return the first step: poses and joint values of the knots."""
    what = "poses of the tool" if found.in_space else "configurations of the arm"
    count = len(found.knot_q)
    said = tag(
        "p",
        f"The task gives {count} knots, {what} to pass through. To find a path free of collisions is the task of ",
        tag("i", "motion planning"),
        ", which is assumed to be done; ",
        tag("i", "trajectory planning"),
        " finds the motion of the joints along that path.",
    )
    first = found.stretch.first
    names = [str(first + k + 1) for k in range(count)]
    values = joint_table("knot", names, found.knot_q, found, units)
    return joined(said, _poses(found, names, units), values, _list(found))


def _poses(found: Steps, names: Sequence[str], units: Units) -> Markup:
    reference = reference_of(found.arm)
    poses = inverse_transform(reference) @ found.knot_poses
    position, angles = poses[:, :3, 3], euler_zyx(poses[:, :3, :3])[0]
    turns = {"none": (), "phi": ("φ",)}.get(found.arm.task.rotation, ("yaw", "pitch", "roll"))
    heads = ["knot, in frame 0" if reference is found.arm.base else "knot"]
    heads += [f"{axis}, {units.length_unit}" for axis in "xyz"] + [f"{turn}, {units.angle_unit}" for turn in turns]
    rows = [
        [name, *(units.text(float(x), False) for x in p), *map(units.turned, a[: len(turns)].tolist())]
        for name, p, a in zip(names, position, angles, strict=True)
    ]
    return _scrolled(_table(heads, rows))


def joint_table(head: str, names: Sequence[str], q: Floats, found: Steps, units: Units) -> Markup:
    """Return joint values, (k, n), in rows with names, in blocks for many joints."""
    revolute = [bool(turns) for turns in found.arm.revolute]
    heads = [f"{units.variable(i, turns)}, {units.unit(turns)}" for i, turns in enumerate(revolute)]
    cells = [[units.text(float(value), turns) for value, turns in zip(row, revolute, strict=True)] for row in q]
    tables = [
        _table([head, *heads[block]], [[name, *row[block]] for name, row in zip(names, cells, strict=True)])
        for block in _blocks(cells)
    ]
    return _scrolled(*tables)


def _blocks(cells: Sequence[Sequence[str]]) -> list[slice]:
    """Return the columns of as few and as equal blocks as possible, none of them too wide."""
    widths = [1 + max(map(len, column)) for column in zip(*cells, strict=True)]
    for count in range(1, len(widths) + 1):
        ends = [round(len(widths) * k / count) for k in range(count + 1)]
        blocks = [slice(first, last) for first, last in pairwise(ends)]
        if all(sum(widths[block]) <= LINE for block in blocks):
            break
    return blocks


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Markup:
    top = [tag("th", _over_unit(head)) for head in heads]
    return tag("table.ms-table", tag("tr", top), [line(*row) for row in rows])


def _over_unit(head: str) -> Inside:
    """Return a quantity above its unit, so that narrow columns stay narrow."""
    name, _, unit = head.partition(", ")
    return (name, tag("br"), tag("i", unit)) if unit else name


def _scrolled(*tables: Markup) -> Markup:
    """Return tables that scroll when they have many rows or columns."""
    return tag(classes("div.ms-scroll", tall=len(tables) > 1), tables)


def _list(found: Steps) -> Markup:
    """Return the decisions for any trajectory, in the list of the notes."""
    move, count = found.stretch.move, len(found.knot_q)
    rows = [
        ("space", "Cartesian space" if found.in_space else "joint space"),
        ("task", "point to point" if count == 2 else f"multi-point, {count} knots"),
        ("path", lowered(move.kind.title)),
        ("timing law", lowered(law_types()[move.law.key].title)),
        ("joints", "independent: each with its own law" if move.independent else "coordinated: all share s"),
    ]
    return joined(tag("h3", "What has been chosen ", tag("small", "(page Plan)")), pairs(rows))


# -- 2 ----------------------------------------------------------------------------------------------------------------


def path(found: Steps, units: Units) -> Markup:
    """Return the second step: the path in space."""
    chosen = found.stretch.move.path
    if not found.in_space:
        how = "joined in step 5 by straight lines with blends" if _passes_by(found) else "interpolated in step 5"
        return tag(
            "p",
            f"In a joint move nothing is interpolated in space. The joint values of the knots are {how}, and the path "
            "of the tool follows from them.",
        )
    if found.way is None:
        return _trouble(found)
    rows = [
        ("kind", lowered(found.stretch.move.kind.title)),
        ("length of the path", units.length(found.length)),
    ]
    straight = length_of(found.knot_poses[:, :3, 3])
    if found.length - straight > BENT * found.arm.length_scale:
        rows.append(("straight between knots", units.length(straight)))
    if found.arm.task.rotation != "none":
        turning = TURNINGS[found.stretch.move.turning]
        rows.append(("orientation", "smoothly through the waypoints" if found.way.orientation.goes_on else turning))
        rows.append(("angle of rotation", units.angle(found.turn)))
    said = (
        f"A curve {'past' if rounds_corners(chosen) else 'through'} the knots with a parameter s from 0 to 1, which is "
        "not yet time: when the tool is where is decided by the timing law."
    )
    about = tag("p.dim", says_of(chosen, found.way.position))
    return joined(tag("p", said), _formula(chosen, "p"), about, pairs(rows))


def _formula(chosen: Chosen, letter: str) -> Markup | None:
    """Return the formula of a path, with the letter of the quantity, or nothing if none is known."""
    formula = formula_of(chosen, letter)
    return tag("div.eq.small", mathml(formula, True)) if formula else None


# -- 3 ----------------------------------------------------------------------------------------------------------------


def sampling(found: Steps, field: Inside, units: Units) -> Markup:
    """Return the third step, the number of samples; ``field`` is the input for it."""
    if not found.in_space:
        text = "Without a path in space there is nothing to sample: the knots are all the points there are."
        return tag("p", text)
    if found.followed is None:
        return _trouble(found)
    count = len(found.samples)
    rows = [
        ("poses", str(count)),
        ("Δs", number(1.0 / (count - 1), 4)),
        ("largest distance between neighbours", units.length(found.spacing)),
    ]
    said = (
        "A dense but finite sequence of poses on the path, evenly spaced in s: p(0), p(Δs), p(2Δs), … Few "
        "samples are quickly computed; many keep the tool on its path. Try 4."
    )
    moved = None
    if found.way is not None and len(found.way.corners):
        moved = tag("p.dim", "The samples nearest to the corners of the path are moved there.")
    return joined(tag("p", said), field, pairs(rows), moved)


# -- 4 ----------------------------------------------------------------------------------------------------------------


def inverse(found: Steps, units: Units) -> Markup:
    """Return the fourth step: the inverse kinematics of the samples."""
    if not found.in_space:
        names = [str(found.stretch.first + k + 1) for k in range(len(found.knot_q))]
        said = (
            f"The inverse kinematics is solved {len(names)} times, once for each knot, except for knots given "
            f"by their joint values. The branch is chosen at each knot."
        )
        return joined(tag("p", said), joint_table("knot", names, found.knot_q, found, units))
    if found.followed is None:
        return _trouble(found)
    count, solved = len(found.samples), int(found.followed.reached.sum())
    rows: list[tuple[Inside, str]] = [("solved", f"{solved} of {count} samples")]
    if found.branch:
        rows.append(("branch", found.branch))
    if found.least_singular is not None:
        least, s = found.least_singular
        rows.append((with_indices("smallest σ_min/σ_max"), f"{number(least, 3)} at s = {number(s, 2)}"))
    near = int(np.sum(found.worth == Feasible.NEAR_SINGULAR))
    if near:
        rows.append((f"below {NEAR:g}", f"{so_many(near, 'sample')}, where joints are fast"))
    said = (
        "One configuration for each sample. Each search begins at the solution before, so that the arm stays on one "
        "branch."
    )
    names = [number(s, 2) for s, _ in found.shown_arms]
    q = np.array([q for _, q in found.shown_arms]).reshape(len(names), found.arm.n)
    arms = (tag("h3", "Arms in the scene"), joint_table("s", names, q, found, units)) if names else None
    return joined(tag("p", said), _followed(found), pairs(rows), _other_way(found), arms)


def _other_way(found: Steps) -> Markup:
    """Return remarks on a knot that is reached in another configuration than the stored one."""
    told = [remark for remark in found.leg.remarks if remark.startswith("waypoint")]
    return joined([tag("p.dim", f"{capitalised(each)}.") for each in told])


def _followed(found: Steps) -> Markup:
    """Return whether the path could be followed, and where and why not."""
    assert found.followed is not None
    if found.followed.whole:
        return tag("p.ok", "✓ The whole path is followed on one branch.")
    stops = found.followed.stops
    said = [stop.sentence for stop in stops[:STOPS]] or [found.followed.reason]
    more = tag("p.dim", f"… and {so_many(len(stops) - STOPS, 'more place')}.") if len(stops) > STOPS else None
    behind = tag("p.dim", "What is solved beyond does not form one motion with what comes before.")
    parts = behind if len(found.followed.parts) > 1 else None
    return joined([tag("p.no", f"✕ {capitalised(each)}") for each in said], more, parts)


# -- 5 ----------------------------------------------------------------------------------------------------------------


def joints(found: Steps, units: Units, colours: tuple[str, str]) -> Markup:
    """Return the fifth step, the path of the joints; ``colours`` are those of the wanted and the resulting path."""
    apart = found.apart
    if found.path is None or apart is None:
        return joined(tag("p", "There is no motion of the joints."), _trouble(found))
    said = _spline(found) if found.in_space else _laid(found)
    wanted, result = colours
    k = apart.worst
    far = _small(float(apart.distance[k]), units)
    where = "" if apart.distance[k] < EXACT else f" at s = {number(float(apart.s[k]), 2)}"
    rows: list[tuple[Inside, str]] = [
        ((dot(wanted), " path" if found.in_space else " straight lines"), units.length(found.length)),
        ((dot(result), " path of the tool"), units.length(found.tool_length)),
        ("largest distance", far + where),
    ]
    if found.in_space and found.arm.task.rotation != "none":
        rows.append(("largest error of rotation", _turn(float(apart.turn.max()), units)))
    larger = f"In the scene the distance is drawn {found.larger:g} times as large. " if found.larger > 1.0 else ""
    return joined(said, pairs(rows), tag("p.dim", larger, _timing(found)), _untimed(found))


def _spline(found: Steps) -> Markup:
    count = len(found.samples)
    if count == 2:
        said = "A cubic from the first solution to the second is q(s)."
    else:
        said = (
            f"A cubic spline through the {count} solutions is q(s): {count - 1} pieces, equal velocities and "
            "accelerations where two meet."
        )
    return tag("p", f"{said} Only at the samples is the tool sure to be on its path.")


def _laid(found: Steps) -> Markup:
    move = found.stretch.move
    if found.arm.revolute.any():
        way = "No singularity can stop this, but in general the tool does not move along a straight line."
    else:
        way = "All joints are prismatic: where their values change in proportion, the tool moves along a straight line."
    joined_by = (
        "The joint values of the knots are joined by straight lines with blends, which pass by each knot between the "
        "first and the last."
        if _passes_by(found)
        else "The joint values of the knots are interpolated directly."
    )
    said = tag("p", f"{joined_by} {way}")
    if move.independent:
        apart = (
            "Each joint follows its own law, and those that arrive first wait for the last. Below, s = t/T is the "
            "share of the time that has passed."
        )
        return joined(said, tag("p", apart))
    about = tag("p.dim", f"{move.kind.title}. {says_of(move.path, found.path)}")
    return joined(said, _formula(move.path, "q"), about)


def _passes_by(found: Steps) -> bool:
    """Return whether the path does not meet the knots between the first and the last."""
    return rounds_corners(found.stretch.move.path) and len(found.knot_q) > 2


def _timing(found: Steps) -> str | None:
    """Return what remains to be done: the timing law."""
    motion = found.leg.motion
    if motion is None:
        return None
    lasts = f"{number(motion.duration, 2)}{NO_BREAK}s"
    if found.stretch.move.independent:
        return f"With the timing law of each joint the motion takes {lasts}."
    return f"With the timing law s(t) this becomes the motion q(s(t)), which takes {lasts}."


def _untimed(found: Steps) -> Markup | None:
    """Return why there is no timing law."""
    text = found.leg.trouble
    return tag("p.no", f"✕ The timing law: {text}.") if text else None


def _turn(value: float, units: Units) -> str:
    """Return a small angle; after a power of ten its sign is set apart, or it would read as a zero."""
    text = small(value, True, units)
    return f"{text}{NO_BREAK if units.angle_unit != '°' or '·' in text else ''}{units.angle_unit}"


def _small(value: float, units: Units) -> str:
    return f"0{NO_BREAK}{units.length_unit}, apart from rounding" if value < EXACT else with_unit(value, False, units)


def _trouble(found: Steps) -> Markup:
    text = found.leg.trouble or "It is still being planned."
    return tag("p.no", f"✕ {capitalised(text).rstrip('.')}.")
