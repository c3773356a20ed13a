"""Sessions on disk: they come back, and what is damaged keeps nobody out."""

import json

import pytest

from armlab.content.robots import catalogue
from armlab.session.parts.joints import Joints, TakePose
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import DragTarget, Target, target_pose
from armlab.session.session import Session
from armlab.session.state import State
from armlab.session.store import Store

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
        {"target": {"pose": [[1]], "axes": "world", "handle": "move", "method": "dls"}},
        {"target": {"pose": None, "axes": "nowhere", "handle": "move", "method": "dls"}},
        {"target": {"pose": None, "axes": "world", "handle": "move", "method": "gone"}},
    ],
)
def test_a_file_of_another_version_gives_a_fresh_session_and_a_notice(tmp_path, change):
    parts = Session.fresh("x", PUMA).state.to_json() | change
    broken_store(tmp_path, json.dumps({"format": 1, "parts": parts}).encode())
    session = Store(tmp_path, PUMA).get("a student")
    assert session.robot is PUMA
    assert "does not fit" in session.notice.text


def broken_store(folder, data):
    store = Store(folder, PUMA)
    store.get("a student").apply(TakePose("zero"), 0.0)
    store.save()
    next(folder.glob("*.json")).write_bytes(data)


class Unwritable(State):
    """A state that cannot be written down."""

    def to_json(self):
        raise RuntimeError("the part is broken")


class HalfWritten(State):
    """A state whose writing fails in the middle of the file."""

    def to_json(self):
        return {"joints": object()}


def test_a_session_that_cannot_be_saved_holds_up_no_other_and_is_logged_once(tmp_path, caplog):
    store = Store(tmp_path, PUMA)
    bad, good = store.get("bad"), store.get("good")
    bad.state = Unwritable({})
    good.apply(TakePose("zero"), 0.0)
    assert store.save() == 1
    assert Store(tmp_path, PUMA).get("good").state[Joints].q.tolist() == [0.0] * 6
    assert store.save() == 0
    assert caplog.text.count("RuntimeError: the part is broken") == 1
    assert "Traceback" in caplog.text
    bad.state = good.state
    assert store.save() == 1


def test_a_writing_that_fails_leaves_no_file(tmp_path):
    store = Store(tmp_path, PUMA)
    store.get("a student").state = HalfWritten({})
    assert store.save() == 0
    assert list(tmp_path.iterdir()) == []
