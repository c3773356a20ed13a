"""Sessions on disk: they come back, and what is damaged keeps nobody out."""

import json
import os
import time
from dataclasses import replace
from pathlib import Path

import pytest

from armlab.benches.workspace.section.job import found_section
from armlab.benches.workspace.section.state import SectionView
from armlab.content.robots import catalogue
from armlab.session import store as module
from armlab.session.edits import SetCell
from armlab.session.parts.joints import Joints, MoveJoint, TakePose
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import DragTarget, Target, target_pose
from armlab.session.session import Session
from armlab.session.state import State
from armlab.session.store import IDLE, MOST_IDLE, OPENING, Store
from armlab.session.weight import weight

PUMA = catalogue()["puma560"]


@pytest.fixture
def session():
    return Session.fresh("token", PUMA)


def test_a_session_comes_back_from_disk(tmp_path):
    store = Store(tmp_path, PUMA)
    session = store.get("a student")
    session.apply(ChooseRobot("scara"), 0.0)
    session.apply(DragTarget(target_pose(session.state), 1), 1.0)
    assert store.save() == 1
    assert store.save() == 0
    again = Store(tmp_path, PUMA).get("a student")
    assert again.state.to_json() == session.state.to_json()
    assert again.state[Target].pose is not None


def test_an_arm_that_was_made_small_comes_back_from_disk(tmp_path):
    planar = catalogue()["planar_3r"]
    store = Store(tmp_path, planar)
    for i, a in enumerate((0.04, 0.025, 0.02)):
        store.get("a student").apply(SetCell(i, "a", a), float(i))
    assert store.save() == 1
    again = Store(tmp_path, planar).get("a student")
    assert again.notice is None
    assert [row.a for row in again.state[RobotPart].robot.arm.rows] == [0.04, 0.025, 0.02]


def test_only_what_has_changed_is_put_into_words_again_and_the_file_is_that_of_the_whole_state(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_TEXT", 700)  # the longest parts are not kept
    store = Store(tmp_path, catalogue()["puma560"])
    session = store.get("a")
    encoded, put = [], json.dumps
    monkeypatch.setattr(json, "dumps", lambda value, *args: encoded.append(value) or put(value, *args))
    counts = []
    for command in (ChooseRobot("scara"), MoveJoint(0, 0.2), MoveJoint(1, -0.1)):
        session.apply(command, 0)
        encoded.clear()
        store.save()
        counts.append(sum(isinstance(value, dict) for value in encoded))
        (path,) = tmp_path.glob("*.json")
        assert path.read_text() == put({"format": 1, "parts": session.state.to_json()})
    assert counts[0] > 50
    assert counts[1] == counts[2] < 12


def test_a_session_in_memory_is_the_same_object():
    store = Store(None, PUMA)
    assert store.get("a") is store.get("a")
    assert store.get("a") is not store.get("b")
    assert store.save() == 0


def test_tokens_do_not_become_file_names(tmp_path):
    store = Store(tmp_path / "sessions", PUMA)
    store.get("../../escape").apply(TakePose("zero"), 0.0)
    store.save()
    assert [path.parent for path in tmp_path.rglob("*.json")] == [tmp_path / "sessions"]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b'{"format": 99, "parts": {}}',
        b'{"format": 1, "parts": {}}',
        b"\xff\xfe",
        b"[" * 100_000,
        b"9" * 5000,
    ],
    ids=lambda data: repr(data[:30]),
)
def test_a_broken_file_gives_a_fresh_session_and_a_notice(tmp_path, data):
    broken_store(tmp_path, data)
    session = Store(tmp_path, PUMA).get("a student")
    assert session.robot is PUMA
    assert "fresh start" in session.notice.text


@pytest.mark.parametrize(
    "change",
    [
        {"robot": "gone"},
        {"joints": {"q": [0.0], "locked": [], "draws": 0}},
        {"joints": {"q": [float("nan")] * 6, "locked": [False] * 6, "draws": 0}},
        {"joints": {"q": [0.0] * 6, "locked": [False] * 6, "draws": float("inf")}},
        {"joints": {"q": [0.0] * 6, "locked": [False] * 6, "draws": -1}},
    ],
)
def test_a_file_of_another_version_gives_a_fresh_session_and_a_notice(tmp_path, change):
    parts = Session.fresh("x", PUMA).state.to_json() | change
    broken_store(tmp_path, json.dumps({"format": 1, "parts": parts}).encode())
    session = Store(tmp_path, PUMA).get("a student")
    assert session.robot is PUMA
    assert "does not fit" in session.notice.text


