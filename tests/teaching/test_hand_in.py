"""Saved work and the verdicts on it: what a forged file says is not believed."""

import copy
import csv
import io
import json

import numpy as np
import pytest

from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, ContentError, InputError, UnknownName
from armlab.session.edits import SetCell
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State
from armlab.teaching.hand_in import FORMAT, MOST, hand_in, hand_in_name, judge
from armlab.teaching.hand_in_reports import COLUMNS, Judged, gradescope, rows, table
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs, UnlockHint
from armlab.teaching.lesson_places import at_place
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.plain_text import plain, printable
from armlab.teaching.play import Player
from support.done import done
from support.small_lessons import TWO_STEPS, VARIED, library_fixture

own = pytest.fixture(library_fixture, name="own")

TABLE = """+++
title = "Table"
chapter = "1"
teaches = ["S4.1-dh"]
robot = "planar_2r"
+++
## Make it longer
```check
kind = "table_is"
rows = [{ type = "R", a = 1.5 }, { type = "R", a = 1 }]
```
"""


@pytest.fixture
def fresh():
    return State.initial(catalogue()["puma560"])


@pytest.fixture
def solved(fresh, own):
    """Variant 3 of the lesson, all done but the last answer."""
    state = done(fresh, SignAs("Ada Lovelace"), OpenLesson("v", variant=3), UnlockHint())
    goal = state[LessonPart].lesson.values["goal"]
    return done(state, MoveJoint(0, np.radians(goal)), GoToStep(1), Answer(f"{goal:g}"), GoToStep(2), Answer("1"))


def changed(state, **fields):
    return json.dumps({**json.loads(hand_in(state)), **fields})


def marks(report):
    return [(step.met, step.right, step.passed) for step in report.steps]


# --- The file


def test_before_a_prediction_the_file_does_not_tell_what_is_predicted(fresh, own):
    state = done(fresh, OpenLesson("v", variant=3), GoToStep(1))
    assert state[LessonPart].hides
    assert json.loads(hand_in(state))["parts"] == {}
    assert "joints" in json.loads(hand_in(done(state, Answer("1"))))["parts"]


def test_roots_and_powers_are_not_lost_in_plain_text():
    question = lesson("axis_angle_quaternion").steps[2].question
    assert plain(question.judge("-1; 1; 1").says).endswith("divide by √3.")
    assert "√(90^2+90^2)" in plain(lesson("axis_angle_quaternion").steps[0].question.judge("3").says)


def test_work_gets_the_verdicts_of_the_screen(solved):
    report = judge(hand_in(solved), "v")
    assert (report.student, report.lesson, report.variant, report.changed) == ("Ada Lovelace", "v", 3, False)
    assert report.title == lesson("v", 3).title
    assert marks(report) == [(True, None, True), (None, False, True), (None, False, False)]
    assert [step.hints for step in report.steps] == [1, 0, 0]
    assert (report.passed, report.count) == (2, 3)
    assert "This is all of it." in report.steps[1].says
    part = solved[LessonPart]
    assert part.progress.passed(part.lesson) == {i for i, step in enumerate(report.steps) if step.passed}


@pytest.mark.parametrize("last", ["11", "x", ""])
def test_an_answer_that_was_right_once_counts_on_screen_and_in_the_file(fresh, own, last):
    state = done(fresh, OpenLesson("v", variant=3), GoToStep(2))
    right = state[LessonPart].step.question.right_answer
    state = done(state, Answer(right), Answer(last))
    part, report = state[LessonPart], judge(hand_in(state))
    assert 2 in part.progress.passed(part.lesson)
    assert report.steps[2].passed
    assert repr(right) in report.steps[2].says
    assert repr(last) in report.steps[2].says or not last


