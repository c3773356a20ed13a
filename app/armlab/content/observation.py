"""The data that checks of lessons use, and their form as evidence."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content import evidence
from armlab.content.joint_limits import outside
from armlab.content.robots import Robot
from armlab.content.seen_fact import SeenFact
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.checks import wrong
from armlab.kin.dh import CONVENTIONS, FIELDS, Convention
from armlab.kin.task import task_named

BEYOND = 1e-6
"""Largest excess of a joint value in evidence over its limits, radians or metres, that is rounding."""

SAME_TABLE = 1e-12
"""Largest difference, in m and rad, of tables that are the same: files contain angles in degrees."""

KEYS = ("q", "arm", "target", "seconds", "switches", "panel", "films")
"""Keys of evidence that stand there whatever benches tell."""


class Told(Protocol):
    """A bench as it tells of itself, such as the planned motion."""

    def to_json(self) -> dict[str, Any]:
        """Return it as plain data."""
        ...


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
        Pose of the handle, in the world.
    seconds : float
        Since the step was shown.
    switches : frozenset of str
        Switches that are on.
    panel : str
        The panel that is open; empty for none.
    films : frozenset of str
        Films that were played to their end.
    benches : mapping of str to Told
        What benches tell of themselves, by keys such as ``"motion"``; only what the step asks for, since it takes time.
    facts : mapping of str to SeenFact
        Facts that benches publish, by words such as ``velocity.statics.torques``; only those the step asks for. They
        follow from the inputs of the benches, which are kept as evidence in their place.
    """

    arm: Arm
    q: NDArray[np.float64]
    tool_pose: NDArray[np.float64]
    target: NDArray[np.float64] | None = None
    seconds: float = 0.0
    switches: frozenset[str] = frozenset()
    panel: str = ""
    films: frozenset[str] = frozenset()
    benches: Mapping[str, Told] = field(default_factory=lambda: MappingProxyType({}))
    facts: Mapping[str, SeenFact] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def of(cls, arm: Arm, q: ArrayLike, **more: Any) -> Observation:
        """Return the observation of an arm at q, shape (n,), with other fields by name."""
        values = np.array(q, dtype=np.float64)
        return cls(arm, values, np.array(arm.fk(values), dtype=np.float64), **more)

    def to_json(self) -> dict[str, Any]:
        """Return the observation as plain data. The tool pose is left out, as it follows from arm and joint values."""
        return {
            "q": self.q.tolist(),
            "arm": _written(self.arm),
            "target": None if self.target is None else self.target.tolist(),
            "seconds": self.seconds,
            "switches": sorted(self.switches),
            "panel": self.panel,
            "films": sorted(self.films),
            **{key: told.to_json() for key, told in self.benches.items()},
        }

    @classmethod
    def from_json(
        cls, data: object, robot: Robot, readers: Mapping[str, Callable[[object, str], Told]] = MappingProxyType({})
    ) -> Observation:
        """Read evidence back. It comes from a file that anyone may have changed, so nothing in it is trusted.

        Parameters
        ----------
        data : object
            Data written by `to_json`.
        robot : Robot
            The robot of the lesson. Where the evidence has its table, ``arm`` is the very object ``robot.arm``, whose
            limits and task hold whatever the file says; else the student has edited the table.
        readers : mapping of str to callable, optional
            ``read(data, where)`` of what benches tell, by their keys.

        Raises
        ------
        InputError
            A missing or unknown field, a wrong type or size, a number that is not finite, a joint value outside of
            its limits, a matrix that is no pose.
        """
        fields = evidence.mapping(data, "observation", KEYS, tuple(readers))
        arm = _arm(fields["arm"], robot)
        q = evidence.numbers(fields["q"], "observation.q", arm.n)
        beyond = outside(arm, q, BEYOND)
        if beyond:
            raise InputError(f"observation.q: {beyond}")
        target = fields["target"]
        seconds = evidence.number(fields["seconds"], "observation.seconds")
        if seconds < 0.0:
            raise InputError(f"observation.seconds: expected a number not below zero, got {seconds:g}")
        return cls.of(
            arm,
            q,
            target=None if target is None else evidence.pose(target, "observation.target"),
            seconds=seconds,
            switches=evidence.names(fields["switches"], "observation.switches"),
            panel=evidence.name(fields["panel"], "observation.panel"),
            films=evidence.names(fields["films"], "observation.films"),
            benches={key: read(fields[key], f"observation.{key}") for key, read in readers.items() if key in fields},
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
    """Return the robot's arm when the data have its table, else an arm made from the data."""
    fields = evidence.mapping(data, "observation.arm", tuple(_written(robot.arm)))
    rows = fields["rows"]
    if not isinstance(rows, list) or not 1 <= len(rows) <= MAX_JOINTS:
        raise wrong("observation.arm.rows", f"a list of 1 to {MAX_JOINTS} rows", rows)
    arm = Arm.from_dh(
        [_row(row, f"observation.arm.rows[{i}]") for i, row in enumerate(rows, start=1)],
        _convention(fields["convention"], "observation.arm.convention"),
        evidence.pose(fields["base"], "observation.arm.base"),
        evidence.pose(fields["tool"], "observation.arm.tool"),
        evidence.matrix(fields["limits"], "observation.arm.limits", (len(rows), 2)),
        task=task_named(evidence.name(fields["task"], "observation.arm.task")),
        name=robot.arm.name,
    )
    return robot.arm if same_table(arm, robot.arm) else arm


def same_table(one: Arm, other: Arm) -> bool:
    """Return whether two arms have the same table, base and tool."""

    def numbers(arm: Arm) -> np.ndarray:
        rows = [[row.a, row.alpha, row.d, row.theta] for row in arm.rows]
        return np.concatenate([np.ravel(rows), arm.base.ravel(), arm.tool.ravel()])

    same_kind = one.convention == other.convention and np.array_equal(one.revolute, other.revolute)
    return bool(same_kind and np.allclose(numbers(one), numbers(other), rtol=0.0, atol=SAME_TABLE))


def _convention(value: object, where: str) -> Convention:
    for known in CONVENTIONS:
        if value == known:
            return known
    raise wrong(where, " or ".join(CONVENTIONS), value)


def _row(data: object, where: str) -> Sequence[object]:
    if not isinstance(data, list) or len(data) != len(FIELDS):
        raise wrong(where, f"a list of {', '.join(FIELDS)}", data)
    return [evidence.name(data[0], where), *(evidence.number(value, where) for value in data[1:])]
