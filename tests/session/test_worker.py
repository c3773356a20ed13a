"""The worker: students in turn, and none who waits for those who ask for much."""

import threading
import time

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.session.mailbox import MOST, Mailbox
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.target import DragTarget, EndDrag, target_pose
from armlab.session.served import ALIKE
from armlab.session.session import Session
from armlab.session.state import Command
from armlab.session.worker import TOO_MANY, TURN, Worker
from support.patience import WAIT, Patience

PUMA = catalogue()["puma560"]


@pytest.fixture
def session():
    return Session.fresh("token", PUMA)


class Broken(Command):
    """A command with a bug."""

    def apply(self, state):
        return 1 / 0


class Recorder:
    """Collects what a worker publishes."""

    def __init__(self):
        self.states = []
        self.done = threading.Event()

    def __call__(self, session):
        self.states.append(session.state)
        self.done.set()


def wait_for(condition):
    patience = Patience()
    while not condition():
        assert patience.left(), "the condition did not come true"
        time.sleep(0.002)


@pytest.fixture
def worker():
    recorder = Recorder()
    worker = Worker(recorder)
    worker.start()
    yield worker, recorder
    worker.stop()
    assert worker.join(2.0)


def test_the_worker_is_idle_when_all_is_applied_and_published(session):
    busy = []
    worker = Worker(lambda _session: busy.append(not worker.idle))
    assert worker.idle
    worker.post(session, MoveJoint(0, 0.5))
    assert not worker.idle
    worker.start()
    wait_for(lambda: worker.idle)
    worker.stop()
    worker.join(2.0)
    assert busy == [True]
    assert session.state[Joints].q[0] == 0.5


def test_the_worker_applies_what_is_posted(worker, session):
    thread, recorder = worker
    thread.post(session, MoveJoint(0, 0.5))
    wait_for(lambda: recorder.states)
    assert session.state[Joints].q[0] == 0.5


def test_the_worker_outlives_a_broken_command_and_a_broken_page(session, caplog):
    calls = []

    def publish(_session):
        calls.append(1)
        raise RuntimeError("the page is gone")

    worker = Worker(publish)
    worker.start()
    worker.post(session, Broken())
    wait_for(lambda: calls)
    worker.post(session, MoveJoint(0, 0.25))
    wait_for(lambda: len(calls) == 2)
    assert session.state[Joints].q[0] == 0.25
    worker.stop()
    worker.join(2.0)
    assert "the page is gone" in caplog.text


class Dear(Command):
    """A command that takes as long as a turn."""

    undoable = False

    def apply(self, state):
        time.sleep(1.1 * TURN)
        return state


def served_in_order(*posted):
    """Return whom a worker serves, in order, that finds these commands waiting; it ends when nothing waits."""
    served = []
    worker = Worker(lambda session: served.append(session.token))
    for session, command in posted:
        worker.post(session, command)
    worker.start()
    wait_for(lambda: worker.counts.applied == sum(1 for _ in posted) and served)
    worker.stop()
    worker.join(2.0)
    return served


def test_who_asks_for_much_lets_others_in_between():
    greedy, modest = Session.fresh("greedy", PUMA), Session.fresh("modest", PUMA)
    served = served_in_order(*[(greedy, Dear())] * 5, (modest, MoveJoint(0, 0.5)))
    assert served in (["greedy", "modest", *["greedy"] * 4], ["modest", *["greedy"] * 5]), "or it passes the first"
    assert modest.state[Joints].q[0] == 0.5


class Long(Command):
    """A command that lasts until it is released."""

    undoable = False
    began, released = threading.Event(), threading.Event()

    def apply(self, state):
        self.began.set()
        assert self.released.wait(WAIT)
        return state


