"""The work of a class, looked at together: who has another's work, and who another's variant."""

import csv
import io
import json

import numpy as np
import pytest

from armlab.content.lessons import changed
from armlab.content.robots import catalogue
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import HandIn, OpenAssignment, OpenTask, TakeUp
from armlab.teaching.hand_in import hand_in, judge
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.hand_in_class import by_list, looked_at_together
from armlab.teaching.hand_in_reports import Judged, gradescope, rows, table
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs
from armlab.teaching.parts.lesson import LessonPart
from support.assigned import NOON, exam, folder_fixture, solved
from support.assigned import done as assigned
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")


folder = pytest.fixture(folder_fixture, name="folder")


@pytest.fixture
def fresh():
    return State.initial(catalogue()["puma560"])


def timed(state, *commands, at=0.0):
    for command in commands:
        state, at = apply(state, command, at), at + 1.37
    return state


def student_work(fresh, name, at, variant=3):
    """Return the file of a student who does everything in the same way, at a time of its own."""
    state = timed(fresh, SignAs(name), OpenLesson("v", variant=variant), at=at)
    goal = state[LessonPart].lesson.values["goal"]
    state = apply(state, MoveJoint(0, np.radians(goal)), 2.0 * at)
    state = timed(state, GoToStep(1), Answer(f"{goal:g}"), GoToStep(2), at=3.0 * at)
    return hand_in(apply(state, Answer(state[LessonPart].step.question.right_answer), 5.0 * at))


def test_work_that_agrees_to_the_last_digit_is_marked_with_both(fresh, own):
    ada, bob, eve = (student_work(fresh, name, at) for name, at in (("Ada", 7.31), ("Bob", 9.17), ("Eve", 7.31)))
    data = json.loads(eve)
    del data["progress"]["evidence"]["Turn"]  # something of the copy is different
    files = [Judged(name, judge(text)) for name, text in (("a", ada), ("b", bob), ("e", json.dumps(data)))]
    marked = looked_at_together(files)
    assert [one.same_as for one in marked] == [("e",), (), ("a",)]
    assert "Agrees to the last digit with e." in table(marked).splitlines()[1]
    assert gradescope(marked[0])["output"].endswith("Agrees to the last digit with e.")


def test_work_of_nothing_is_not_marked(fresh, own):
    files = [Judged(name, judge(hand_in(timed(fresh, SignAs(name), OpenLesson("v", variant=3))))) for name in "ab"]
    assert [one.same_as for one in looked_at_together(files)] == [(), ()]


def test_two_students_of_one_name_are_told_apart_by_their_variants(fresh, folder):
    anna, other = (solved(exam(fresh, number, "Anna Rossi")) for number in (3, 4))
    anna = assigned(assigned(anna, OpenTask(1), GoToStep(2)), Answer("3"), at=NOON + 3.7)
    again = assigned(assigned(anna, HandIn()), TakeUp(), HandIn(), at=NOON + 60)
    copied = json.loads(hand_in(assigned(other, HandIn())))
    copied["works"][1]["progress"] = json.loads(hand_in(again))["works"][1]["progress"]
    texts = hand_in(assigned(anna, HandIn())), hand_in(again), json.dumps(copied)
    files = [Judged(name, judge_assignment(text, "exam")) for name, text in zip("abc", texts, strict=True)]
    names = {3: "Anna Rossi", 4: "anna rossi", 5: "Bob"}
    marked = looked_at_together(files, names)
    assert [one.problem for one in marked] == ["Another attempt counts: b.", "", ""]
    assert [one.points for one in marked] == [0.0, 8.5, 8.5]
    assert [one.same_as for one in marked] == [("c",), ("c",), ("a", "b")]


def test_the_table_has_one_row_for_each_name_of_the_list_in_its_order_and_the_others_behind(fresh, folder):
    anna, twin, stranger = (exam(fresh, number, name) for number, name in ((3, "Anna"), (6, "anna"), (5, "Zoe")))
    again = assigned(assigned(anna, HandIn()), TakeUp(), HandIn(), at=NOON + 60)
    works = {"z": stranger, "t": twin, "a1": anna}
    texts = {**{key: hand_in(assigned(state, HandIn())) for key, state in works.items()}, "a2": hand_in(again)}
    names = {2: "Carla", 3: "Anna", 4: "Dario", 6: "Anna"}
    files = [Judged(key, judge_assignment(text, "exam")) for key, text in texts.items()]
    listed = by_list(looked_at_together([*files, Judged("x", None, "it is not JSON")], names), names)
    assert [one.file for one in listed] == ["", "a2", "", "t", "z", "a1", "x"]
    lines = [line.split() for line in table(listed).splitlines()[1:]]
    assert lines[0] == ["Carla", "Nothing", "handed", "in."]
    assert [line[0] for line in lines] == ["Carla", "Anna", "Dario", "anna", "Zoe", "Anna"]
    read = list(csv.DictReader(io.StringIO(rows(listed))))
    assert [row["student"] for row in read] == ["Carla", "Anna", "Dario", "anna", "Zoe", "Anna", ""]
    assert [row["problem"] for row in read][:4] == ["Nothing handed in.", "", "Nothing handed in.", ""]
    nobody = by_list([], {1: "=Carla"})
    assert table(nobody).splitlines()[1].split() == ["=Carla", "Nothing", "handed", "in."]


def test_two_students_of_one_name_have_a_row_each_also_where_the_lesson_does_not_vary(fresh, own):
    one, other = (hand_in(timed(fresh, SignAs("Anna"), OpenLesson("t"), at=at)) for at in (5.0, 9.0))
    names = {3: "Anna", 4: "Dario", 6: "anna"}
    judged = looked_at_together([Judged(file, judge(text)) for file, text in (("a", one), ("b", other))], names)
    assert [each.file for each in by_list(judged, names)] == ["a", "", "b"]
    assert [each.file for each in by_list(judged[:1], names)] == ["a", "", ""]
    assert [each.file for each in by_list(judged, {1: "Anna"})] == ["a", "b"]


def test_of_two_students_of_one_name_each_has_the_file_of_the_number_given(fresh, folder):
    (folder / "plain.toml").write_text('title = "Plain"\n[[tasks]]\nlesson = "t"\npoints = 1\n')
    changed()
    texts = [hand_in(assigned(fresh, SignAs("Anna"), OpenAssignment("plain", k), HandIn())) for k in (6, 3)]
    files = [Judged(file, judge_assignment(text, "plain")) for file, text in zip("ab", texts, strict=True)]
    names = {3: "Anna", 6: "anna"}
    assert [each.file for each in by_list(looked_at_together(files, names), names)] == ["b", "a"]


def test_work_in_the_variant_of_another_does_not_count(fresh, own):
    names = {3: "Ada  Lovelace", 4: "Bob", 5: "Rene\u0301"}
    files = [
        Judged(str(k), judge(student_work(fresh, name, 5.0 + k, variant)))
        for k, (name, variant) in enumerate((("ada lovelace", 3), ("Bob", 3), ("Mallory", 4), ("", 3), ("René", 5)))
    ]
    marked = looked_at_together(files, names)
    assert [one.problem for one in marked] == [
        "",
        "This is variant 3; the one given was 4.",
        "There is nobody of this name in the list.",
        "The work is not signed.",
        "",
    ]
    assert [one.passed for one in marked] == [3, 0, 0, 0, 3]
    assert [gradescope(one)["score"] for one in marked] == [3.0, 0.0, 0.0, 0.0, 3.0]
    assert [row["score"] for row in csv.DictReader(io.StringIO(rows(marked)))] == ["100", "0", "0", "0", "100"]