def test_screen_and_file_agree_after_any_answers(fresh, own, rng):
    state = done(fresh, OpenLesson("t"))
    words = ["2", "3", "11", "x", "", "2,0", "1e400", "3/1"]
    for _ in range(200):
        command = GoToStep(int(rng.integers(3))) if rng.random() < 0.4 else Answer(words[rng.integers(len(words))])
        try:
            state = done(state, command)
        except InputError:  # there is no question in the first step
            continue
        part, report = state[LessonPart], judge(hand_in(state))
        screen = {i for i in part.progress.passed(part.lesson) if report.steps[i].counts}
        assert screen == {i for i, step in enumerate(report.steps) if step.counts and step.passed}


def test_a_right_answer_that_the_file_only_claims_is_judged_again(solved):
    data = json.loads(hand_in(solved))
    data["progress"]["right"]["Double"] = ["1", 3.0]
    assert not judge(json.dumps(data)).steps[2].passed


def test_what_cannot_be_read_is_no_prediction(solved):
    data = json.loads(hand_in(solved))
    data["progress"]["answers"]["Predict"] = "?!"
    assert not judge(json.dumps(data)).steps[1].passed


def test_a_player_of_the_solutions_passes_everything(own):
    player = Player(lesson("v", 12))
    for i, step in enumerate(player.lesson.steps):
        player.do(GoToStep(i))
        for action in step.solution:
            assert player.act(action) == ""
        if step.question is not None:
            player.do(Answer(step.question.right_answer))
    report = judge(hand_in(player.session.state))
    assert (report.variant, report.passed, report.count) == (12, 3, 3)


def test_steps_with_nothing_to_do_do_not_count(fresh, own):
    report = judge(hand_in(done(fresh, OpenLesson("t"))))
    assert [step.counts for step in report.steps] == [False, True, True]
    assert (report.passed, report.count) == (0, 2)
    assert report.steps[1].says == "Not done. Not answered."


def test_without_a_lesson_there_is_nothing_to_hand_in(fresh):
    with pytest.raises(InputError, match="no lesson is open"):
        hand_in(fresh)


@pytest.mark.parametrize(
    ("student", "name"),
    [("Ada Lovelace", "v_3_ada_lovelace.json"), ("../../Ä é/x", "v_3_x.json"), ("", "v_3.json"), ("王", "v_3.json")],
)
def test_the_file_has_a_plain_name(solved, student, name):
    assert hand_in_name(done(solved, SignAs(student))) == name


def test_work_on_a_table_is_judged_by_the_table(fresh, own):
    own(table=TABLE)
    state = done(fresh, OpenLesson("table"), SetCell(0, "a", 1.5))
    assert judge(hand_in(state)).passed == 1
    assert judge(hand_in(done(fresh, OpenLesson("table")))).passed == 0


# --- What is not believed


def test_what_the_file_says_is_done_is_judged_again(solved):
    data = json.loads(hand_in(solved))
    data["progress"] |= {"met": ["Turn", "Predict", "Double"], "right": ["Predict", "Double"], "evidence": {}}
    report = judge(json.dumps(data))
    assert marks(report) == [(False, None, False), (None, False, True), (None, False, False)]
    assert report.steps[0].says == "Not done."


def test_evidence_that_does_not_meet_the_check_is_told_why(solved):
    data = json.loads(hand_in(solved))
    goal = lesson("v", 3).values["goal"]
    data["progress"]["evidence"]["Turn"]["q"] = [np.radians(-goal), 0.3]
    report = judge(json.dumps(data))
    assert not report.steps[0].passed
    assert report.steps[0].says == "The other way round."


def test_evidence_of_another_variant_is_not_enough(solved):
    report = judge(changed(solved, variant=4))
    assert report.steps[0].met is False


def test_evidence_with_another_arm_is_refused(solved):
    data = json.loads(hand_in(solved))
    data["progress"]["evidence"]["Turn"]["arm"]["rows"][0][1] = 0.5
    assert judge(json.dumps(data)).steps[0].says == "This was done with another arm."


