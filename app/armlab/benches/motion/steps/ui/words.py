"""What the page of the planning steps says of each step, with its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.moves import TURNINGS
from armlab.benches.motion.plan.planning import NEARLY_SINGULAR
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.steps.state import INVERSE, JOINTS, KNOTS, PATH, SAMPLING
from armlab.benches.motion.steps.ui.formulas import formula_of, says_of
from armlab.benches.motion.steps.worked import Steps, length_of
from armlab.kin.motion import law_types
from armlab.kin.rotations import euler_zyx
from armlab.ui.format import capitalised, dot, escaped, lowered, mathml, number, pairs
from armlab.ui.small_numbers import NO_BREAK, small, with_unit
from armlab.ui.units import Units

Floats = NDArray[np.float64]

TITLES = {KNOTS: "Knots", PATH: "Path", SAMPLING: "Samples", INVERSE: "IK", JOINTS: "Joints"}
"""What the chips say."""

SKIPPED = (PATH, SAMPLING)
"""Steps a joint move does not have."""

EXACT = 1e-12
"""Metres: what is less is rounding."""

BENT = 1e-6
"""Length scales by which a way is longer than the straight lines, below which it is not told."""

LINE = 41
"""Characters of joint values, each with a gap, that stand side by side; more are in blocks, one below the other."""

STOPS = 5
"""Places where the path cannot be followed that are told."""


def head_of(step: int, found: Steps) -> str:
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
    return f"<h3>{step}&ensp;{text}{' <small>– left out</small>' if left_out else ''}</h3>"


# -- 1 ----------------------------------------------------------------------------------------------------------------


def knots(found: Steps, units: Units) -> str:
    """Return the first step: poses and joint values of the knots."""
    what = "poses the tool is to pass" if found.in_space else "configurations the arm is to pass"
    count = len(found.knot_q)
    said = (
        f"<p>The task gives {count} knots: {what}. A path free of collisions is the matter of "
        "<i>motion planning</i> and taken for granted; <i>trajectory planning</i> finds joint motions along it.</p>"
    )
    first = found.stretch.first
    names = [str(first + k + 1) for k in range(count)]
    return said + _poses(found, names, units) + joint_table("knot", names, found.knot_q, found, units) + _list(found)


def _poses(found: Steps, names: Sequence[str], units: Units) -> str:
    position, angles = found.knot_poses[:, :3, 3], euler_zyx(found.knot_poses[:, :3, :3])[0]
    turns = {"none": (), "phi": (0,)}.get(found.arm.task.rotation, (0, 1, 2))
    heads = ["knot", *(f"{axis}, {units.length_unit}" for axis in "xyz")]
    heads += [f"{('yaw', 'pitch', 'roll')[k]}, {units.angle_unit}" for k in turns]
    rows = [
        [name, *(units.text(float(x), False) for x in p), *(units.turned(float(a[k])) for k in turns)]
        for name, p, a in zip(names, position, angles, strict=True)
    ]
    return table(heads, rows)


def joint_table(head: str, names: Sequence[str], q: Floats, found: Steps, units: Units) -> str:
    """Return joint values, (k, n), in rows with names; of many joints in blocks."""
    revolute = [bool(turns) for turns in found.arm.revolute]
    heads = [f"{units.variable(i, turns)}, {units.unit(turns)}" for i, turns in enumerate(revolute)]
    cells = [[units.text(float(value), turns) for value, turns in zip(row, revolute, strict=True)] for row in q]
    tables = [
        _table([head, *heads[block]], [[name, *row[block]] for name, row in zip(names, cells, strict=True)])
        for block in _blocks(cells)
    ]
    return _scrolled("".join(tables), len(tables) > 1)


def _blocks(cells: Sequence[Sequence[str]]) -> list[slice]:
    """Return the columns of blocks as few and as equal as can be, none of them too wide."""
    widths = [1 + max(map(len, column)) for column in zip(*cells, strict=True)]
    for count in range(1, len(widths) + 1):
        ends = [round(len(widths) * k / count) for k in range(count + 1)]
        blocks = [slice(first, last) for first, last in pairwise(ends)]
        if all(sum(widths[block]) <= LINE for block in blocks):
            break
    return blocks


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of numbers that scrolls when it has many rows or columns; its texts are markup."""
    return _scrolled(_table(heads, rows), False)


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    # A quantity stands over its unit, so that narrow columns stay narrow.
    top = "".join(f"<th>{head.replace(', ', '<br><i>', 1)}{'</i>' if ', ' in head else ''}</th>" for head in heads)
    lines = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
    return f'<table class="ms-table"><tr>{top}</tr>{lines}</table>'


