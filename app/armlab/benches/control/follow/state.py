"""Kinematic control: the settings of up to four runs, the target of regulation, and the results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.chosen import FIELDS, MOST_RUNS, Setup, joint_values, setup_from, setup_of
from armlab.benches.control.follow.runs import Outcome, Question
from armlab.benches.motion.api import question as plan_question
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.run_targets import checked_target, first_start, first_target, target_after
from armlab.session.state import Json, Part, PartType, State

CLIP_KEY = "control"

FIRST_SPEED = 0.15
"""Speed of the line with which an arm begins, in length scales a second."""

MOST_PUSHED = 10.0
"""Largest push, metres."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Control(Part):
    """Runs of kinematic control.

    Attributes
    ----------
    runs : tuple of Setup
        One to four, each in a colour of its own.
    selected : int
        The run whose values are in the form, and which is played.
    target : ndarray, shape (4, 4)
        Wanted pose of the tool, of runs that regulate; it follows the target of the lab when that is moved.
    push : float
        Metres by which the button pushes the tool aside.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    before : tuple of float or None
        Where the arm stood when a run was put on; None while none is on.
    outcomes : dict
        What the runs have given, by their colour; may be of a question that has passed. Not saved.
    revolute : tuple of bool
        Whether each joint of the arm turns. Not saved.
    """

    key: ClassVar[str] = "control"

    runs: tuple[Setup, ...]
    target: Floats
    selected: int = 0
    push: float = 0.05
    example: str = ""
    before: tuple[float, ...] | None = None
    outcomes: Mapping[int, Outcome] = field(default_factory=dict)
    revolute: tuple[bool, ...] = ()

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return one run with feedback: a line towards the axis of the base, as away from it the arm gets stretched."""
        scale, start = robot.arm.length_scale, first_start(robot)
        run = setup_of(
            robot,
            start,
            speed=_round(FIRST_SPEED * scale, FIELDS["speed"].high),
            azimuth=np.pi if _in_front(robot, start) else 0.0,
            radius=_round(0.3 * scale, FIELDS["radius"].high),
            inverse="dls_variable",
            duration=4.0,
        )
        return cls((run,), first_target(robot), push=_round(0.05 * scale, MOST_PUSHED), revolute=_kinds(robot))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep all runs if the joints are the same, else begin anew."""
        arm, n = robot.arm, len(self.runs[0].start)
        if origin != tuple(range(n)) or self.revolute != _kinds(robot):
            return self.initial(robot)  # radians are no metres
        runs = tuple(
            replace(run, start=joint_values(arm, run.start, "start"), link=min(run.link, arm.n)) for run in self.runs
        )
        target = target_after(robot, self.target)
        return replace(self, runs=runs, target=target, example="", before=None, outcomes={})

    def after(self, before: State, now: State) -> Self:
        """Follow the target of the lab, and forget the earlier configuration when the run is closed."""
        part, pose = self, now[Target].pose
        moved = pose is not None and pose is not before[Target].pose and self is before[Control]
        if moved and pose is not None and not np.array_equal(pose, self.target):
            part = replace(part, target=pose)
        if part.before is not None and now[Timeline].clip != CLIP_KEY:
            part = replace(part, before=None)
        return part

    def to_json(self) -> Json:
        """Write all but the results of the runs."""
        return {
            "runs": [run.to_json() for run in self.runs],
            "target": self.target.tolist(),
            "selected": self.selected,
            "push": self.push,
            "example": self.example,
            "before": None if self.before is None else list(self.before),
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the runs back; raises if they cannot be used with this arm."""
        runs = tuple(setup_from(robot, each) for each in data["runs"])
        selected, before = int(data["selected"]), data.get("before")
        colours = {run.colour for run in runs}
        if not 1 <= len(runs) == len(colours) <= MOST_RUNS or not 0 <= selected < len(runs):
            raise InputError(f"control: not usable: {len(runs)} runs, run {selected + 1} selected")
        return cls(
            runs,
            checked_target(robot, data["target"]),
            selected,
            checked_push(data["push"]),
            str(data.get("example", "")),
            None if before is None else joint_values(robot.arm, before, "before"),
            revolute=_kinds(robot),
        )

    @property
    def run(self) -> Setup:
        """The selected run."""
        return self.runs[self.selected]

    @property
    def outcome(self) -> Outcome | None:
        """Result of the selected run, as far as it is known."""
        return self.outcomes.get(self.run.colour)


PART = PartType(Control, order=99)


def _kinds(robot: Robot) -> tuple[bool, ...]:
    return tuple(map(bool, robot.arm.revolute))


def _in_front(robot: Robot, q: Floats) -> bool:
    """Return whether the tool is where x of frame 0 is not negative."""
    base, p = robot.arm.base, np.asarray(robot.arm.position(q))
    return float(base[:3, 0] @ (p - base[:3, 3])) >= 0.0


def _round(value: float, most: float) -> float:
    """Return a number rounded to one digit, as a person would choose it, and not above the largest permitted."""
    return min(float(f"{value:.0e}"), most)


def checked_push(push: float) -> float:
    """Return the size of a push, metres; `InputError` unless it is more than 0 and at most `MOST_PUSHED`."""
    metres = float(finite_floats(push, "push", (), "metres"))
    if not 0.0 < metres <= MOST_PUSHED:
        raise InputError(f"push: expected more than 0 and at most {MOST_PUSHED:g} m")
    return metres


def questions(state: State) -> tuple[Question, ...]:
    """Return the question of each run."""
    part, arm = state[Control], state[RobotPart].robot.arm
    target = part.target.tobytes()
    return tuple(
        Question(
            arm,
            replace(run, colour=0, name=""),
            target if run.reference == "target" else b"",
            state.derived(plan_question) if run.reference == "planned" else None,
        )
        for run in part.runs
    )


def fresh(state: State) -> bool:
    """Return whether the result of the selected run answers its present question."""
    part = state[Control]
    return part.outcome is not None and part.outcome.question == state.derived(questions)[part.selected]


def made_step(state: State) -> float | None:
    """Return the step with which the selected run was made, seconds; None if it is not made yet, or has no step."""
    outcome = state[Control].outcome
    if outcome is None or outcome.run is None or not outcome.run.steps or not fresh(state):
        return None
    return outcome.run.step


def standing_start(state: State) -> Floats:
    """Return the configuration of the arm at the start of the selected run, before it is made, (n,)."""
    run = state[Control].run
    return np.asarray(np.array(run.start) + np.array(run.offset))


def starts_elsewhere(state: State) -> bool:
    """Return whether the selected run begins where first runs do because the home pose is singular or nearly so."""
    robot, start = state[RobotPart].robot, np.array(state[Control].run.start)
    return np.array_equal(start, first_start(robot)) and not np.array_equal(start, robot.home)


def here(state: State) -> tuple[float, ...]:
    """Return the present joint values of the arm."""
    return tuple(state[Joints].q.tolist())