@pytest.mark.parametrize(
    "data", [b"", b"{", b'{"format": 2, "parts": {}}', b'{"format": 1, "parts": {"robot": "gone"}}']
)
def test_a_file_that_cannot_be_read_is_kept_when_its_student_goes_on(tmp_path, data):
    broken_store(tmp_path, data)
    store = Store(tmp_path, PUMA)
    session = store.get("a student")
    (file,) = tmp_path.iterdir()
    assert file.read_bytes() == data, "not touched before there is something to save"
    session.apply(TakePose("zero"), 0.0)
    assert store.save() == 1
    (kept,) = tmp_path.glob("*.kept")
    assert kept.read_bytes() == data
    assert kept.name.startswith(file.stem)
    assert file.stem[:8] in session.notice.text
    session.apply(TakePose("home"), 0.0)
    assert store.save() == 1
    assert len(list(tmp_path.iterdir())) == 2
    assert Store(tmp_path, PUMA).get("a student").notice is None


def test_a_file_that_could_not_be_opened_once_is_not_written_over(tmp_path, monkeypatch):
    store = Store(tmp_path, PUMA)
    store.get("a student").apply(TakePose("zero"), 0.0)
    store.save()
    (file,) = tmp_path.iterdir()
    before, read = file.read_bytes(), Path.read_text

    def too_many_open(*_, **__):
        raise OSError(24, "Too many open files")

    monkeypatch.setattr(Path, "read_text", too_many_open)
    again = Store(tmp_path, PUMA)
    session = again.get("a student")
    monkeypatch.setattr(Path, "read_text", read)
    session.apply(MoveJoint(0, 0.25), 0.0)
    assert again.save() == 1
    (kept,) = tmp_path.glob("*.kept")
    assert kept.read_bytes() == before


def broken_store(folder, data):
    store = Store(folder, PUMA)
    store.get("a student").apply(TakePose("zero"), 0.0)
    store.save()
    next(folder.glob("*.json")).write_bytes(data)


class Broken(Joints):
    """A part that cannot be written down."""

    def to_json(self):
        raise RuntimeError("the part is broken")


def test_a_session_that_cannot_be_saved_holds_up_no_other_and_is_logged_once(tmp_path, caplog):
    store = Store(tmp_path, PUMA)
    bad, good = store.get("bad"), store.get("good")
    bad.state = State([Broken.initial(PUMA)])
    good.apply(TakePose("zero"), 0.0)
    assert store.save() == 1
    assert Store(tmp_path, PUMA).get("good").state[Joints].q.tolist() == [0.0] * 6
    assert store.save() == 0
    assert caplog.text.count("RuntimeError: the part is broken") == 1
    assert "Traceback" in caplog.text
    bad.state = good.state
    assert store.save() == 1


def test_a_writing_that_fails_leaves_no_file(tmp_path, monkeypatch):
    store = Store(tmp_path, PUMA)
    store.get("a student").apply(MoveJoint(0, 0.25), 0.0)
    FullDisk(monkeypatch)
    assert store.save() == 0
    assert list(tmp_path.iterdir()) == []


def crowd(store, count):
    """Visits of so many students, each of whom moves a joint."""
    for k in range(count):
        store.get(f"student {k}").apply(MoveJoint(0, 0.001 * (k + 1)), 0.0)


def test_sessions_nobody_watches_are_let_go_of_and_come_back_from_their_files(tmp_path):
    store = Store(tmp_path, PUMA)
    crowd(store, MOST_IDLE + 20)
    watched, first = {"student 3"}, store.get("student 0")
    later = time.monotonic() + 2.0 * IDLE
    store.let_go(watched, later)
    assert store.get("student 1").history.past, "what is not saved is held"
    store.save()
    store.let_go(watched, time.monotonic())
    assert store.get("student 2").history.past, "who was here just now is held"
    store.let_go(watched, later)
    assert store.get("student 0") is first, "who came last goes last"
    assert store.get("student 3").history.past, "a session with a page is held"
    back = store.get("student 5")
    assert not back.history.past
    assert back.state[Joints].q[0] == pytest.approx(0.006)


