"""A planned motion as a Python script that computes it again with the library alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.motion.files.read import column_names, refuse_long
from armlab.benches.motion.plan.laws import RAMPS, how, unkept
from armlab.benches.motion.plan.moves import EULER_AXES
from armlab.benches.motion.plan.paths import joint_scales, passed, places
from armlab.benches.motion.plan.question import Leg, Planned, Question
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import law_types
from armlab.session.parts.robot import RobotPart

Floats = NDArray[np.float64]

HEAD = '''\
"""A motion planned in Armlab, made again with its library.

Run it where armlab is installed. It writes {file}: time, joint values, velocities and accelerations in s, rad and m.
"""

{imports}

RATE = {rate!r}  # samples a second, at least

{arm}
'''

FOOT = """
# The samples.
samples = motion.sample(rate=RATE)
table = np.column_stack([samples.t, samples.q, samples.qdot, samples.qddot])
header = (
{header}
)
np.savetxt("{file}", table, fmt="%.12f", delimiter=",", header=header, comments="")
"""

GRIPPER = {"open": "opens", "close": "closes"}

NAMES = (
    "Hold",
    "Limits",
    "Sequential",
    "Through",
    "ToolPath",
    "Trajectory",
    "about_one_axis",
    "by_euler_angles",
    "follow",
    "held",
    "independent",
    "law_type",
    "path_type",
    "scaled",
)
"""Names of `armlab.kin.motion` that a script may need."""


def motion_script(part: RobotPart, planned: Planned, rate: float, file: str) -> str:
    """Return the script of the part of a planned motion that can be run.

    Parameters
    ----------
    part : RobotPart
        The arm of the motion.
    planned : Planned
    rate : float
        Samples a second of the table it writes.
    file : str
        Name of the table, of letters, digits, points and underscores.

    Raises
    ------
    InputError
        Nothing of it can be run, or the table would be too long.
    """
    if planned.motion is None:
        raise InputError(f"script: there is no motion to write ({planned.trouble})")
    refuse_long(planned.duration, rate)
    question = planned.question
    body = _legs(planned) if question.recorded is None else _recorded(question, planned.duration)
    made = f"{_arm(part)}\n{body}"
    used = [name for name in NAMES if f"{name}(" in made]
    imports = ["import numpy as np", "", "import armlab", f"from armlab.kin.motion import {', '.join(used)}"]
    head = HEAD.format(file=file, imports="\n".join(imports), rate=float(rate), arm=_arm(part))
    header = "\n".join(f'    "{line}"' for line in _header(question.arm))
    return head + body + FOOT.format(header=header, file=file)


def _header(arm: Arm) -> list[str]:
    """Return the header of the table, with one quantity in each line."""
    names, n = column_names(arm), arm.n
    groups = [names[:1], *(names[1 + k * n : 1 + (k + 1) * n] for k in range(3))]
    return [",".join(group) + ("," if k < 3 else "") for k, group in enumerate(groups)]


# -- the arm ---------------------------------------------------------------------------------------------------------


def _arm(part: RobotPart) -> str:
    """Return the line that loads the arm of a file, or the lines that make the student's own one."""
    arm = part.robot.arm
    if not part.own:
        return f'arm = armlab.load("{part.robot.key}")'
    rows = [f'    armlab.Row("{row.kind}", {row.a!r}, {row.alpha!r}, {row.d!r}, {row.theta!r}),' for row in arm.rows]
    lines = ["rows = [  # kind, a, alpha, d, theta: m and rad", *rows, "]"]
    options = [f'"{arm.convention}"', "limits=limits", f'task="{arm.task.key}"']
    lines.append(f"limits = {_array(arm.limits)}")
    for name, pose in (("base", arm.base), ("tool", arm.tool)):
        if not np.array_equal(pose, np.eye(4)):
            lines.append(f"{name} = {_array(pose)}")
            options.append(f"{name}={name}")
    return "\n".join([*lines, f"arm = armlab.Arm.from_dh(rows, {', '.join(options)})"])


