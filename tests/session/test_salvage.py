"""Saved work of which a part cannot be read: all others are as they were, and the student is told once."""

import copy
import json
from itertools import islice
from types import SimpleNamespace

import pytest

from armlab.benches.motion.plan.state import Plan
from armlab.benches.motion.space_curve.state import SpaceCurve
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import Target
from armlab.session.salvage import NEEDED, salvaged, told
from armlab.session.session import RefuseLink, Undo
from armlab.session.share import state_of_parts
from armlab.session.state import State, apply, part_types
from armlab.session.store import Store
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.former import Former
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import BackToLesson, Shelf, ToSandbox
from armlab.window.notices import Notices
from support.sources import TOP

PUMA = catalogue()["puma560"]
GOLDEN = json.loads((TOP / "tests/data/golden.json").read_text(encoding="utf-8"))["parts"]
RUBBISH = ("rubbish", [["a"]] * 3, -7.5, [0.5] * 100_000)
FORGIVING = ("language", "welcome")
"""Keys of the parts that read anything: what they do not know is left out."""

KINDS = [kind for kind in part_types() if kind.saved and kind not in NEEDED and kind.key not in FORGIVING]


def saved(*commands, robot=PUMA):
    """Return the parts of a state as a file holds them."""
    state = State.initial(robot)
    for command in commands:
        state = apply(state, command)
    return written(state)


def written(state):
    """Return a state as a file holds it."""
    return json.loads(json.dumps(state.to_json(), allow_nan=False))


def places(data, path=()):
    """Yield where something stands in JSON, with what stands there."""
    pairs = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in pairs:
        yield (*path, key), value
        yield from places(value, (*path, key))


def damaged(data):
    """Yield JSON of a part in which something is missing, not a number, or of another type."""
    for path, value in places(data):
        for wrong in ([float("nan")] if isinstance(value, float) else []) + [{"a": [None]}]:
            changed = copy.deepcopy(data)
            *way, last = path
            inside = changed
            for key in way:
                inside = inside[key]
            inside[last] = wrong
            yield changed
        if len(path) == 1 and isinstance(data, dict):
            yield {key: each for key, each in data.items() if key != path[0]}


def assert_others_are_as_they_were(parts, wrong):
    """Read work with this in place of parts; return those that begin anew."""
    state, lost = salvaged(parts | {kind.key: data for kind, data in wrong.items()})
    again = written(state)
    others = [kind.key for kind in part_types() if kind.saved and kind not in wrong]
    assert {key: again[key] for key in others} == {key: parts[key] for key in others}
    assert set(lost) <= set(wrong)
    fresh = written(State.initial(state[RobotPart].robot))
    for kind, why in lost.items():
        assert again[kind.key] == fresh[kind.key]
        assert "\n" not in why
    assert written(state_of_parts(again)) == again
    return lost


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.key)
def test_a_part_that_is_rubbish_begins_anew_and_all_others_are_as_they_were(kind):
    parts = saved(MoveJoint(0, 0.3))
    lost = [assert_others_are_as_they_were(parts, {kind: rubbish}) for rubbish in RUBBISH]
    assert all(lost[:2])
    assert kind.key == "selection" or told([kind]), "a person is told of it by a name"


@pytest.mark.parametrize("of", [0, 1])
def test_parts_in_which_something_is_wrong_keep_nobody_from_the_others(of):
    """Of every second part something else is missing or wrong each time."""
    parts = saved(MoveJoint(0, 0.3))
    wrong = {kind: [*islice(damaged(GOLDEN[kind.key]["puma560"][0]), 20)] for kind in KINDS[of::2]}
    lost = [
        assert_others_are_as_they_were(parts, {kind: each[k % len(each)] for kind, each in wrong.items() if each})
        for k in range(20)
    ]
    assert all(lost)


def test_a_part_that_would_read_anything_begins_anew_where_it_is_no_number(monkeypatch):
    parts, fresh = saved(), SpaceCurve.initial(PUMA)
    monkeypatch.setattr(SpaceCurve, "from_json", lambda data, robot: fresh)
    _, lost = salvaged(parts | {"space_curve": {"speed": float("nan")}})
    assert list(lost) == [SpaceCurve]
    assert "space_curve: expected finite numbers" in lost[SpaceCurve]


def test_a_part_that_could_not_be_saved_again_begins_anew(monkeypatch):
    parts, write = saved(), SpaceCurve.to_json

    def written_once(part):
        monkeypatch.setattr(SpaceCurve, "to_json", write)
        raise ValueError("cannot be written")

    monkeypatch.setattr(SpaceCurve, "to_json", written_once)
    _, lost = salvaged(parts)
    assert list(lost) == [SpaceCurve]
    assert "cannot be written" in lost[SpaceCurve]


