"""Examples of chapter 6 of the notes: an arm, waypoints and moves, and what to look at."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.plan.commands import refuse_pathless
from armlab.benches.motion.plan.moves import Move, Waypoint, checked_q, flat_pose
from armlab.benches.motion.plan.state import Plan
from armlab.content.robots import Robot, catalogue
from armlab.kin import ik
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm, with_clip_closed
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    robot : str
        Key of its file.
    q : tuple of tuple of float
        Waypoints as configurations, degrees and metres.
    shifts : tuple of (float, float, float)
        Further waypoints: the first one moved by so many metres along the axes of the world.
    moves : tuple of Move
        One for each waypoint but the first; a single one stands for all.
    says : str
        What to look at, in one or two sentences.
    duration : float or None
        Seconds; None: as fast as allowed.
    compared : bool
        Whether the other kind of moves is planned as well.
    """

    key: str
    title: str
    robot: str
    q: tuple[tuple[float, ...], ...]
    moves: tuple[Move, ...]
    says: str
    shifts: tuple[tuple[float, float, float], ...] = ()
    duration: float | None = None
    compared: bool = False
    settings: dict[str, object] = field(default_factory=dict)

    def plan(self) -> tuple[Robot, Plan]:
        """Return the arm and the plan."""
        robot = catalogue()[self.robot]
        arm = robot.arm
        points = [Waypoint(checked_q(arm, np.where(arm.revolute, np.radians(q), q))) for q in self.q]
        first = points[0].wanted(arm)
        near = points[0].q
        for shift in self.shifts:
            pose = first.copy()
            pose[:3, 3] += shift
            near = checked_q(arm, ik.solve(arm, pose, near).q)
            points.append(Waypoint(near, flat_pose(pose)))
        moves = self.moves * (len(points) - 1) if len(self.moves) == 1 else self.moves
        opened = Plan.initial(robot)
        part = replace(
            opened,
            waypoints=tuple(points),
            moves=moves,
            duration=self.duration,
            compared=self.compared,
            selected=1,
            example=self.key,
            **self.settings,  # type: ignore[arg-type]
        )
        refuse_pathless(arm, part)
        return robot, part


PUMA = (-18.0, 62.0, -160.0, 0.0, -62.0, 0.0)
SQUARE = ((0.0, 0.3, 0.0), (0.0, 0.3, -0.3), (0.0, 0.0, -0.3), (0.0, 0.0, 0.0))

LINE, SPACE_LINE = Move(), Move("cartesian")

EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "joint_or_line",
            "Joint move or straight line",
            "ur10e",
            ((40.0, -70.0, 95.0, -115.0, -90.0, 0.0), (-60.0, -60.0, 85.0, -115.0, -90.0, 0.0)),
            (LINE,),
            "The joint move is straight in joint space, and the tool swings along an arc. The thin line is the "
            "Cartesian move between the same waypoints: shorter for the tool, but slower for the joints.",
            compared=True,
        ),
        Example(
            "corner_stop",
            "A square, stopping at each corner",
            "puma560",
            (PUMA,),
            (SPACE_LINE,),
            "Along straight lines the motion must stop at each corner, or the velocity would have to jump.",
            shifts=SQUARE,
        ),
        Example(
            "corner_fly",
            "The same square with over-fly",
            "puma560",
            (PUMA,),
            (Move("cartesian", Chosen("overfly")),),
            "Parabolas replace the corners: the tool never stops, and passes each corner at a small distance.",
            shifts=SQUARE,
        ),
        Example(
            "circle",
            "An arc through three points",
            "puma560",
            (PUMA,),
            (Move("cartesian", Chosen("circle"), Chosen("trapezoidal")),),
            "Three waypoints, one arc; the tool has the same orientation at all of them and keeps it.",
            shifts=((0.0, 0.2, 0.2), (0.0, 0.4, 0.0)),
        ),
        Example(
            "spline",
            "A spline through five configurations",
            "puma560",
            (
                (-18.0, 62.0, -160.0, 0.0, -62.0, 0.0),
                (20.0, 40.0, -130.0, 20.0, -50.0, 30.0),
                (60.0, 70.0, -170.0, -20.0, -70.0, 60.0),
                (90.0, 50.0, -120.0, 0.0, -40.0, 0.0),
                (40.0, 80.0, -160.0, 0.0, -62.0, 0.0),
            ),
            (Move("joint", Chosen("spline"), Chosen("constant")),),
            "The arm does not stop at the inner waypoints: position, velocity and acceleration are continuous there.",
        ),
        Example(
            "out_of_reach",
            "A line that leaves the workspace",
            "planar_2r_unequal",
            ((20.0, 120.0), (150.0, 120.0)),
            (SPACE_LINE,),
            "Both ends can be reached, and so can every point of the joint move between them. The straight line "
            "comes too close to the base, and is red before anything has moved.",
            compared=True,
        ),
        Example(
            "singular_wrist",
            "A line past a singular wrist",
            "puma560",
            ((-15.0, 63.0, -154.0, -50.0, -27.0, -12.0), (-5.0, 63.0, -149.0, 100.0, -27.0, -162.0)),
            (SPACE_LINE,),
            "Near the singularity joints 4 and 6 rotate fast for a small motion of the tool: because of one "
            "place, the whole line has to be run slowly.",
            compared=True,
        ),
        Example(
            "cartesian_arm",
            "The same line with three prismatic joints",
            "cartesian_3p",
            ((0.2, 0.1, 0.2), (0.6, 0.5, 0.4)),
            (SPACE_LINE,),
            "With three prismatic joints a line in space is also one in joint space: both moves take the same time.",
            compared=True,
        ),
        Example(
            "given_time",
            "Too little time",
            "ur10e",
            ((0.0, -70.0, 95.0, -115.0, -90.0, 0.0), (120.0, -50.0, 70.0, -110.0, -90.0, 90.0)),
            (Move(law=Chosen("quintic")),),
            "The time is too short: the path is red where a limit is exceeded. Uniform time scaling by k "
            "divides velocities by k and accelerations by k²; “As fast as allowed” uses the smallest k that "
            "keeps all limits.",
            duration=0.9,
        ),
    ),
)


@dataclass(frozen=True)
class TakeExample(Command):
    """Load an example: its arm, waypoints, moves and limits."""

    key: str
    label: ClassVar[str] = "example"

    def apply(self, state: State) -> State:
        """Return the state with the example's plan, its arm at the first waypoint."""
        robot, part = EXAMPLES[self.key].plan()
        state = on_arm(with_clip_closed(state), robot.key).replace(part)
        moved = state[Joints].moved_to(part.waypoints[0].q)
        return state if moved is state[Joints] else state.replace(moved)


BENCH = Bench("motion", 20, EXAMPLES, TakeExample)