# -- the legs --------------------------------------------------------------------------------------------------------


def _legs(planned: Planned) -> str:
    question, lines = planned.question, ["legs = []"]
    running = planned.running
    q = np.array(question.waypoints[0].q)
    for k, leg in enumerate(running):
        rest = _rest(question, 0, _array(q)) if k == 0 else []
        lines += ["", *rest, *_leg(question, leg, q, first=k == 0)]
        assert leg.motion is not None
        assert leg.stretch is not None
        if leg.stretch.end is not None:
            lines += _rest(question, leg.stretch.end, "legs[-1].at(legs[-1].duration)")
        q = leg.motion.at(leg.motion.duration)
    whole = "legs[0]" if sum(line.startswith("legs.append") for line in lines) == 1 else "Sequential(legs)"
    return "\n".join([*lines, "", f"motion = {whole}", ""])


def _rest(question: Question, k: int, place: str) -> list[str]:
    """Return the lines of what is done at a waypoint."""
    point = question.waypoints[k]
    does = [f"# At waypoint {k + 1} the gripper {GRIPPER[point.gripper]}."] if point.gripper in GRIPPER else []
    return [*does, *([f"legs.append(Hold({place}, {point.wait!r}))"] if point.wait else [])]


def _leg(question: Question, leg: Leg, q: Floats, first: bool) -> Iterable[str]:
    """Yield the lines of a leg that begins at q."""
    stretch, motion = leg.stretch, leg.motion
    assert stretch is not None
    assert motion is not None
    move = stretch.move
    law = law_types()[move.law.key]
    yield f"# Move {stretch.first + 1} to {stretch.last + 1}, in {move.space} space: {move.kind.title}; {law.title}"
    if move.independent:
        yield from _apart(question, leg, q)
        return
    if move.space == "joint":
        yield from _in_joints(question, leg, q)
    else:
        start = _array(q) if first else "legs[-1].at(legs[-1].duration)"
        yield from _in_space(question, leg, q, start)
    if question.duration is not None and RAMPS & set(move.law.options):
        yield f"law = {_call('law_type', law.key)}.law({_options({'duration': motion.duration, **move.law.options})})"
        yield "legs.append(Trajectory(path, law))"
    else:
        yield f"law = {_call('law_type', law.key)}.along(path, {_how(question, leg)})"
        yield "# In the time of the plan: that within the limits of joints and tool, or the one that was asked for."
        yield f"legs.append(Trajectory(path, law.stretched({motion.duration!r} / law.duration)))"


def _apart(question: Question, leg: Leg, q: Floats) -> Iterable[str]:
    """Yield the lines of a straight move in which each joint moves by itself."""
    assert leg.stretch is not None
    assert leg.motion is not None
    law = leg.stretch.move.law
    yield "# Each joint by itself, as fast as its limits allow."
    yield f"start = {_array(q)}"
    yield f"end = {_array(question.waypoints[leg.stretch.last].q)}"
    yield f'apart = independent(start, end, "{law.key}", {_how(question, leg)})'
    yield f"legs.append(scaled(apart, {leg.motion.duration!r} / apart.duration))"


def _in_joints(question: Question, leg: Leg, q: Floats) -> Iterable[str]:
    assert leg.stretch is not None
    stretch = leg.stretch
    knots = np.array([point.q for point in question.waypoints[stretch.first : stretch.last + 1]])
    knots[0] = q
    yield f"knots = {_array(knots)}"
    scales = joint_scales(question.arm)
    how = "" if scales is None else f", scales={_list(scales)}"
    yield f"path = {_path(leg)}.path(knots{how}{_more(leg)})"