def _scrolled(tables: str, tall: bool) -> str:
    return f'<div class="ms-scroll{" tall" if tall else ""}">{tables}</div>'


def _list(found: Steps) -> str:
    """Return what has to be decided of any trajectory: the list of the notes."""
    move, count = found.stretch.move, len(found.knot_q)
    rows = [
        ("space", "Cartesian" if found.in_space else "joint"),
        ("task", "point to point" if count == 2 else f"multi-point, {count} knots"),
        ("path", escaped(lowered(move.kind.title))),
        ("timing law", escaped(lowered(law_types()[move.law.key].title))),
        ("joints", "coordinated: all share s"),
    ]
    return f"<h3>What was decided <small>(page Plan)</small></h3>{pairs(rows)}"


# -- 2 ----------------------------------------------------------------------------------------------------------------


def path(found: Steps, units: Units) -> str:
    """Return the second step: the path in space."""
    kind = found.stretch.move.kind
    if not found.in_space:
        return (
            "<p>In a joint move nothing is interpolated in space. The joint values of the knots are, in step 5; the "
            "tool goes where that takes it.</p>"
        )
    if found.way is None:
        return _trouble(found)
    formula = formula_of(kind, "p")
    rows = [
        ("kind", escaped(lowered(kind.title))),
        ("length of the way", units.length(found.length)),
    ]
    straight = length_of(found.knot_poses[:, :3, 3])
    if found.length - straight > BENT * found.arm.length_scale:
        rows.append(("straight between knots", units.length(straight)))
    if found.arm.task.rotation != "none":
        rows.append(("orientation", TURNINGS[found.stretch.move.turning]))
        rows.append(("turns through", units.angle(found.turn)))
    return (
        "<p>A curve through the knots, with a parameter s from 0 to 1 that is not time yet: when the tool is where is "
        "left to the timing law.</p>"
        + (f'<div class="eq small">{mathml(formula, True)}</div>' if formula else "")
        + f'<p class="dim">{escaped(says_of(kind, found.way.position))}</p>'
        + pairs(rows)
    )


# -- 3 ----------------------------------------------------------------------------------------------------------------


def sampling(found: Steps, field: str, units: Units) -> str:
    """Return the third step: how many samples; ``field`` is where their number is typed."""
    if not found.in_space:
        return "<p>Without a path in space there is nothing to sample: the knots are all the points there are.</p>"
    if found.followed is None:
        return _trouble(found)
    count = len(found.samples)
    rows = [
        ("poses", str(count)),
        ("Δs", number(1.0 / (count - 1), 4)),
        ("farthest neighbours", units.length(found.spacing)),
    ]
    return (
        f"<p>A dense but finite sequence of poses on the path, evenly spaced in s: p(0), p(Δs), p(2Δs), … Few are "
        f"cheap, many keep the tool on its path: try 4.</p>{field}{pairs(rows)}"
    )


# -- 4 ----------------------------------------------------------------------------------------------------------------


def inverse(found: Steps, units: Units) -> str:
    """Return the fourth step: the inverse kinematics of the samples."""
    if not found.in_space:
        names = [str(found.stretch.first + k + 1) for k in range(len(found.knot_q))]
        said = (
            f"<p>The inverse kinematics is solved {len(names)} times, once for each knot, and not at all for knots "
            "given by their joint values. The branch is chosen at each knot.</p>"
        )
        return said + joint_table("knot", names, found.knot_q, found, units)
    if found.followed is None:
        return _trouble(found)
    count, solved = len(found.samples), int(found.followed.reached.sum())
    rows = [("solved", f"{solved} of {count} samples")]
    if found.branch:
        rows.append(("branch", escaped(found.branch)))
    if found.least_singular is not None:
        least, s = found.least_singular
        rows.append(("smallest σ<sub>min</sub>/σ<sub>max</sub>", f"{number(least, 3)} at s = {number(s, 2)}"))
    near = int(np.sum(found.worth == Feasible.NEAR_SINGULAR))
    if near:
        rows.append((f"below {NEARLY_SINGULAR:g}", f"{near} samples, joints turn fast"))
    said = (
        "<p>One configuration for each sample. Each search begins at the solution before, so that the arm stays on one "
        f"branch.</p>{_followed(found)}{pairs(rows)}{_other_way(found)}"
    )
    names = [number(s, 2) for s, _ in found.shown_arms]
    q = np.array([q for _, q in found.shown_arms]).reshape(len(names), found.arm.n)
    arms = "<h3>Arms in the scene</h3>" + joint_table("s", names, q, found, units) if names else ""
    return said + arms


