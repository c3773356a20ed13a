"""Long work: begun by what the state wants, in pieces, cancelled, shared by all students."""

import threading
import time

import pytest

from armlab.content.robots import catalogue
from armlab.session import runner as module
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.runner import Runner
from armlab.session.session import Session
from support.patience import Patience

PATIENCE = 60.0


class Desk:
    """Applies what is posted, at once, and remembers what was found."""

    def __init__(self):
        self.found, self.told, self.changed = [], [], threading.Condition()

    def post(self, session, command):
        session.apply(command, 0.0)
        if session.notice is not None:
            with self.changed:
                self.told.append(session.notice.text)
                self.changed.notify_all()

    def delivered(self, state, inputs, found):
        with self.changed:
            self.found.append((inputs, found))
            self.changed.notify_all()
        return state

    def until(self, met):
        with self.changed:
            assert self.changed.wait_for(met, PATIENCE), (self.found, self.told)


@pytest.fixture
def desk():
    return Desk()


@pytest.fixture
def running(monkeypatch, desk):
    """Start a runner with one job; ends it afterwards."""
    started = []

    def start(run, wanted=None, interval=0.0):
        def by_joint(state, panels):
            value = round(float(state[Joints].q[0]), 3)
            return Wanted(value, value) if "made_up" in panels else None

        job = Job("made_up", "The made-up work", wanted or by_joint, run, desk.delivered, interval)
        monkeypatch.setattr(module, "jobs", lambda: {"made_up": job})
        runner = Runner(desk.post)
        runner.start()
        started.append(runner)
        return runner

    yield start
    for runner in started:
        runner.stop()
        runner.join(PATIENCE)
        assert not runner.is_alive()


def student(token="a"):
    return Session.fresh(token, catalogue()["planar_2r"])


OPEN = frozenset({"made_up"})


def test_the_runner_is_idle_when_all_that_is_wanted_is_handed_in(running, desk):
    go_on = threading.Event()

    def pieces(value):
        yield value, 1
        go_on.wait(PATIENCE)
        yield value, 2

    runner, session = running(pieces), student()
    assert runner.idle
    runner.follow(session, OPEN)
    assert not runner.idle
    desk.until(lambda: desk.found)
    assert not runner.idle
    go_on.set()
    patience = Patience()
    while not runner.idle:
        assert patience.left(), "the runner never comes to rest"
        time.sleep(0.002)
    assert [found for _, found in desk.found] == [(0.698, 1), (0.698, 2)]


def test_pieces_come_one_after_the_other_and_the_work_is_done_once(running, desk):
    runner, session = running(lambda value: iter([(value, 1), None, (value, 2)])), student()
    value = round(float(session.state[Joints].q[0]), 3)
    runner.follow(session, OPEN)
    desk.until(lambda: len(desk.found) == 2)
    for _ in range(5):
        runner.follow(session, OPEN)
    time.sleep(0.05)
    assert desk.found == [(value, (value, 1)), (value, (value, 2))]


def test_nothing_is_done_while_nobody_looks(running, desk):
    runner, session = running(lambda value: iter([value])), student()
    runner.follow(session, frozenset())
    time.sleep(0.05)
    assert desk.found == []


def endless(value):
    while True:
        time.sleep(0.001)
        yield value


def no_more_of(value, runner, desk):
    """Expect no more of a work that was cancelled while that of another goes on: one thread does both in turn."""
    other = student("other")
    other.apply(MoveJoint(0, 0.25), 0.0)
    runner.follow(other, OPEN)
    desk.until(lambda: desk.found[-1] == (0.25, 0.25))
    count = desk.found.count((value, value))
    desk.until(lambda: desk.found.count((0.25, 0.25)) > 20)
    assert desk.found.count((value, value)) == count


def test_other_inputs_begin_anew_and_closing_cancels(running, desk):
    runner, session = running(endless), student()
    runner.follow(session, OPEN)
    desk.until(lambda: len(desk.found) > 2)
    session.apply(MoveJoint(0, 0.123), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.found[-1] == (0.123, 0.123))
    runner.follow(session, frozenset())
    no_more_of(0.123, runner, desk)


def test_a_student_who_has_gone_is_forgotten(running, desk):
    runner, session = running(endless), student()
    runner.follow(session, OPEN)
    desk.until(lambda: len(desk.found) > 2)
    runner.forget(session)
    no_more_of(desk.found[0][0], runner, desk)


def test_a_short_work_does_not_wait_for_the_long_one_of_another(running, desk):
    runner, busy, other = running(endless), student("a"), student("b")
    runner.follow(busy, OPEN)
    desk.until(lambda: len(desk.found) > 5)
    other.apply(MoveJoint(0, 0.5), 0.0)
    runner.follow(other, OPEN)
    before = len(desk.found)
    desk.until(lambda: any(inputs == 0.5 for inputs, _ in desk.found))
    first = next(k for k, (inputs, _) in enumerate(desk.found) if inputs == 0.5)
    assert first - before < 5


def test_the_interval_between_two_pieces_is_kept(running, desk):
    runner, session = running(lambda value: iter(range(3)), interval=0.05), student()
    began = time.monotonic()
    runner.follow(session, OPEN)
    desk.until(lambda: len(desk.found) == 3)
    assert time.monotonic() - began >= 0.1


def test_work_that_fails_is_said_and_the_rest_lives_on(running, desk):
    def run(value):
        if value == 0.5:
            raise RuntimeError("made up")
        yield value

    runner, session = running(run), student()
    session.apply(MoveJoint(0, 0.5), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.told)
    assert desk.told[0] == "The made-up work has failed inside the lab. The rest of the lab still works."
    session.apply(MoveJoint(0, 0.25), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.found)
    assert desk.found == [(0.25, 0.25)]


def test_work_that_cannot_even_begin_is_said_and_the_thread_lives_on(running, desk):
    def run(value):
        if value == 0.5:
            raise RuntimeError("made up")
        return iter([value])

    runner, session = running(run), student()
    session.apply(MoveJoint(0, 0.5), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.told)
    session.apply(MoveJoint(0, 0.25), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.found == [(0.25, 0.25)])


def test_a_job_that_cannot_tell_what_it_wants_harms_nobody(running, desk, caplog):
    def wanted(state, panels):
        value = round(float(state[Joints].q[0]), 3)
        if value == 0.5:
            raise RuntimeError("made up")
        return Wanted(value, value)

    runner, session = running(lambda value: iter([value]), wanted), student()
    session.apply(MoveJoint(0, 0.5), 0.0)
    runner.follow(session, OPEN)
    assert "cannot tell what it wants" in caplog.text
    session.apply(MoveJoint(0, 0.25), 0.0)
    runner.follow(session, OPEN)
    desk.until(lambda: desk.found == [(0.25, 0.25)])


def test_what_is_delivered_is_no_step_of_undo(running, desk):
    runner, session = running(lambda value: iter([value])), student()
    runner.follow(session, OPEN)
    desk.until(lambda: desk.found)
    assert session.history.undo_label is None
