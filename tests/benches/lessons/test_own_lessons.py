"""Lessons and assignments that one person has loaded: seen as a student sees them, by nobody else, and kept."""

import gc
import json

import pytest

from armlab.benches.lessons.own_commands import ArrangeCourse, ForgetFile, LeaveOut, LoadFile, MoveInCourse
from armlab.content import held
from armlab.content.lessons import changed
from armlab.content.robots import catalogue
from armlab.content.upload import MOST_TEXT, Upload, read_upload
from armlab.content.write_robot import robot_toml
from armlab.errors import ArmlabError
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.language import LanguagePart, ReadIn
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Session, Undo
from armlab.session.share import from_short, short, state_of_parts
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import HandIn, OpenAssignment
from armlab.teaching.hand_in import hand_in
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson, SignAs
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import MOST_FILES, OwnLessons, key_of
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.shelf import BackToLesson, OpenShared, ToSandbox
from armlab.teaching.parts.teacher import LetIn, Teacher
from armlab.teaching.preview_commands import EndPreview, PreviewAssignment, PreviewLesson
from support.assigned import named
from support.small_lessons import TWO_STEPS, VARIED, library_fixture

own = pytest.fixture(library_fixture, name="own")

OPENING = catalogue()["planar_2r"]
HOMEWORK = 'title = "H"\nopens = 2030-01-01\nexam = true\n[[tasks]]\nlesson = "mine"\n[[tasks]]\nlesson = "v"\n'
HIDDEN = TWO_STEPS.replace('chapter = "1"', 'chapter = "1"\nlisted = false')


def load(state, *files):
    for name, text in files:
        state = apply(state, LoadFile(read_upload(f"{name}\n{text}")))
    return state


@pytest.fixture
def loaded(own):
    return load(State.initial(OPENING), ("mine.md", VARIED), ("hw.toml", HOMEWORK))


def key(state, file):
    return key_of(state[OwnLessons].held[file])


def saved(state):
    """Return the state as it comes back from its file."""
    return state_of_parts(json.loads(json.dumps(state.to_json())))


def see(state, file):
    kind = PreviewLesson if file.endswith(".md") else PreviewAssignment
    return apply(state, kind(key(state, file), "author"), 100.0)


def test_a_lesson_is_seen_as_a_student_sees_it_and_one_comes_back(loaded):
    before = apply(apply(loaded, OpenLesson("t")), MoveJoint(0, 0.5))
    seen = see(before, "mine.md")
    part = seen[LessonPart]
    assert (part.lesson.title, part.index, len(part.progress_of)) == ("Turn to 30 degrees", 0, 1)
    assert part.progress.met == frozenset()
    assert part.lesson.values == apply(loaded, OpenLesson("v"))[LessonPart].lesson.values
    later = apply(apply(seen, GoToStep(1)), Answer("15"))
    back = apply(apply(later, CloseLesson()), EndPreview())
    assert back[LessonPart] is before[LessonPart]
    assert back[Joints] is before[Joints]
    assert apply(back, EndPreview()) is back


def test_variants_of_a_loaded_lesson_are_those_it_will_have_in_a_folder(loaded, own):
    seen = apply(see(loaded, "mine.md"), OpenLesson(key(loaded, "mine.md"), variant=7))
    own(mine=VARIED)
    there = apply(State.initial(OPENING), OpenLesson("mine", variant=7))
    assert seen[LessonPart].lesson.values == there[LessonPart].lesson.values


def test_an_assignment_is_seen_whatever_its_dates_and_leaves_no_trace(loaded):
    seen = see(loaded, "hw.toml")
    assert seen[LessonPart].assigned.title == "H"
    assert seen[LessonPart].lesson.title == "Turn to 30 degrees"
    handed = apply(apply(seen, SignAs("Ada")), HandIn(), 101.0)
    assert handed[LessonPart].rests
    told = json.loads(hand_in(handed))
    assert (told["assignment"], [work["lesson"] for work in told["works"]]) == ("hw", ["mine", "v"])
    back = apply(handed, EndPreview())
    assert (back[LessonPart].works, back[LessonPart].student) == ({}, "")


def test_nothing_that_a_preview_would_forget_is_begun_or_opened_in_it(loaded, tmp_path):
    (tmp_path / "mine" / "exam.toml").write_text('title = "E"\n[[tasks]]\nlesson = "v"\n')
    changed()
    work = hand_in(apply(loaded, OpenLesson("t")))
    lesson, assignment = see(loaded, "mine.md"), see(loaded, "hw.toml")
    with pytest.raises(ArmlabError, match="assignment: go back to your own work first"):
        apply(lesson, OpenAssignment("exam"))
    with pytest.raises(ArmlabError, match="saved work: go back to your own work first"):
        apply(lesson, OpenWork(work))
    left = apply(assignment, CloseLesson(), 101.0)
    assert apply(left, OpenAssignment(assignment[LessonPart].assignment), 102.0)[LessonPart].work.begun == 100.0
    back = apply(lesson, EndPreview())
    assert apply(back, OpenAssignment("exam"))[LessonPart].assignment == "exam"
    assert apply(back, OpenWork(work))[LessonPart].open == "t"


