"""Whatever a student does elsewhere, what waits is bit-identical on return, and undo stays in its place."""

import numpy as np
import pytest

from armlab.benches.pose.tool.state import LookAt
from armlab.benches.robot.normal.state import PlaceLines, TakeAxes
from armlab.benches.robot.trainer.commands import StartTrainer
from armlab.benches.velocity.ellipsoid.state_sweep import SweepJoint
from armlab.content.robots import catalogue
from armlab.session.edits import AddJoint, SetCell, SetLimits
from armlab.session.fields import Set
from armlab.session.parts.display import Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose, TakePose
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.selection import Select
from armlab.session.parts.target import PlaceTarget, target_pose
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import (
    HOME,
    SANDBOX,
    SHARED,
    BackFromShared,
    BackToLesson,
    OpenShared,
    Shelf,
    ToSandbox,
)
from support.trips import SCARA, UR10, applied, reloaded, same

PUMA = catalogue()["puma560"]


def play(rng, session):
    """Return a random command; some are refused, as those of hands are."""
    arm = session.state[Joints].arm
    joint = int(rng.integers(arm.n))
    choices = (
        lambda: MoveJoint(joint, float(rng.uniform(-3.0, 3.0))),
        lambda: RandomPose(),
        lambda: TakePose("zero"),
        lambda: LockJoint(joint, bool(rng.integers(2))),
        lambda: ChooseRobot(str(rng.choice(["scara", "ur10", "cartesian_3p", "planar_3r", "planar_2r"]))),
        lambda: SetCell(joint, str(rng.choice(["a", "alpha", "d", "theta"])), float(rng.uniform(-1.0, 1.0))),
        lambda: SetLimits(joint, -0.5, 0.5),
        lambda: AddJoint(joint),
        lambda: Show(str(rng.choice(["frames", "dark", "trace"])), bool(rng.integers(2))),
        lambda: Set(Notation, "angle", str(rng.choice(["deg", "rad"]))),
        lambda: PlaceTarget(_near(rng, session)),
        lambda: PlaceLines(str(rng.choice(["skew", "parallel"]))),
        lambda: TakeAxes(int(rng.integers(max(1, arm.n - 1)))),
        lambda: OpenClip(str(rng.choice(["film", "sweep", ""]))),
        lambda: Seek(float(rng.uniform(0.0, 9.0))),
        lambda: Set(Timeline, "loop", bool(rng.integers(2))),
        lambda: SweepJoint(joint),
        lambda: Select("pose", 0, joint),
        lambda: LookAt("0", "E"),
        lambda: StartTrainer(),
        lambda: GoToStep(int(rng.integers(3))),
        lambda: Answer(str(rng.integers(9))),
        lambda: Undo(),
        lambda: Undo(),
        lambda: Redo(),
    )
    return choices[rng.integers(len(choices))]()


def _near(rng, session):
    T = np.array(target_pose(session.state))
    T[:3, 3] += rng.uniform(-0.1, 0.1, 3)
    return T


def arm_and_pose(state):
    return str(state[RobotPart].to_json()), state[Joints].q.tobytes()


@pytest.mark.parametrize("seed", range(10))
def test_places_are_bit_identical_on_return_and_undo_stays_in_its_place(seed):
    rng = np.random.default_rng(seed)
    session = applied(Session.fresh("token", PUMA), OpenLesson("first_arm"))
    left, seen = {}, {HOME: {arm_and_pose(session.state)}, SANDBOX: set()}
    seen[HOME].add(arm_and_pose(State.initial(PUMA)))
    trips = 0
    for _ in range(120):
        here = session.state[Shelf]
        if rng.random() < 0.2:
            ways = (ToSandbox(), BackToLesson(), OpenShared(SCARA), OpenShared(UR10), BackFromShared())
            command = ways[rng.integers(len(ways))]
        else:
            command = play(rng, session)
        before = session.state
        applied(session, command)
        there = session.state[Shelf]
        place = (there.place, there.shared)
        if place != (here.place, here.shared):
            trips += 1
            left[here.place] = before
            assert session.state[LessonPart].progress_of == before[LessonPart].progress_of
            if there.place != SHARED and there.place in left:
                same(session.state, left[there.place].replace(paused(left[there.place])))
            if there.place == SHARED:
                seen[SHARED] = set()
        if isinstance(command, Undo | Redo):
            assert arm_and_pose(session.state) in seen[there.place]
        seen[there.place].add(arm_and_pose(session.state))
        assert bool(session.state[LessonPart].open) == (there.place == HOME)
    assert trips > 5
    assert reloaded(session.state)[Shelf].to_json() == session.state[Shelf].to_json()


def paused(state):
    timeline = state[Timeline]
    return Timeline(timeline.clip, timeline.time, False, timeline.speed, timeline.loop)