def _other_way(found: Steps) -> str:
    """Return what is to be said of a knot that is reached in another configuration than it was stored in."""
    told = [remark for remark in found.leg.remarks if remark.startswith("waypoint")]
    return "".join(f'<p class="dim">{escaped(capitalised(each))}.</p>' for each in told)


def _followed(found: Steps) -> str:
    """Return whether the path could be followed, and where and why not."""
    assert found.followed is not None
    if found.followed.whole:
        return '<p class="ok">✓ The whole path is followed on one branch.</p>'
    stops = found.followed.stops
    said = [stop.sentence for stop in stops[:STOPS]] or [found.followed.reason]
    more = f'<p class="dim">… and {len(stops) - STOPS} more places.</p>' if len(stops) > STOPS else ""
    behind = '<p class="dim">What is solved behind that is not one motion with what is before.</p>'
    parts = behind if len(found.followed.parts) > 1 else ""
    return "".join(f'<p class="no">✕ {escaped(capitalised(each))}</p>' for each in said) + more + parts


# -- 5 ----------------------------------------------------------------------------------------------------------------


def joints(found: Steps, units: Units, colours: tuple[str, str]) -> str:
    """Return the fifth step: the path of the joints; ``colours`` are those of the wanted and the resulting way."""
    apart = found.apart
    if found.path is None or apart is None:
        return f"<p>There is no motion of the joints.</p>{_trouble(found)}"
    said = _spline(found) if found.in_space else _laid(found)
    wanted, result = colours
    k = apart.worst
    far = _small(float(apart.distance[k]), units)
    where = "" if apart.distance[k] < EXACT else f" at s = {number(float(apart.s[k]), 2)}"
    rows = [
        (f"{dot(wanted)} {'path' if found.in_space else 'straight lines'}", units.length(found.length)),
        (f"{dot(result)} way of the tool", units.length(found.tool_length)),
        ("farthest apart", far + where),
    ]
    if found.in_space and found.arm.task.rotation != "none":
        rows.append(("turned away at most", _turn(float(apart.turn.max()), units)))
    larger = f"In the scene the distance is drawn {found.larger:g} times as large. " if found.larger > 1.0 else ""
    return f'{said}{pairs(rows)}<p class="dim">{larger}{_timing(found)}</p>{_untimed(found)}'


def _spline(found: Steps) -> str:
    count = len(found.samples)
    return (
        f"<p>A cubic spline through the {count} solutions is q(s): {count - 1} pieces, equal velocities and "
        "accelerations where two meet. Only at the samples is the tool surely on its path.</p>"
    )


def _laid(found: Steps) -> str:
    kind = found.stretch.move.kind
    formula = formula_of(kind, "q")
    return (
        "<p>The joint values of the knots are interpolated at once. No singularity can stop this, but the tool does "
        "not go straight.</p>"
        + (f'<div class="eq small">{mathml(formula, True)}</div>' if formula else "")
        + f'<p class="dim">{escaped(kind.title)}. {escaped(says_of(kind, found.path))}</p>'
    )


def _timing(found: Steps) -> str:
    """Return what is left to do: the timing law."""
    motion = found.leg.motion
    return (
        ""
        if motion is None
        else (
            f"With the timing law s(t) this is the motion q(s(t)), and takes {number(motion.duration, 2)}{NO_BREAK}s."
        )
    )


def _untimed(found: Steps) -> str:
    """Return why there is no timing law."""
    text = found.leg.trouble
    return f'<p class="no">✕ The timing law: {escaped(text)}.</p>' if text else ""


def _turn(value: float, units: Units) -> str:
    """Return a small angle; behind a power of ten its sign stands apart, or it would read as a zero."""
    text = small(value, True, units)
    return f"{text}{NO_BREAK if units.angle_unit != '°' or '·' in text else ''}{units.angle_unit}"


def _small(value: float, units: Units) -> str:
    return f"0{NO_BREAK}{units.length_unit} but for rounding" if value < EXACT else with_unit(value, False, units)


def _trouble(found: Steps) -> str:
    text = found.leg.trouble or "It is being worked out."
    return f'<p class="no">✕ {escaped(capitalised(text)).rstrip(".")}.</p>'