@pytest.mark.parametrize("evidence", [3, [], {}, {"q": []}, "x", True])
def test_evidence_that_is_none_is_said(solved, evidence):
    data = json.loads(hand_in(solved))
    data["progress"]["evidence"]["Turn"] = evidence
    report = judge(json.dumps(data))
    assert report.steps[0].met is False
    assert "not usable" in report.steps[0].says


def test_limits_are_those_of_the_arm_and_not_of_the_file(solved):
    data = json.loads(hand_in(solved))
    seen = data["progress"]["evidence"]["Turn"]
    seen["q"][1], seen["arm"]["limits"] = 50.0, [[-100.0, 100.0]] * 2
    report = judge(json.dumps(data))
    assert not report.steps[0].passed
    assert "joint 2 is at 2865°, outside its limits of -180° to 180°" in report.steps[0].says


def test_a_prediction_without_an_answer_is_not_passed(solved):
    data = json.loads(hand_in(solved))
    del data["progress"]["answers"]["Predict"]
    assert not judge(json.dumps(data)).steps[1].passed


def test_a_lesson_changed_since_is_said(solved, own):
    text = hand_in(solved)
    own(v=VARIED.replace("One.", "Another one."))
    assert judge(text).changed
    own(v=VARIED.replace("## Turn", "## Turn it"))
    assert [step.passed for step in judge(text).steps] == [False, True, False]


def test_work_on_another_lesson_is_refused(solved):
    with pytest.raises(InputError, match="work on the lesson 'v', not 't'"):
        judge(hand_in(solved), "t")
    with pytest.raises(UnknownName, match="gone"):
        judge(changed(solved, lesson="gone"))


def test_work_on_a_broken_lesson_says_what_is_wrong(solved, own):
    text = changed(solved, lesson="b")
    own(b=TWO_STEPS.replace("robot", "rabot"))
    with pytest.raises(ContentError, match=r"b\.md"):
        judge(text, "b")


@pytest.mark.parametrize(
    "text",
    ["", "x", "[]", "3", "null", "{}", '{"format": 1}', "[" * 100_000, "\x00", '{"format": NaN}', " " * (MOST + 1)],
)
def test_what_is_no_work_is_refused_in_one_line(text):
    with pytest.raises(InputError) as found:
        judge(text)
    assert "\n" not in str(found.value)
    assert len(str(found.value)) < 200


def test_another_format_is_refused(solved):
    with pytest.raises(InputError, match="reads format 1"):
        judge(changed(solved, format=FORMAT + 1))


def places(data, path=()):
    """Yield the way to everything in parsed JSON."""
    yield path
    if isinstance(data, dict | list):
        for key in data if isinstance(data, dict) else range(len(data)):
            yield from places(data[key], (*path, key))


def test_no_damage_raises_anything_else(solved, rng):
    """Every place of a file is replaced by things that do not belong there."""
    original = {**json.loads(hand_in(solved)), "parts": {}}
    wrong = [None, True, -1, 1e400, float("nan"), 10**30, "x", "\ud800\x1b", [], {}, [[]], {"x": 1}, 0.5, "v/3"]
    judged = refused = 0
    for path in places(original):
        if not path:
            continue
        for value in rng.permutation(len(wrong))[:6]:
            data = copy.deepcopy(original)
            inner = data
            for key in path[:-1]:
                inner = inner[key]
            inner[path[-1]] = wrong[value]
            try:
                report = judge(json.dumps(data))
            except ArmlabError:
                refused += 1
            else:
                judged += 1
                texts = [report.student, *(step.says for step in report.steps)]
                assert all(text.isprintable() for text in texts)
    assert judged > 50
    assert refused > 50


def test_names_steer_no_terminal(solved):
    report = judge(changed(solved, student="Ada\x1b[2J\n\ud800 " + "x" * 500))
    assert report.student.startswith("Ada\ufffd[2J \ufffd")
    assert len(report.student) == 80
    assert printable("é王 −") == "é王 −"


def test_plain_text_of_markup():
    assert plain("<p>a &lt; <b>b</b>\n c</p><p> d</p>") == "a < b c d"


