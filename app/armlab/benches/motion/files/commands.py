"""Commands for motions and plans from files, and for waypoints made from a recorded motion."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, NoReturn

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.files.read import FORMAT, VERSION
from armlab.benches.motion.files.table import MOST_BYTES, read_table, refuse_unreadable
from armlab.benches.motion.files.thin import APART, evenly, farthest
from armlab.benches.motion.pick.state import Pick
from armlab.benches.motion.plan.commands import PlanCommand, edited, with_plan
from armlab.benches.motion.plan.moves import MOST_WAYPOINTS, Move, Waypoint, checked_q
from armlab.benches.motion.plan.read import too_many
from armlab.benches.motion.plan.state import Plan
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.state import Command, Json, State

By = Literal["time", "shape"]
"""Ways to choose places of a recorded motion."""

BOM = "\ufeff"
"""Mark that some editors put before a text."""

MOST_MADE = 20
"""Largest number of waypoints that are made from a recorded motion, as more cannot be edited by hand."""

SPLINE = Move(path=Chosen("spline"))

WAYPOINT = re.compile(r'"q"\s*:\s*\[\s*[^\s\[]')
"""Pattern for the beginning of one configuration's joint values; those of a recorded motion are rows."""

OUTSIDE = 1e-6
"""Distance beyond a joint limit, rad or m, that a plan in a file may have by rounding."""


def reading(text: str) -> Command:
    """Return the command for the text of a file: a plan in JSON, or else a table of samples."""
    return ReadPlan(text) if text.lstrip(BOM + " \t\r\n").startswith("{") else ReadMotion(text)


@dataclass(frozen=True)
class ReadMotion(PlanCommand):
    """Replace the waypoints by a motion from a table; they return when it is removed."""

    text: str
    label: ClassVar[str] = "motion from a file"

    def apply(self, state: State) -> State:
        """Return the state with the motion, in its own time; an unreadable one is refused, with row and column."""
        recorded = read_table(state[Joints].arm, self.text)
        return state.replace(edited(state[Plan], recorded=recorded, duration=None))


@dataclass(frozen=True)
class ReadPlan(PlanCommand):
    """Replace the plan by one from a file, with its boxes if it has some; a plan of another arm also loads that arm."""

    text: str
    label: ClassVar[str] = "plan from a file"

    def apply(self, state: State) -> State:
        """Return the state with the plan; an unreadable one is refused."""
        _refuse_large(self.text)
        refuse_unreadable(self.text, "plan")
        try:
            return _with_file(state, json.loads(self.text.lstrip(BOM), parse_constant=_not_finite))
        except InputError:
            raise
        except json.JSONDecodeError as mistake:
            raise InputError(f"plan, row {mistake.lineno}, column {mistake.colno}: {mistake.msg}") from None
        except Exception as error:
            # Nobody can list what a damaged file may raise, and it must not be more than a refusal.
            text = "plan: the file lacks what a plan needs; it is damaged, or of another kind"
            raise InputError(text) from error


@dataclass(frozen=True)
class BackToWaypoints(PlanCommand):
    """Remove a recorded motion; the waypoints return unchanged."""

    label: ClassVar[str] = "back to the waypoints"

    def apply(self, state: State) -> State:
        """Return the state without a recorded motion."""
        part = state[Plan]
        return state if part.recorded is None else state.replace(replace(part, recorded=None))


@dataclass(frozen=True)
class MakeWaypoints(PlanCommand):
    """Make waypoints from a recorded motion, with a spline through them.

    Parameters
    ----------
    count : int
        2 to `MOST_MADE`; fewer are made where the arm stands still.
    by : str
        ``"time"``: evenly spaced; ``"shape"``: those that polygons through the ones before miss most.
    """

    count: int
    by: By = "shape"
    label: ClassVar[str] = "waypoints of a motion"

    def apply(self, state: State) -> State:
        """Return the state with waypoints in place of the motion."""
        part, arm = state[Plan], state[Joints].arm
        if part.recorded is None:
            raise InputError("waypoints: there is no recorded motion; read one from a file first")
        if not 2 <= self.count <= MOST_MADE:
            raise InputError(f"waypoints: expected 2 to {MOST_MADE}, got {self.count}")
        t, q = np.array(part.recorded.t), np.array(part.recorded.q)
        choose = evenly if self.by == "time" else farthest
        scaled = q / np.where(arm.revolute, 1.0, arm.length_scale)
        chosen = choose(t, scaled, self.count)
        if len(chosen) < 2:
            raise InputError(f"waypoints: {self._alike(scaled)}")
        points = tuple(Waypoint(checked_q(arm, q[k])) for k in chosen)
        moves = (SPLINE if len(points) > 2 else Move(),) * (len(points) - 1)
        return with_plan(state, edited(part, waypoints=points, moves=moves, selected=1))

    def _alike(self, q: NDArray[np.float64]) -> str:
        """Return in words why all chosen places of a motion, (N, n) in radians or length scales, are the same."""
        if float(np.abs(q - q[0]).max()) < APART:
            return "the arm stands still in this motion"
        if self.by == "time":
            return f"at {self.count} evenly spaced times the arm is where it began; take more, or choose them by shape"
        return f"the motion ends where it began; take more than {self.count}"


def _refuse_large(text: str) -> None:
    """Raise `InputError` for a text that is longer than the page can send, and may be cut off."""
    if len(text) <= MOST_BYTES:
        return
    count = len(WAYPOINT.findall(text))
    if count > MOST_WAYPOINTS:
        raise InputError(too_many(f"{count} or more"))
    raise InputError(f"plan: the file is larger than {MOST_BYTES / 1e6:g} MB; save a long motion as a table (CSV)")


def _not_finite(word: str) -> NoReturn:
    raise InputError(f"plan: expected finite numbers, got {word}")


def _with_file(state: State, data: Json) -> State:
    """Return the state with the plan in a file; raises an error of any type if it is not usable."""
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise InputError(f'plan: expected a file with "format": "{FORMAT}", as the lab saves it')
    if data.get("version") != VERSION:
        raise InputError(f"plan: expected version {VERSION} of the format, got {str(data.get('version'))[:20]}")
    for name in ("robot", "plan"):
        if data.get(name) is None:
            raise InputError(f"plan: {name!r} is missing in the file")
    robot, written, present = data["robot"], data["plan"], state[RobotPart]
    same = _table(robot) == _table(present.to_json())
    if not same:
        part = RobotPart.from_json(robot, robot_from_json(robot))
        state = state.with_robot(part.robot).replace(part)
    whole = {**written, "before": None} if isinstance(written, dict) else written
    plan = Plan.from_json(whole, state[RobotPart].robot)
    _refuse_outside(plan, written["waypoints"])
    if data.get("pick") is not None:
        state = state.replace(Pick.from_json(data["pick"], state[RobotPart].robot))
    old = state[Plan]
    # Until this plan is worked out, the last one of the arm is drawn and played, as after every other change.
    return with_plan(state, replace(plan, before=old.before, planned=old.planned, other=old.other))


def _table(robot: Json) -> Json:
    """Return the part of a written arm that describes the arm itself."""
    return robot["toml"] if isinstance(robot, dict) else robot


def _refuse_outside(plan: Plan, written: Json) -> None:
    """Raise `InputError` if a waypoint had to be moved inside the limits."""
    for k, (point, data) in enumerate(zip(plan.waypoints, written, strict=True)):
        moved = np.flatnonzero(np.abs(np.array(point.q) - data["q"]) > OUTSIDE)
        if len(moved):
            raise InputError(f"plan, waypoint {k + 1}: joint {moved[0] + 1} is outside its limits")