def test_it_survives_a_restart_also_in_the_middle(loaded):
    again = saved(see(loaded, "mine.md"))
    assert again[LessonPart].lesson.title == "Turn to 30 degrees"
    assert list(again[OwnLessons].held) == ["mine.md", "hw.toml"]
    assert apply(again, EndPreview())[RobotPart].robot is OPENING
    text = json.dumps(see(loaded, "hw.toml").to_json())
    gc.collect()
    gone = state_of_parts(json.loads(text))  # without the copy that has no dates
    assert (gone[LessonPart].assignment, apply(gone, EndPreview())[LessonPart].open) == ("", "")


def test_nobody_else_sees_it_and_it_goes_with_its_owner(loaded):
    place = key(loaded, "mine.md")
    for other in (State.initial(OPENING), see(load(State.initial(OPENING), ("t.md", TWO_STEPS)), "t.md"), loaded):
        with pytest.raises(ArmlabError, match=f"lesson: unknown name '{place}'. Available: t, v"):
            apply(other, OpenLesson(place))
    with pytest.raises(ArmlabError, match="opened here with the key"):
        apply(State.initial(OPENING), PreviewAssignment(key(loaded, "hw.toml"), "author"))
    shared = short(loaded)
    assert "mine" not in json.dumps(from_short(shared)[OwnLessons].to_json())
    assert apply(loaded, OpenShared(shared))[OwnLessons] is loaded[OwnLessons]
    twice = load(State.initial(OPENING), ("mine.md", VARIED))
    assert key(twice, "mine.md") == place
    del twice
    gc.collect()
    assert see(loaded, "mine.md")[LessonPart].lesson is not None
    lonely = load(State.initial(OPENING), ("lonely.md", TWO_STEPS))
    alone = key(lonely, "lonely.md")
    assert held.held_lesson(alone) is not None
    del lonely
    gc.collect()
    assert held.held_lesson(alone) is None


def test_the_exam_of_the_lab_is_seen_with_the_key_alone(own, tmp_path):
    (tmp_path / "mine" / "exam.toml").write_text('title = "E"\nopens = 2030-01-01\n[[tasks]]\nlesson = "v"\n')
    own(secret=HIDDEN)
    state = State.initial(OPENING)
    with pytest.raises(ArmlabError, match="opened here with the key of the teacher"):
        apply(state, PreviewAssignment("exam", "author"))
    with pytest.raises(ArmlabError, match=r"hw\.toml, line 3: tasks\[1\]\.lesson: unknown lesson 'secret'"):
        load(state, ("hw.toml", 'title = "H"\n[[tasks]]\nlesson = "secret"\n'))
    let_in = apply(state, LetIn())
    seen = apply(let_in, PreviewAssignment("exam", "author"))
    assert seen[LessonPart].assigned.title == "E"
    assert not saved(let_in)[Teacher].let_in
    assert "teacher" not in let_in.to_json()
    work = apply(state, OpenAssignment("exam"), 2e9)
    for command in (LoadFile(read_upload(f"a.md\n{TWO_STEPS}")), ForgetFile("a.md"), PreviewLesson("t", "author")):
        with pytest.raises(ArmlabError, match=f"The assignment {named('E')} is open"):
            apply(work, command)


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("bad.md", "hello", "bad.md, line 1: expected a first line +++"),
        ("mine.md", VARIED.replace("## Turn", "## Turn\n$\\foo$"), "mine.md, line "),
        ("self.md", TWO_STEPS.replace('chapter = "1"', 'chapter = "1"\nafter = ["self"]'), "the lesson needs itself"),
        ("hw.toml", HOMEWORK.replace('"v"', '"w"'), "hw.toml, line 7: tasks[2].lesson: unknown lesson 'w'"),
        (
            "hw.toml",
            HOMEWORK.replace('"mine"\n', '"mine"\n[tasks.points]\n"Predcit" = 2\n'),
            "the lesson 'mine' has no step 'Predcit'; did you mean 'Predict'?",
        ),
        ("hw.toml", f"due = 2029-01-01\n{HOMEWORK}", "hw.toml, line 1: due: expected a moment after opens"),
        ("course.toml", "[[chapters]]\ntitle = 3\n", "course.toml, line 1: title: missing"),
        ("arm.toml", "[[joints]]\ntype = 'R'", "arm.toml, line 1: name: missing"),
    ],
)
def test_what_is_no_lesson_is_a_sentence_with_file_and_line_and_all_stays(loaded, name, text, says):
    with pytest.raises(ArmlabError) as told:
        load(loaded, (name, text))
    assert says in str(told.value)
    assert key(loaded, "mine.md")