def test_what_was_found_for_students_without_a_page_is_bounded_together(tmp_path, monkeypatch):
    store, found = Store(tmp_path, PUMA), found_section(State.initial(catalogue()["planar_2r"]))
    for k in range(4):
        store.get(f"student {k}").state = found.replace(replace(found[SectionView], turn=0.1 * k))
    each = weight(store.get("student 3").state)
    assert each > 100_000
    monkeypatch.setattr(module, "MOST_UNSEEN", int(2.5 * each))
    later = time.monotonic() + 2.0 * OPENING
    store.let_go((), later)
    assert len(store._live) == 4, "what is not saved is held"
    store.save()
    store.let_go((), time.monotonic())
    assert len(store._live) == 4, "whose page may still be built is held"
    store.let_go({"student 0"}, later)
    assert sorted(store._live) == ["student 0", "student 2", "student 3"], "those with a page, and who came last"
    assert store.get("student 1").state[SectionView].turn == pytest.approx(0.1), "and they come back"


def test_without_a_folder_only_so_many_idle_sessions_are_held():
    store = Store(None, PUMA)
    crowd(store, MOST_IDLE + 5)
    store.let_go((), time.monotonic() + 2.0 * IDLE)
    assert len(store._live) == MOST_IDLE


def test_without_a_folder_what_was_found_is_held_as_long_as_anything_since_it_does_not_come_back(monkeypatch):
    monkeypatch.setattr(module, "MOST_UNSEEN", 0)
    store = Store(None, PUMA)
    crowd(store, 2)
    store.let_go((), time.monotonic() + 2.0 * OPENING)
    assert len(store._live) == 2
    store.let_go((), time.monotonic() + 2.0 * IDLE)
    assert not store._live


def test_steps_of_undo_of_all_students_together_are_bounded(monkeypatch):
    monkeypatch.setattr(module, "MOST_HELD", 2_000_000)
    store = Store(None, PUMA)
    for k in range(60):
        store.get("many").apply(SetCell(1, "a", 0.43 + 0.001 * k), 3.0 * k)
    store.get("few").apply(MoveJoint(0, 0.1), 0.0)
    store.let_go((), time.monotonic())
    many = store.get("many").history
    assert 0 < len(many.past) < 60
    assert many.held <= 2_000_000
    assert len(store.get("few").history.past) == 1


def test_what_a_killed_lab_was_writing_is_cleared_up(tmp_path):
    (tmp_path / ".writing-abc").write_text("{")
    Store(tmp_path, PUMA)
    assert list(tmp_path.iterdir()) == []


def test_of_too_many_files_the_oldest_go_whatever_the_clock_says(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_FILES", 3)
    for k in range(5):
        path = tmp_path / f"{k}.json"
        path.write_text("{}")
        os.utime(path, (k * 1e9, k * 1e9))  # years apart, one of them far in the future
    Store(tmp_path, PUMA)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["2.json", "3.json", "4.json"]


@pytest.mark.parametrize("jump", [-1e9, 1e9], ids=["back", "on"])
def test_a_clock_that_is_set_loses_nothing(tmp_path, monkeypatch, jump):
    store = Store(tmp_path, PUMA)
    store.get("a student").apply(MoveJoint(0, 0.25), 0.0)
    store.save()
    now = time.time
    monkeypatch.setattr(time, "time", lambda: now() + jump)
    session = store.get("a student")
    session.apply(MoveJoint(0, 0.5), 3.0)
    assert store.save() == 1
    store.let_go((), time.monotonic())
    assert store.get("a student") is session
    assert Store(tmp_path, PUMA).get("a student").state[Joints].q[0] == 0.5


class FullDisk:
    """A disk on which nothing can be written for a while."""

    def __init__(self, monkeypatch):
        self.full, replace = True, os.replace

        def guarded(*paths):
            if self.full:
                raise OSError(28, "No space left on device")
            replace(*paths)

        monkeypatch.setattr(os, "replace", guarded)


def test_a_full_disk_loses_nothing_and_is_made_good_for_when_there_is_room(tmp_path, monkeypatch, caplog):
    store = Store(tmp_path, PUMA)
    store.get("a student").apply(MoveJoint(0, 0.25), 0.0)
    store.save()
    disk = FullDisk(monkeypatch)
    store.get("a student").apply(MoveJoint(0, 0.5), 3.0)
    assert [store.save() for _ in range(3)] == [0, 0, 0]
    assert len(caplog.records) == 1
    assert Store(tmp_path, PUMA).get("a student").state[Joints].q[0] == 0.25
    disk.full = False
    assert store.save() == 1
    assert Store(tmp_path, PUMA).get("a student").state[Joints].q[0] == 0.5
