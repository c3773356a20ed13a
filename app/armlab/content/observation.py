"""What the check of a lesson may look at, and how it is kept as evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.checks import wrong
from armlab.kin.dh import CONVENTIONS, FIELDS, Convention
from armlab.kin.task import task_named
from armlab.kin.transforms import as_pose

LONGEST_NAME, MOST_NAMES = 64, 200
"""Characters of a name of a switch, panel or film in evidence, and how many names there may be."""

LARGEST = 1e6
"""Largest size of a number in evidence: metres, radians or seconds."""

BEYOND = 1e-6
"""Radians or metres by which a joint value in evidence may be outside of the limits, from rounding."""

_KEYS = ("q", "arm", "target", "seconds", "switches", "panel", "films")


@dataclass(frozen=True, eq=False)
class Observation:
    """The arm and the lab as they are on screen.

    Attributes
    ----------
    arm : Arm
    q : ndarray, shape (n,)
        Radians and metres.
    tool_pose : ndarray, shape (4, 4)
        The tool in the world.
    target : ndarray, shape (4, 4), or None
        Where the handle stands, in the world.
    seconds : float
        Since the step was shown.
    switches : frozenset of str
        What is switched on.
    panel : str
        The panel that is open; empty for none.
    films : frozenset of str
        What was played to its end.
    """

    arm: Arm
    q: NDArray[np.float64]
    tool_pose: NDArray[np.float64]
    target: NDArray[np.float64] | None = None
    seconds: float = 0.0
    switches: frozenset[str] = frozenset()
    panel: str = ""
    films: frozenset[str] = frozenset()

    @classmethod
    def of(cls, arm: Arm, q: ArrayLike, **more: Any) -> Observation:
        """Return what is seen of an arm at q, shape (n,); the other fields by their names."""
        values = np.array(q, dtype=np.float64)
        return cls(arm, values, np.array(arm.fk(values), dtype=np.float64), **more)

    def to_json(self) -> dict[str, Any]:
        """Return it as plain data. The pose of the tool is left out: it follows from arm and joint values."""
        return {
            "q": self.q.tolist(),
            "arm": _written(self.arm),
            "target": None if self.target is None else self.target.tolist(),
            "seconds": self.seconds,
            "switches": sorted(self.switches),
            "panel": self.panel,
            "films": sorted(self.films),
        }

    @classmethod
    def from_json(cls, data: object, robot: Robot) -> Observation:
        """Read evidence back. It comes from a file that anyone may have changed, so nothing in it is trusted.

        Parameters
        ----------
        data : object
            As `to_json` writes it.
        robot : Robot
            The robot of the lesson. Where the evidence has its table, ``arm`` is the very object ``robot.arm``;
            else the student has edited the table, and ``arm is robot.arm`` is false.

        Raises
        ------
        InputError
            A missing or unknown field, a wrong type or size, a number that is not finite, a joint value outside of
            its limits, a matrix that is no pose.
        """
        fields = _mapping(data, "observation", _KEYS)
        arm = _arm(fields["arm"], robot)
        q = _numbers(fields["q"], "observation.q", arm.n)
        if not arm.within_limits(q, BEYOND):
            raise InputError("observation.q: outside the joint limits")
        target = fields["target"]
        seconds = _number(fields["seconds"], "observation.seconds")
        if seconds < 0.0:
            raise InputError(f"observation.seconds: expected a number not below zero, got {seconds:g}")
        return cls.of(
            arm,
            q,
            target=None if target is None else _pose(target, "observation.target"),
            seconds=seconds,
            switches=_names(fields["switches"], "observation.switches"),
            panel=_name(fields["panel"], "observation.panel"),
            films=_names(fields["films"], "observation.films"),
        )


def _written(arm: Arm) -> dict[str, Any]:
    return {
        "convention": arm.convention,
        "rows": [[getattr(row, field) for field in FIELDS] for row in arm.rows],
        "base": arm.base.tolist(),
        "tool": arm.tool.tolist(),
        "limits": arm.limits.tolist(),
        "task": arm.task.key,
    }


def _arm(data: object, robot: Robot) -> Arm:
    """Return the robot's arm where the data is its table, else an arm made of the data."""
    fields = _mapping(data, "observation.arm", tuple(_written(robot.arm)))
    if fields == _written(robot.arm):
        return robot.arm
    rows = fields["rows"]
    if not isinstance(rows, list) or not 1 <= len(rows) <= MAX_JOINTS:
        raise wrong("observation.arm.rows", f"a list of 1 to {MAX_JOINTS} rows", rows)
    return Arm.from_dh(
        [_row(row, f"observation.arm.rows[{i}]") for i, row in enumerate(rows, start=1)],
        _convention(fields["convention"], "observation.arm.convention"),
        _pose(fields["base"], "observation.arm.base"),
        _pose(fields["tool"], "observation.arm.tool"),
        _matrix(fields["limits"], "observation.arm.limits", (len(rows), 2)),
        task=task_named(_name(fields["task"], "observation.arm.task")),
        name=robot.arm.name,
    )


def _convention(value: object, where: str) -> Convention:
    for known in CONVENTIONS:
        if value == known:
            return known
    raise wrong(where, " or ".join(CONVENTIONS), value)


def _row(data: object, where: str) -> Sequence[object]:
    if not isinstance(data, list) or len(data) != len(FIELDS):
        raise wrong(where, f"a list of {', '.join(FIELDS)}", data)
    return [_name(data[0], where), *(_number(value, where) for value in data[1:])]


def _mapping(data: object, where: str, keys: tuple[str, ...]) -> Mapping[str, Any]:
    if not isinstance(data, dict) or set(data) != set(keys):
        raise wrong(where, f"exactly the fields {', '.join(keys)}", data)
    return data


def _number(value: object, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= LARGEST:
        raise wrong(where, f"a number up to {LARGEST:g}", value)
    return float(value)


def _numbers(value: object, where: str, count: int) -> NDArray[np.float64]:
    if not isinstance(value, list) or len(value) != count:
        raise wrong(where, f"{count} numbers", value)
    return np.array([_number(entry, where) for entry in value])


def _matrix(value: object, where: str, shape: tuple[int, int]) -> NDArray[np.float64]:
    if not isinstance(value, list) or len(value) != shape[0]:
        raise wrong(where, f"{shape[0]} rows", value)
    return np.array([_numbers(row, where, shape[1]) for row in value])


def _pose(value: object, where: str) -> NDArray[np.float64]:
    return as_pose(_matrix(value, where, (4, 4)), where)


def _names(value: object, where: str) -> frozenset[str]:
    if not isinstance(value, list) or len(value) > MOST_NAMES:
        raise wrong(where, f"a list of at most {MOST_NAMES} names", value)
    return frozenset(_name(name, where) for name in value)


def _name(value: object, where: str) -> str:
    if not isinstance(value, str) or len(value) > LONGEST_NAME:
        raise wrong(where, f"a name of at most {LONGEST_NAME} characters", value)
    return value