# --- Reports


@pytest.fixture
def judged(solved, fresh):
    return [
        Judged("ada.json", judge(hand_in(solved))),
        Judged("eve.json", judge(changed(solved, student="=1+1", digest="0" * 16))),
        Judged("bob.json", None, "it is not JSON"),
        Judged("dir/nobody.json", judge(changed(solved, student=""))),
    ]


def test_the_table_has_a_line_a_student(judged):
    lines = table(judged).splitlines()
    assert lines[0].split() == ["student", "variant", "1", "2", "3", "score"]
    assert lines[1].split() == ["Ada", "Lovelace", "3", "ok", "ok", "no", "2", "of", "3"]
    assert lines[2].endswith("2 of 3  The lesson has changed since.")
    assert lines[3].startswith("dir/nobody.json")
    assert len(lines) == 4
    assert len({line.index("of 3") for line in lines[1:]}) == 1


def test_details_say_what_is_missing(judged):
    text = table(judged[:1], details=True)
    assert "Step 1, Turn: done, 1 hint\n" in text
    assert "Step 3, Double: not done\n    '1': This is not the answer yet.\n" in text


def test_nothing_to_report_is_no_table():
    assert table([Judged("a", None, "x")]) == ""


def test_a_step_without_a_task_has_no_mark(fresh, own):
    one = Judged("a", judge(hand_in(done(fresh, OpenLesson("t")))))
    assert table([one]).splitlines()[1].split() == ["a", "0", "-", "no", "no", "0", "of", "2"]
    assert list(csv.reader(io.StringIO(rows([one]))))[1][len(COLUMNS)] == ""


def test_rows_for_a_spreadsheet(judged):
    head, *body = list(csv.reader(io.StringIO(rows(judged))))
    assert head == [*COLUMNS, *(f"{i} {name}" for i in (1, 2, 3) for name in ("passed", "hints", "says")), "problem"]
    found = [dict(zip(head, row, strict=True)) for row in body]
    ada = {name: found[0][name] for name in COLUMNS}
    assert ada == {
        "file": "ada.json",
        "student": "Ada Lovelace",
        "lesson": "v",
        "variant": "3",
        "changed": "no",
        "passed": "2",
        "count": "3",
        "score": "67",
        "same as": "",
    }
    assert (found[0]["1 passed"], found[0]["1 hints"], found[0]["3 passed"]) == ("yes", "1", "no")
    assert found[1]["changed"] == "yes"
    assert (found[2]["file"], found[2]["student"], found[2]["problem"]) == ("bob.json", "", "it is not JSON")


@pytest.mark.parametrize("name", ["=1+1", "+1", "-1", "@SUM(A1)", "＝1"])
def test_no_cell_is_a_formula(solved, name):
    one = Judged(name, judge(changed(solved, student=name)), name)
    row = list(csv.reader(io.StringIO(rows([one]))))[1]
    assert [row[0], row[1], row[-1]] == [f"'{name}"] * 3


def test_results_for_gradescope(judged):
    found = json.loads(json.dumps(gradescope(judged[0])))
    assert found["score"] == 2.0
    assert found["output_format"] == "text"
    assert [(test["name"], test["score"], test["max_score"], test["status"]) for test in found["tests"]] == [
        ("1 Turn", 1.0, 1.0, "passed"),
        ("2 Predict", 1.0, 1.0, "passed"),
        ("3 Double", 0.0, 1.0, "failed"),
    ]
    assert found["tests"][2]["output"] == "'1': This is not the answer yet."
    assert all(test["output_format"] == "text" for test in found["tests"])
    assert "changed" in gradescope(judged[1])["output"]
    assert gradescope(judged[2]) == {
        "score": 0.0,
        "output": "it is not JSON",
        "output_format": "text",
        "tests": [],
    }


def test_the_lesson_of_a_place_is_the_one_judged(solved):
    assert at_place("v/3") is lesson("v", 3)