def _in_space(question: Question, leg: Leg, q: Floats, start: str) -> Iterable[str]:
    """Yield the lines of the tool path and its inverse kinematics."""
    assert leg.stretch is not None
    assert leg.tool_path is not None
    arm, stretch, way = question.arm, leg.stretch, leg.tool_path
    points = question.waypoints[stretch.first : stretch.last + 1]
    poses = np.array([point.wanted(arm) for point in points])
    if points[0].pose is None or stretch.first:
        poses[0] = arm.fk(q)
    yield f"poses = {_array(poses)}"
    yield "R, points = poses[:, :3, :3], poses[:, :3, 3]"
    behind = ""
    if way.point.any():
        yield f"centre = np.array({_list(way.point)})  # of the wrist, in the tool frame: it follows the path"
        yield "points = R @ centre + points"
        behind = ", centre"
    passing = passed(stretch, poses)
    moved = passing[:, :3, :3] @ way.point + passing[:, :3, 3]
    turn = _orientation(arm, leg, places(way.position, moved) if len(poses) > 2 else None)
    yield f"way = ToolPath({_path(leg)}.path(points{_more(leg)}), {turn}{behind})"
    yield f"found = follow(arm, way, {start}, {question.samples}, carry_on=True)"
    yield "path = found.joint_path()"


def _orientation(arm: Arm, leg: Leg, at: Floats | None) -> str:
    """Return the orientation of the tool along the path, as in `armlab.benches.motion.plan.paths.tool_path`."""
    assert leg.stretch is not None
    turning = leg.stretch.move.turning
    if arm.task.rotation == "none" or turning == "kept":
        return "held(R[0])"
    if turning == "euler":
        return f'by_euler_angles(R[0], R[1], "{EULER_AXES}")'
    if at is None:
        return "about_one_axis(R[0], R[1])"
    assert leg.tool_path is not None
    corners = leg.tool_path.position.corners
    sharp = f", corners={_list(corners)}" if len(corners) else ""
    return f"Through({'R[[*range(len(R)), 0]]' if leg.stretch.move.returns else 'R'}, {_list(at)}{sharp})"


def _how(question: Question, leg: Leg) -> str:
    """Return the limits and options of a law as arguments, as in `armlab.benches.motion.plan.laws.fastest`."""
    assert leg.stretch is not None
    held, given = question.limits.of_joints(), how(question, leg.stretch)
    shape, jumps = given.pop("shape"), given.pop("jumps")
    more = {"shape": shape} if shape.bounded != held.bounded else {}
    # Only where something jumps: the library refuses what cannot be kept, the lab tells it.
    told = {"jumps": jumps} if leg.motion is not None and unkept(question, leg.motion) else {}
    return ", ".join(filter(None, (repr(held), _options({**more, **told, **given}))))


def _recorded(question: Question, duration: float) -> str:
    recorded = question.recorded
    assert recorded is not None
    t = np.array(recorded.t) - recorded.t[0]
    through = 'path_type("spline").path(q, times=t, ends="natural")'
    rates = []
    if recorded.qdot is not None:
        through = 'path_type("hermite").path(q, times=t, velocities=qdot)'
        rates = [f"qdot = {_array(recorded.qdot)}"]
    return "\n".join(
        [
            f"t = np.array({_list(t)})",
            f"q = {_array(recorded.q)}",
            *rates,
            f"path = {through}",
            f'motion = Trajectory(path, law_type("constant").law({duration!r}))',
            "",
        ]
    )


# -- writing ---------------------------------------------------------------------------------------------------------


def _path(leg: Leg) -> str:
    assert leg.stretch is not None
    return _call("path_type", leg.stretch.move.path.key)


def _more(leg: Leg) -> str:
    """Return the options of the path as further arguments."""
    assert leg.stretch is not None
    options = _options(leg.stretch.move.path.options)
    return f", {options}" if options else ""


def _call(function: str, key: str) -> str:
    return f'{function}("{key}")'


def _options(values: dict[str, Any]) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def _list(values: ArrayLike) -> str:
    return repr(np.asarray(values, dtype=float).tolist())


def _array(values: ArrayLike) -> str:
    """Return an array with a line for each row and with all digits."""
    array = np.asarray(values, dtype=float)
    if array.ndim < 2:
        return f"np.array({_list(array)})"
    rows: Sequence[Any] = array.tolist()
    return "\n".join(["np.array(", "    [", *(f"        {row!r}," for row in rows), "    ]", ")"])
