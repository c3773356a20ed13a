"""A lesson file for the present state of an arm, to which students have to bring it."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content import robots
from armlab.content.arithmetic import shortest
from armlab.content.check import PLAIN, signed
from armlab.content.lesson import Lesson
from armlab.content.lesson_file import parse_lesson
from armlab.content.observation import Observation
from armlab.content.quantities import UNITS
from armlab.content.robots import Camera, Robot
from armlab.content.write_robot import robot_toml
from armlab.errors import ContentError, InputError
from armlab.kin.checks import finite_floats
from armlab.kin.rotations import euler_zyx
from armlab.kin.transforms import as_pose
from armlab.registry import known_name

Vector = NDArray[np.float64]

CHAPTER = "My lessons"
MINUTES, CAN = 5, "Bring the arm to a given pose."
PART_OF_REACH = 0.01
"""Largest distance of the tool from the goal, relative to the reach."""

WITHIN_DEG, WITHIN_M = 2.0, 0.01
"""Tolerances of angles, degrees, and of prismatic joints, metres."""

NEAR = 0.02
"""Distance of every joint from the goal, relative to its range, below which a start is too near."""

_DECIMALS = 6
_SHOWN_DECIMALS = 3
"""Least decimals of lengths in the text of a task; an arm of centimetres needs more, or its text misses its goal."""

_JOINT_DECIMALS = 11
"""Decimals of joint values in degrees: the rest is 1e-13 rad, the rounding of conversions."""

_HEADER = re.compile(r"^(\[\[?)(\w+)(\]\]?)$", re.MULTILINE)


@dataclass(frozen=True)
class NumberAsked:
    """A question for a number: ``text`` in Markdown, ``answer`` and ``tolerance`` in ``unit``."""

    text: str
    answer: float
    unit: str
    tolerance: float


def lesson_text(
    title: str,
    robot: Robot,
    q: ArrayLike,
    *,
    panel: str = "",
    overlays: Sequence[str] = (),
    target: ArrayLike | None = None,
    camera: Camera | None = None,
    answers: Sequence[NumberAsked] = (),
    begin: Sequence[tuple[str, Mapping[str, Any]]] = (),
) -> str:
    """Return a complete lesson file whose goal is the arm at q.

    It starts in the robot's first pose or, where that is the goal, in another named pose or inside the limits. Its
    first step has a check with a small tolerance, a hint and a solution; each question makes a further step.

    Parameters
    ----------
    title : str
    robot : Robot
        A robot of the catalogue, or an edited one, which is then written into the lesson.
    q : array_like, shape (n,)
        Radians and metres, inside the limits.
    panel, overlays : str, sequence of str, optional
        The panel and the switches, as in lesson files.
    target : array_like, shape (4, 4), optional
        Initial pose of the handle, in the world.
    camera : Camera, optional
    answers : sequence of NumberAsked, optional
    begin : sequence of (str, mapping of str to object), optional
        Words of benches and their arguments, done when the lesson opens.

    Raises
    ------
    InputError
        q does not fit the arm, a question is wrong, or the arm has only one configuration.
    """
    goal = finite_floats(q, "q", (robot.arm.n,), f"{robot.arm.n} finite numbers")
    if not robot.arm.within_limits(goal):
        raise InputError(f"q: expected values inside the joint limits of {robot.name}")
    for asked in answers:
        known_name("unit of a question", asked.unit, UNITS)
    last = "\n".join(line for number, asked in enumerate(answers, start=1) for line in _question(number, asked))
    for task in (_pose_task(robot, goal), _joints_task(robot, goal)):
        for start in _starts(robot, goal):
            front = _front(title, robot, start, panel, overlays, target, camera, begin)
            text = f"{front}\n{_step(robot, goal, *task)}{last}"
            if _is_a_task(text, goal):
                return text
    raise InputError(f"{robot.name} has only this configuration: there is nothing to do")


def _is_a_task(text: str, goal: Vector) -> bool:
    """Return whether the goal meets the check of a lesson and its start does not."""
    try:
        lesson: Lesson = parse_lesson("written", text)
    except ContentError as error:
        raise InputError(f"the lesson cannot be written: {error.problem}") from None
    arm, check = lesson.robot_used.arm, lesson.steps[0].check
    if check is None:
        return False
    met, _ = check.judge(Observation.of(arm, goal))
    return met and not check.judge(Observation.of(arm, lesson.start))[0]


def _starts(robot: Robot, goal: Vector) -> Iterator[str]:
    """Yield lines of the front matter for starts that are not near the goal."""
    low, high = robot.arm.limits.T
    near = NEAR * np.maximum(high - low, 1e-9)
    for name, q in robot.poses.items():
        if np.any(np.abs(q - goal) > near):
            yield f"pose = {_text(name)}"
    for part in (0.5, 0.4, 0.65, 0.25, 0.8):
        q = low + part * (high - low)
        if np.any(np.abs(q - goal) > near):
            yield _joint_values(robot, q)


def _front(
    title: str,
    robot: Robot,
    start: str,
    panel: str,
    overlays: Sequence[str],
    target: ArrayLike | None,
    camera: Camera | None,
    begin: Sequence[tuple[str, Mapping[str, Any]]],
) -> str:
    known = robots.catalogue().robots.get(robot.key) is robot
    lines = ["+++", f"title = {_text(title.strip() or 'My lesson')}", f"chapter = {_text(CHAPTER)}"]
    lines += ["after = []", f"minutes = {MINUTES}", f"can = [{_text(CAN)}]", "teaches = []"]
    lines += [f"robot = {_text(robot.key)}"] if known else []
    lines += [start]
    lines += [f"panel = {_text(panel)}"] if panel else []
    lines += [f"overlays = [{', '.join(map(_text, overlays))}]"] if overlays else []
    if target is not None:
        T = as_pose(target, "target")
        lines += ["", "[target]", f"position = {_numbers(T[:3, 3])}", f"rpy_deg = {_numbers(_roll_pitch_yaw(T))}"]
    if camera is not None:
        lines += ["", "[camera]", *(f"{key} = {shortest(value)}" for key, value in vars(camera).items())]
    for word, arguments in begin:
        lines += ["", "[[do]]", f"command = {_text(word)}", *(f"{key} = {_value(v)}" for key, v in arguments.items())]
    if not known:
        lines += ["", "[arm]", _own_arm(robot)]
    return "\n".join([*lines, "+++", ""])


def _own_arm(robot: Robot) -> str:
    """Return the text of the robot with the headers of its tables within ``arm``."""
    named = replace(robot, name=_plain(robot.name), summary=_plain(robot.summary), source=_plain(robot.source))
    return _HEADER.sub(r"\1arm.\2\3", robot_toml(replace(named, expected=()))).rstrip()


def _step(robot: Robot, goal: Vector, asked: str, check: Iterable[str], hint: str) -> str:
    lines = ["## Bring the arm there", "", asked, "", "```check", *check, "```", "", "```hint", hint, "```", ""]
    return "\n".join([*lines, "```solution", _joint_values(robot, goal), "```", ""])


def _pose_task(robot: Robot, goal: Vector) -> tuple[str, list[str], str]:
    """Return task text, lines of the check, and a hint, for the controlled part of the tool pose."""
    arm = robot.arm
    T = np.asarray(arm.fk(goal), dtype=np.float64)
    within = float(f"{PART_OF_REACH * 2.0 * arm.length_scale:.2g}")
    check = [f"position = {_numbers(T[:3, 3])}", f"tolerance_m = {shortest(within)}"]
    place = ", ".join(_length(float(x), within) for x in T[:3, 3])
    hint = (
        "The hand is at {{px:m}}, {{py:m}}, {{pz:m}}. Move one joint at a time and watch which of the three it changes."
    )
    upright = abs(arm.base[2, 2] - 1.0) < 1e-9
    if arm.task.rotation == "none" or (arm.task.rotation == "phi" and upright):
        if arm.task.rotation == "none":
            return f"Bring the hand to ({place}) m.", ['kind = "tool_at"', *check], hint
        phi = math.atan2(T[1, 0], T[0, 0])
        check += [f"phi_deg = {_rounded(math.degrees(phi))}", f"tolerance_deg = {shortest(WITHIN_DEG)}"]
        return f"Bring the hand to ({place}) m, turned to φ = {PLAIN.angle(phi)}.", ['kind = "tool_at"', *check], hint
    angles = _roll_pitch_yaw(T)
    check += [f"rpy_deg = {_numbers(angles)}", f"tolerance_deg = {shortest(WITHIN_DEG)}"]
    turned = ", ".join(PLAIN.angle(math.radians(angle)) for angle in angles)
    asked = f"Bring the hand to ({place}) m, with roll, pitch and yaw {turned}."
    return asked, ['kind = "tool_pose"', *check], f"{hint} Its angles are {{{{roll}}}}, {{{{pitch}}}}, {{{{yaw}}}}."


def _joints_task(robot: Robot, goal: Vector) -> tuple[str, list[str], str]:
    """Return task text, lines of the check, and a hint, for the joint values, when the tool does not move."""
    revolute = robot.arm.revolute
    check = ['kind = "joints_at"', _joint_values(robot, goal)]
    within = min(WITHIN_M, PART_OF_REACH * 2.0 * robot.arm.length_scale)
    check += [f"tolerance_deg = {shortest(WITHIN_DEG)}"] if revolute.any() else []
    check += [] if revolute.all() else [f"tolerance_m = {shortest(within)}"]
    values = [
        PLAIN.angle(float(value)) if turns else f"{_length(float(value), within)} m"
        for value, turns in zip(goal, revolute, strict=True)
    ]
    return f"Bring the joints to {', '.join(values)}.", check, "Joint 1 is at {{q1}}."


def _length(value: float, within: float) -> str:
    """Return a length in metres with so many decimals that a point written with them lies well within a tolerance."""
    return signed(value, max(_SHOWN_DECIMALS, math.ceil(math.log10(2.0 * math.sqrt(3.0) / within))))


def _question(number: int, asked: NumberAsked) -> Iterator[str]:
    yield from ("", f"## Question {number}", "", "```question", 'kind = "number"', f"text = {_text(asked.text)}")
    yield f"answer = {shortest(asked.answer)}"
    if asked.unit:
        yield f"unit = {_text(asked.unit)}"
    yield from (f"tolerance = {shortest(asked.tolerance)}", "```", "")


def _joint_values(robot: Robot, q: Vector) -> str:
    revolute = robot.arm.revolute
    key = "q_deg" if revolute.all() else "q_deg_m" if revolute.any() else "q_m"
    values = [
        shortest(round(math.degrees(float(value)), _JOINT_DECIMALS)) if turns else shortest(float(value))
        for value, turns in zip(q, revolute, strict=True)
    ]
    return f"{key} = [{', '.join(values)}]"


def _roll_pitch_yaw(T: Vector) -> list[float]:
    """Return the angles in degrees of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    yaw_pitch_roll, _ = euler_zyx(T[:3, :3])
    return [float(angle) for angle in np.degrees(yaw_pitch_roll[::-1])]


def _numbers(values: Iterable[float]) -> str:
    return f"[{', '.join(_rounded(float(value)) for value in values)}]"


def _rounded(value: float) -> str:
    return shortest(round(value, _DECIMALS))


def _plain(text: str) -> str:
    """Return a text in which a lesson file finds no expressions."""
    return re.sub(r"\{(?=\{)", "{ ", text).lstrip("= ")


def _value(value: Any) -> str:
    """Return a text, a number, a truth value or a list of these in TOML."""
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    return _text(value) if isinstance(value, str) else json.dumps(value)


def _text(text: str) -> str:
    """Return a basic string of TOML; it is escaped as in JSON, with DEL escaped as well."""
    return json.dumps(_plain(text), ensure_ascii=False).replace("\x7f", "\\u007f")
