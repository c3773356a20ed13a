"""Actions in lesson files, translated to commands of the lab."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from armlab.content import actions
from armlab.content.bench_words import BenchWord
from armlab.session import edits
from armlab.session.bench import PutInPlace
from armlab.session.parts.display import Show
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import PlaceTarget
from armlab.session.state import Command, State
from armlab.session.words import command_of
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.taught import taught


def commands_of(action: actions.Action, state: State) -> Iterator[Command]:
    """Yield the commands of an action, none for what waits, plays or answers a question.

    Raises
    ------
    LessonError
        A word of a bench or its arguments are wrong.
    """
    if isinstance(action, BenchWord):
        yield command_of(action)
    elif isinstance(action, actions.Move):
        yield from (MoveJoint(i, float(value)) for i, value in enumerate(action.q))
    elif isinstance(action, actions.MoveTarget):
        yield PlaceTarget(action.T)
    elif isinstance(action, actions.SetCell):
        yield edits.SetCell(action.row, action.field, action.value)
    elif isinstance(action, actions.TakeRobot):
        yield ChooseRobot(action.key)
    elif isinstance(action, actions.SetSwitch):
        yield Show(action.name, action.on)
    elif isinstance(action, actions.TakeExample):
        yield PutInPlace(action.name)
    else:
        for each in taught():
            yield from each.commands(action, state)


def with_done(state: State, done: Iterable[actions.Action]) -> State:
    """Return the state after actions of a start, and after what parts make of each.

    The open lesson neither forbids any of it nor takes it for the work of a student.

    Raises
    ------
    ArmlabError
        One is wrong or is refused.
    """
    for action in done:
        for command in commands_of(action, state):
            state = _after(state, command)
    return state


def _after(state: State, command: Command) -> State:
    changed = command.apply(state)
    if changed is state or not command.reacts:
        return changed
    adapted = [part.after(state, changed) for part in changed if not isinstance(part, LessonPart)]
    return changed.replace(*adapted)