@pytest.mark.parametrize("kind", NEEDED, ids=lambda kind: kind.key)
def test_without_the_arm_and_its_joints_nothing_is_read(kind):
    for rubbish in RUBBISH:
        with pytest.raises((InputError, TypeError, ValueError, KeyError)):
            salvaged(saved() | {kind.key: rubbish})


def test_of_work_that_waits_elsewhere_only_what_is_wrong_begins_anew():
    parts = saved(MoveJoint(0, 0.3), OpenLesson("first_arm"), ToSandbox(), ChooseRobot("scara"))
    parts["shelf"]["parked"]["home"]["parts"]["space_curve"] = "rubbish"
    parts["former"] = None
    state, lost = salvaged(parts)
    assert list(lost) == [SpaceCurve]
    assert apply(state, BackToLesson())[LessonPart].open == "first_arm/0"
    parts["shelf"]["parked"]["home"]["parts"]["joints"] = None
    state, lost = salvaged(parts)
    assert list(lost) == [Shelf]
    assert state[RobotPart].robot.key == "scara"
    assert state[Shelf].place == "home"


def test_the_arm_before_a_lesson_is_there_without_the_part_that_cannot_be_read():
    parts = saved(ChooseRobot("scara"), MoveJoint(0, 0.3), OpenLesson("first_arm"))
    parts["former"]["target"] = {"method": "gone"}
    state, lost = salvaged(parts)
    assert list(lost) == [Target]
    assert state[Former].state[RobotPart].robot.key == "scara"


def damaged_file(folder, **parts):
    """Save the work of a student, and write something else in place of parts of it; return the file."""
    store = Store(folder, PUMA)
    store.get("a student").apply(MoveJoint(0, 0.25), 0.0)
    assert store.save() == 1
    (file,) = folder.glob("*.json")
    data = json.loads(file.read_text())
    data["parts"] |= parts
    file.write_text(json.dumps(data))
    return file


def test_a_student_is_told_once_which_page_begins_anew_and_the_file_is_kept(tmp_path, caplog):
    file = damaged_file(tmp_path, space_curve={"example": 7}, plan=[float("nan")])
    before = file.read_bytes()
    store = Store(tmp_path, PUMA)
    session = store.get("a student")
    assert session.state[Joints].q[0] == 0.25
    assert "begins anew: Motion › Plan · Motion › Path geometry. Everything else is as it was." in session.notice.text
    assert session.notice.heading
    assert [record.levelname for record in caplog.records] == ["WARNING"] * 2
    assert "'space_curve'" in caplog.text
    assert "Traceback" not in caplog.text
    assert [store.save() for _ in range(2)] == [1, 0], "without a hand: it is told once"
    (kept,) = tmp_path.glob("*.kept")
    assert kept.read_bytes() == before
    session.apply(MoveJoint(0, 0.5), 3.0)
    assert store.save() == 1
    assert kept.read_bytes() == before
    assert len(list(tmp_path.iterdir())) == 2
    assert Store(tmp_path, PUMA).get("a student").notice is None


def test_a_link_that_is_refused_before_there_is_a_page_takes_nothing_from_what_is_told(tmp_path):
    damaged_file(tmp_path, plan=["rubbish"])
    session, said = Store(tmp_path, PUMA).get("a student"), []
    for text in ("There is no arm 'pumma'.", "There is no page 'joynts'."):
        session.apply(RefuseLink(text), 1.0)
    client = SimpleNamespace(add_notification=lambda title, text, **_: said.append((title, text)))
    notices = Notices(client, session)
    for _ in range(2):
        notices.not_done()
    assert [title for title, _ in said] == ["Not restored", "Not found"]
    assert [text for _, text in said] == [told([Plan]), "There is no page 'joynts'."]
    session.apply(RefuseLink("There is no arm 'pumma'."), 2.0)
    notices.not_done()
    assert len(said) == 3


def test_undo_leads_back_to_what_was_read(tmp_path):
    damaged_file(tmp_path, target={"method": "gone"})
    session = Store(tmp_path, PUMA).get("a student")
    read = session.state.to_json()
    session.apply(Undo(), 1.0)
    assert session.state.to_json() == read
    session.apply(MoveJoint(0, 0.5), 3.0)
    session.apply(Undo(), 6.0)
    assert session.state.to_json() == read
