"""The table at the top of a lesson: its head, arm, and initial state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.actions import Action, known_robot, read_begin
from armlab.content.check import JOINT_VALUES, configuration
from armlab.content.lesson import LOCKS
from armlab.content.lesson_arm import read_arm
from armlab.content.lesson_fields import Fields, example_name
from armlab.content.lesson_head import Head, read_head
from armlab.content.reader import Table
from armlab.content.robots import Camera, Catalogue, Robot, read_camera, read_pose
from armlab.content.rows import known, unknown


@dataclass(frozen=True, eq=False)
class Front:
    """The front matter: its head; the other attributes are those of `armlab.content.lesson.Lesson`."""

    head: Head
    teaches: tuple[str, ...]
    robot: Robot
    start: NDArray[np.float64]
    panel: str
    example: str
    begin: tuple[Action, ...]
    overlays: tuple[str, ...]
    target: NDArray[np.float64] | None
    camera: Camera | None
    locked: frozenset[str]
    locked_joints: tuple[int, ...]
    hidden: tuple[str, ...]


def read_front(key: str, top: Fields, catalogue: Catalogue) -> Front:
    """Read the table, of which ``variants`` has been taken already.

    Raises
    ------
    ContentError
    """
    robot = _robot(top, catalogue)
    front = Front(
        head=read_head(key, top),
        teaches=_teaches(top),
        robot=robot,
        start=_start(top, robot),
        panel=top.text("panel", ""),
        example=example_name(top, "example") if top.has("example") else "",
        begin=read_begin(top, robot),
        overlays=top.words("overlays"),
        target=_target(top.table("target")),
        camera=_camera(top.table("camera")),
        locked=frozenset(top.some_of("locked", LOCKS)),
        locked_joints=tuple(sorted(set(top.wholes("locked_joints", 1, robot.arm.n)))),
        hidden=top.words("hidden"),
    )
    top.done()
    return front


def _robot(top: Fields, catalogue: Catalogue) -> Robot:
    if not top.has("arm"):
        return known_robot(top, "robot", catalogue)
    if top.has("robot"):
        raise top.fail("robot", "expected either a robot of the lab or a table [arm], not both")
    return read_arm(top)


def _teaches(top: Fields) -> tuple[str, ...]:
    rows = top.words("teaches")
    for row in rows:
        if not known(row):
            raise top.fail("teaches", unknown(row))
    return rows


def _start(top: Fields, robot: Robot) -> NDArray[np.float64]:
    """Take the name of a pose or joint values; without either, return the arm's first pose."""
    given = [key for key in ("pose", *JOINT_VALUES) if top.has(key)]
    if len(given) > 1:
        raise top.fail(given[1], f"expected one of {' and '.join(given)}")
    if not given:
        return robot.home
    if given == ["pose"]:
        return robot.poses[top.choice("pose", robot.poses)]
    return configuration(top, robot)


def _target(table: Table | None) -> NDArray[np.float64] | None:
    if table is None:
        return None
    T = read_pose(table)
    T.setflags(write=False)
    return T


def _camera(table: Table | None) -> Camera | None:
    if table is None:
        return None
    return read_camera(table)
