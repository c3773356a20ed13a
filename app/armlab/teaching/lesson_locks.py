"""The changes that an open lesson refuses."""

from __future__ import annotations

from dataclasses import replace

from armlab.content.lesson import Lesson
from armlab.content.robots import OWN
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.teaching.taught import taught


def refuse_locked(found: Lesson, before: State, now: State) -> None:
    """Raise `InputError` when a change touches anything locked by a lesson; the sentence says what it keeps."""
    robot, was = now[RobotPart], before[RobotPart]
    if robot.robot is not was.robot:
        edited = robot.own and robot.origin == was.origin
        if ("table" if edited else "robot") in found.locked:
            raise _kept("the DH table as it is" if edited else f"the {found.robot_used.name}")
        if edited:
            _refuse_moved(found, before, now)
        return
    _refuse_moved(found, before, now)
    joints, stood = now[Joints], before[Joints]
    # Neither what follows the handle nor what is played is moved by hand.
    others = (Target, Timeline, *(each.part for each in taught()))
    by_hand = all(now[kind] is before[kind] for kind in others) and not before[Target].catching_up
    if "joints" in found.locked and by_hand and joints.q is not stood.q:
        raise _kept("the joints as they are" + ("" if "target" in found.locked else "; drag the handle"))
    moved = now[Target].pose is not before[Target].pose and now[Target].pose is not None
    if "target" in found.locked and moved:
        raise _kept("the target where it is" + ("" if "joints" in found.locked else "; move the joints"))


def held(joints: Joints, lesson: Lesson, on: bool) -> Joints:
    """Return the joints with those locked by a lesson held, or free again."""
    locked = tuple(on if j + 1 in lesson.locked_joints else held for j, held in enumerate(joints.locked))
    return replace(joints, locked=locked)


def freed(state: State, lesson: Lesson | None) -> State:
    """Return the state with the joints free that a lesson holds; the same state without a lesson that holds some."""
    joints = state[Joints]
    if lesson is None or not lesson.locked_joints or joints.arm.n < max(lesson.locked_joints):
        return state
    return state.replace(held(joints, lesson, False))


def _refuse_moved(found: Lesson, before: State, now: State) -> None:
    """Raise `InputError` when a joint that the lesson holds is moved, freed or another one; other arms have none."""
    held = [j - 1 for j in found.locked_joints]
    joints, stood = now[Joints], before[Joints]
    its = before[RobotPart].origin == ("" if found.robot == OWN else found.robot)
    # Arms that a student makes have the origin of one that a lesson brings, but maybe not as many joints.
    if not (held and its and stood.arm.n == found.robot_used.arm.n):
        return
    if joints.arm.n == stood.arm.n and all(
        joints.locked[j] >= stood.locked[j]
        and joints.q[j] == stood.q[j]
        and joints.arm.revolute[j] == stood.arm.revolute[j]
        for j in held
    ):
        return
    joint, they = ("joints", "they stand") if len(held) > 1 else ("joint", "it stands")
    raise _kept(f"{joint} {', '.join(str(j + 1) for j in held)} where {they}")


def _kept(what: str) -> InputError:
    return InputError(f"This lesson keeps {what}.")