def test_files_are_bounded_replaced_and_removed(loaded):
    with pytest.raises(ArmlabError, match=f"expected at most {MOST_FILES} files"):
        load(loaded, *((f"l{i}.md", TWO_STEPS) for i in range(MOST_FILES - 1)))
    big = TWO_STEPS + "x " * ((MOST_TEXT - len(TWO_STEPS)) // 2)
    picture = {"arm.svg": "x" * 200_000}
    heavy = tuple(Upload("lesson", f"b{i}", big, picture) for i in range(3))
    with pytest.raises(ArmlabError, match="expected at most 600000 characters in all files together"):
        loaded[OwnLessons].having(heavy)
    again = load(see(loaded, "mine.md"), ("mine.md", TWO_STEPS))
    assert again[Preview].before is None
    assert [each.file for each in again[OwnLessons].files] == ["mine.md", "hw.toml"]
    less = apply(again, ForgetFile("mine.md"))
    assert list(less[OwnLessons].held) == []
    assert "unknown lesson 'mine'" in str(less[OwnLessons].problems["hw.toml"])
    assert list(load(less, ("mine.md", VARIED))[OwnLessons].held) == ["mine.md", "hw.toml"]


def test_the_sandbox_of_a_preview_and_its_undo_are_its_own(loaded):
    session = Session("x", OPENING, loaded)
    for command in (MoveJoint(0, 0.3), PreviewLesson(key(loaded, "mine.md"), "author"), MoveJoint(0, 0.9)):
        session.apply(command, 1.0)
    session.apply(Undo(), 2.0)
    session.apply(Undo(), 2.0)
    assert session.state[Preview].before is not None
    session.apply(ToSandbox(), 3.0)
    session.apply(BackToLesson(), 3.0)
    assert session.state[LessonPart].lesson is not None
    session.apply(EndPreview(), 4.0)
    assert session.state[Joints].q[0] == 0.3
    session.apply(Undo(), 5.0)
    assert session.state[Joints].q[0] == loaded[Joints].q[0]


@pytest.mark.parametrize("sandbox", [False, True])
def test_after_a_file_is_loaded_in_a_preview_undo_goes_on_from_ones_own_work(loaded, sandbox):
    session = Session("x", OPENING, loaded)
    away = (MoveJoint(0, 0.9), *[ToSandbox()] * sandbox)
    lesson, arm = read_upload(f"mine.md\n{TWO_STEPS}"), read_upload(f"arm.toml\n{robot_toml(catalogue()['ur10'])}")
    seen = ChooseRobot("scara"), MoveJoint(0, 0.3), PreviewLesson(key(loaded, "mine.md"), "author"), *away
    for i, command in enumerate((*seen, LoadFile(lesson))):
        session.apply(command, 2.0 * i)
    assert [step.label for step in session.history.past] == [ChooseRobot.label, MoveJoint.label]
    for i, command in enumerate((PreviewLesson("t", "author"), *away, LoadFile(arm), Undo()), start=10):
        session.apply(command, 2.0 * i)
    assert (session.robot.key, session.state[Joints].q[0]) == ("scara", 0.3)
    assert session.state[OwnLessons].holds(key(session.state, "mine.md"))


def test_a_preview_from_within_another_has_an_undo_of_its_own(loaded):
    session = Session("x", OPENING, load(loaded, ("other.md", TWO_STEPS)))
    session.apply(PreviewLesson(key(session.state, "mine.md"), "author"), 1.0)
    session.apply(MoveJoint(0, 0.9), 1.0)
    session.apply(PreviewLesson(key(session.state, "other.md"), "author"), 2.0)
    there = session.state[Joints].q[0]
    session.apply(Undo(), 3.0)
    assert session.state[Joints].q[0] == there
    assert session.state[LessonPart].lesson.title == "T"


def test_a_chosen_language_stays_in_a_preview_and_behind_it(loaded):
    seen = see(apply(loaded, ReadIn("it")), "mine.md")
    assert seen[LanguagePart].chosen == "it"
    assert apply(apply(seen, ReadIn("en")), EndPreview())[LanguagePart].chosen == "en"


def test_a_course_is_put_in_order_and_the_lab_keeps_its_own(loaded):
    course = 'title = "C"\n[[chapters]]\ntitle = "One"\nlessons = ["t", "v"]\n'
    state = apply(load(loaded, ("course.toml", course)), MoveInCourse("v", -1))
    assert saved(state)[OwnLessons].course.lessons == ("v", "t")
    state = apply(apply(state, LeaveOut("t")), LeaveOut("t", back=True))
    assert state[OwnLessons].course.lessons == ("v", "t")
    begun = apply(loaded, ArrangeCourse())[OwnLessons].course
    assert set(begun.lessons) == {"t", "v"}
    assert apply(state, ArrangeCourse(False))[OwnLessons].course is None
    with pytest.raises(ArmlabError, match="none is being put in order"):
        apply(loaded, LeaveOut("t"))


def test_an_arm_is_put_on_the_table(loaded):
    text = robot_toml(catalogue()["planar_3r"])
    assert load(loaded, ("three.toml", text))[RobotPart].robot.arm.n == 3