def test_a_hand_that_drags_passes_a_command_that_takes_long_and_who_asks_for_much_does_not():
    slow, modest, greedy = (Session.fresh(token, PUMA) for token in ("slow", "modest", "greedy"))
    worker = Worker(lambda _: None)
    worker.start()
    worker._served.add("greedy", 100.0 * ALIKE)
    worker.post(slow, Long())
    assert Long.began.wait(WAIT)
    worker.post(slow, MoveJoint(0, 0.1))
    worker.post(greedy, MoveJoint(0, 0.2))
    for k in range(20):
        worker.post(modest, MoveJoint(0, 0.01 * k))
        wait_for(lambda k=k: modest.state[Joints].q[0] == 0.01 * k)
    assert slow.state[Joints].q[0] != 0.1, "what one student asks for is done in its order"
    assert greedy.state[Joints].q[0] != 0.2
    assert not worker.idle
    Long.released.set()
    wait_for(lambda: worker.idle)
    assert (slow.state[Joints].q[0], greedy.state[Joints].q[0]) == (0.1, 0.2)
    assert (worker.counts.posted, worker.counts.applied) == (23, 23)
    worker.stop()
    assert worker.join(2.0)


def test_who_waited_before_a_long_command_began_passes_it_too(monkeypatch):
    monkeypatch.setattr(Long, "began", threading.Event())
    monkeypatch.setattr(Long, "released", threading.Event())
    slow, modest = Session.fresh("slow", PUMA), Session.fresh("modest", PUMA)
    worker = Worker(lambda _: None)
    worker.post(slow, Long())
    worker.post(modest, MoveJoint(0, 0.5))
    worker.start()
    wait_for(lambda: modest.state[Joints].q[0] == 0.5)
    Long.released.set()
    worker.stop()
    assert worker.join(WAIT)


def test_a_flood_of_dear_commands_is_told_and_not_kept():
    greedy = Session.fresh("greedy", PUMA)
    worker = Worker(lambda _: None)
    for _ in range(MOST + 10):
        worker.post(greedy, Dear())
    assert greedy.notice.text == TOO_MANY
    assert len(greedy.mailbox) == MOST


def test_students_are_served_in_turn():
    """Who has waited longest is next: one who goes on posting comes again only after all others."""
    served = []
    sessions = [Session.fresh(f"student {k}", PUMA) for k in range(5)]

    def publish(session):
        served.append(session.token)
        if len(served) <= 5:
            worker.post(session, MoveJoint(0, 0.5))

    worker = Worker(publish)
    for session in sessions:
        worker.post(session, MoveJoint(0, 0.1))
        worker.post(session, MoveJoint(0, 0.2))
    worker.start()
    wait_for(lambda: len(served) == 10)
    worker.stop()
    worker.join(2.0)
    assert served == [session.token for session in sessions] * 2
    assert (worker.counts.posted, worker.counts.applied) == (15, 10)


def test_a_command_that_is_served_while_it_is_handed_in_is_served_once(session, monkeypatch):
    publish, post = threading.Event(), Mailbox.post

    def slow(mailbox, *letter):
        found = post(mailbox, *letter)
        wait_for(lambda: not len(mailbox) or worker.idle)
        return found

    monkeypatch.setattr(Mailbox, "post", slow)
    worker = Worker(lambda _session: (publish.set(), time.sleep(0.002)))
    worker.start()
    for k in range(20):
        publish.clear()
        worker.post(session, MoveJoint(0, 0.01 * k))
        assert publish.wait(WAIT)
    wait_for(lambda: worker.idle)
    worker.stop()
    assert worker.join(2.0)
    assert (worker.counts.posted, worker.counts.applied, worker.counts.runs) == (20, 20, 20)


def test_one_drag_is_one_chain_of_commands(session):
    """A scripted drag: how many commands are posted, applied, and how often the worker runs."""
    publish = threading.Event()
    worker = Worker(lambda _session: publish.set())
    worker.start()
    T = np.array(target_pose(session.state))
    for _ in range(10):
        T = T.copy()
        T[0, 3] += 0.005
        publish.clear()
        worker.post(session, DragTarget(T, 1))
        assert publish.wait(WAIT)
    worker.post(session, EndDrag(T, 1))
    wait_for(lambda: worker.counts.applied == 11)
    worker.stop()
    worker.join(2.0)
    assert (worker.counts.posted, worker.counts.applied, worker.counts.runs) == (11, 11, 11)
    assert len(session.history.past) == 1
