"""The session of one student: present state, undo, messages."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from armlab.content.robots import Robot
from armlab.errors import ArmlabError, DeadLink, InputError, Outdated, in_one_line
from armlab.session.history import HEAVIEST, History
from armlab.session.mailbox import Mailbox
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Stand, State, apply, guard

log = logging.getLogger(__name__)

LONGEST_NOTICE = 600
"""Longest notice, in characters."""


@dataclass(frozen=True)
class Undo(Command):
    """Take the last step back."""


@dataclass(frozen=True)
class Redo(Command):
    """Restore the step that was taken back last."""


@dataclass(frozen=True)
class StartFresh(Command):
    """Forget everything, history included, for the next person at a shared computer."""

    label: ClassVar[str] = "start"


@dataclass(frozen=True)
class Refuse(Command):
    """Refuse what a person typed, with a sentence."""

    text: str

    def apply(self, state: State) -> State:
        """Raise the refusal."""
        raise InputError(self.text)


@dataclass(frozen=True)
class RefuseLink(Command):
    """Refuse a link that leads nowhere, with a sentence."""

    text: str

    def apply(self, state: State) -> State:
        """Raise the refusal."""
        raise DeadLink(self.text)


@dataclass(frozen=True)
class Asked(Command):
    """A request by one field or button: all of it is done, or nothing, and refusals are shown there.

    Parameters
    ----------
    commands : tuple of Command
        Applied one after the other.
        Undo and such stand alone.
    refused : callable
        Called, in the worker's thread, with the reason why not; returns whether it can be said there. Otherwise it is
        a notice.
    """

    commands: tuple[Command, ...]
    refused: Callable[[str], bool]


@dataclass(frozen=True)
class Notice:
    """A message that is shown once.

    Attributes
    ----------
    number : int
        Increases with each.
    text : str
    heading : str
        Heading of one that stays until it is closed; the others are refusals.
    before : Notice or None
        The first of those that stay and had been shown on no page when this one came.
    """

    number: int
    text: str
    heading: str = ""
    before: Notice | None = None


@dataclass(eq=False)
class Session:
    """One student. Only the worker changes it; views read ``state``, which is immutable.

    Attributes
    ----------
    token : str
        Token of the student's browser.
    opening : Robot
        The arm a fresh session begins with.
    state : State
    notice : Notice or None
        The latest message for the student.
    notice_seen : int
        Number of the last notice that some page has shown; a page that opens later shows only newer ones.
    untaken : int
        How often a page may show what a person did and what does not hold: a command was refused, changed nothing, or
        was taken back before anybody was shown it. Pages then show again what holds.
    switched_by : int or None
        The window that has last changed what is open by some part (`Part.opened`), None for the lab itself.
    drafts : dict
        What was chosen or typed last in answers that are not handed in, by place: with it a page begins that opens
        later, as after a lost connection. Pages alone know what it is; it is not saved.
    saved : set
        The work of which some page has saved the file as it was closed, so that no other page does so again.
    """

    token: str
    opening: Robot
    state: State
    history: History = field(default_factory=History)
    mailbox: Mailbox = field(default_factory=Mailbox)
    notice: Notice | None = None
    notice_seen: int = 0
    untaken: int = 0
    switched_by: int | None = None
    drafts: dict[str, Any] = field(default_factory=dict)
    saved: set[Any] = field(default_factory=set)
    _elsewhere: dict[str, History] = field(default_factory=dict)

    @classmethod
    def fresh(cls, token: str, opening: Robot) -> Session:
        """Return a new session."""
        return cls(token, opening, State.begun(opening, token))

    @property
    def robot(self) -> Robot:
        """The arm on the table."""
        return self.state[RobotPart].robot

    def apply(self, command: Command, at: float, window: int | None = None) -> None:
        """Apply one command. A refused or failing one leaves the state as it was, and a notice.

        Parameters
        ----------
        command : Command
        at : float
            Seconds since 1970; strokes with a pause between them are steps of their own.
        window : int or None
            The one of the student that has posted it, None for the lab itself.
        """
        before = self.state
        asked, refused = (command.commands, command.refused) if isinstance(command, Asked) else ((command,), _nowhere)
        command = asked[0] if len(asked) == 1 else command
        try:
            if isinstance(command, Undo):
                self._become(self._stepped(self.history.undo, self.history.redo, at), window)
            elif isinstance(command, Redo):
                self._become(self._stepped(self.history.redo, self.history.undo, at), window)
            elif isinstance(command, StartFresh):
                for part in self.state.with_own("refuse_forgetting"):
                    part.refuse_forgetting()
                fresh = State.begun(self.opening, self.token)
                self._become(fresh.replace(self.state[Panels]), window)
                self.history = History()
                self._elsewhere.clear()
                self.drafts.clear()
            else:
                self._take(asked, at, window)
        except ArmlabError as refusal:
            if isinstance(refusal, Outdated) or not refused(cut(str(refusal))):
                self.tell(str(refusal), "Not found" if isinstance(refusal, DeadLink) else "")
        except Exception as error:
            # In one line: strangers send commands, too. The trace is for debugging.
            name = ", ".join(type(each).__name__ for each in asked)
            log.error("%s failed: %s", name, in_one_line(error))
            log.debug("%s failed", name, exc_info=error)
            self.tell(f"{name} failed inside the lab; nothing was changed.")
        if self.state is before or isinstance(command, (Undo, Redo, StartFresh)):
            self.untaken += 1

    def _become(self, state: State, window: int | None) -> None:
        """Take on a state; who sees that something else is open also sees which window has switched it."""
        if _opened(state) != _opened(self.state):
            self.switched_by = window
        self.state = state

    def _take(self, commands: tuple[Command, ...], at: float, window: int | None) -> None:
        """Apply all commands in order, or none."""
        states = [self.state]
        if window is not None:
            commands = tuple(command.asked_in(window) for command in commands)
        for command in commands:
            states.append(apply(states[-1], command, at))
        for command, after in zip(commands, states[1:], strict=True):
            if after is not self.state:
                self._note(command, after, at)
                self._become(after, window)

    def _note(self, command: Command, after: State, at: float) -> None:
        """Record a step of undo. Each place has its own history; a shared one and a preview start empty.

        It also begins anew where a command ends it: an undo would jump across what that has put in place.
        """
        before, here, there = self.state, stand_of(self.state), stand_of(after)
        if here != there:
            if not here.passing:
                self._elsewhere[here.name] = self.history
                while len(self._elsewhere) > 1 and sum(each.held for each in self._elsewhere.values()) > HEAVIEST:
                    del self._elsewhere[next(iter(self._elsewhere))]
            self.history = History() if there.passing else self._elsewhere.pop(there.name, History())
            before = _waiting(before, there.name)
        if command.ends_history(self.state, after):
            self.history = History()
        if command.undoable and _is_work(before, after):
            self.history.note(before, after, command, at)

    def _stepped(self, step: Callable[[State], State], back: Callable[[State], State], at: float) -> State:
        """Return the state after undo or redo; a refused one stays in the history."""
        found = step(self.state)
        try:
            restored = _with_kept(self._let_go(found), self.state)
            if restored is self.state:
                return restored
            guard(self.state, restored)
            now = restored.dated(at)
            adapted = [(part, part.after(self.state, now)) for part in restored.with_own("looks_at_undo")]
        except ArmlabError:
            back(found)
            raise
        changed = [new for part, new in adapted if new is not part]
        return restored.replace(*changed) if changed else restored

    def _let_go(self, found: State) -> State:
        """Return a state of the history without what held in it by a part, and does not hold any more."""
        for part in self.state.with_own("for_undo"):
            found = part.for_undo(found)
        return found

    def refusal(self, found: State | None) -> str:
        """Return why a state of the history cannot be restored now; empty where it can, or there is none.

        Pages ask whenever they are shown: what undo does not change is not made to fit another arm for that.
        """
        if found is None:
            return ""
        kept = [part for part in self.state if part.kept_by_undo]
        try:
            guard(self.state, self._let_go(found).replace(*kept))
        except ArmlabError as refusal:
            return str(refusal)
        return ""

    def tell(self, text: str, heading: str = "") -> None:
        """Show a notice to the student; see `Notice`."""
        last = self.notice
        number = 1 if last is None else last.number + 1
        waits = last if last is not None and last.number > self.notice_seen else None
        if waits is not None:
            waits = waits.before or (waits if waits.heading else None)
        self.notice = Notice(number, cut(text), heading, waits)


def stand_of(state: State) -> Stand:
    """Return the place at which the student works: the last that a part knows of lies over those before it."""
    stands = [part.stand for part in state.with_own("stand")]
    return next((stand for stand in reversed(stands) if stand is not None), Stand(""))


def _waiting(state: State, stand: str) -> State:
    """Return the state that waits at another place, or the same one if none does; the last part is asked first."""
    found = [part.waiting_at(stand) for part in state.with_own("waiting_at")]
    return next((each for each in reversed(found) if each is not None), state)


def _opened(state: State) -> list[str]:
    return [part.opened for part in state.with_own("opened")]


def cut(text: str) -> str:
    """Return a sentence, cut to the length of a notice."""
    return text if len(text) <= LONGEST_NOTICE else f"{text[: LONGEST_NOTICE - 3]}..."


def _nowhere(_: str) -> bool:
    return False


def _with_kept(restored: State, present: State) -> State:
    """Return a restored state with the present parts that undo does not change."""
    robot = restored[RobotPart].robot
    kept = [part for part in present if part.kept_by_undo]
    if _same_table(restored[RobotPart], present[RobotPart]):
        kept = [part.for_edited(robot, tuple(range(robot.arm.n))) for part in kept]
    elif robot is not present[RobotPart].robot:
        kept = [part.for_robot(robot) for part in kept]
    changed = [part for part in kept if part is not restored[type(part)]]
    return restored.replace(*changed) if changed else restored


def _is_work(before: State, after: State) -> bool:
    """Return whether an undo would bring something back: not if only parts have changed that it leaves as they are."""
    return any(after[type(part)] is not part for part in before if not part.kept_by_undo)


def _same_table(one: RobotPart, other: RobotPart) -> bool:
    """Return whether both arms are states of one edited table, with the same joints."""
    edited = one.robot is not other.robot and one.origin == other.origin and (one.own or other.own)
    return edited and np.array_equal(one.robot.arm.revolute, other.robot.arm.revolute)
