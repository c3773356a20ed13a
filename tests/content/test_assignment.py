"""The files of assignments: what they hold, and the sentences about their mistakes."""

import datetime

import pytest

from armlab import resources
from armlab.content import lessons as library_module
from armlab.content.assignment import amiss, parse_assignment
from armlab.content.lesson_folder import assignments_of
from armlab.content.lessons import changed
from armlab.content.outline import Outlines
from armlab.errors import ContentError, UnknownName
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")

WHOLE = """title = "Homework 1"
about = "Two arms."
version = 3
exam = true
pages = ["joints"]
opens = 2026-11-30T08:00:00Z
due = 2026-11-30T10:00:00Z
closes = 2026-11-30T12:00:00Z
minutes = 90
attempts = 2
late_percent = 20

[[tasks]]
lesson = "v"
points = 6

[[tasks]]
lesson = "t"
variant = 4
[tasks.points]
"Same" = 2.5
"""


def moment(hour):
    return datetime.datetime(2026, 11, 30, hour, tzinfo=datetime.UTC).timestamp()


def test_what_an_assignment_holds():
    found = parse_assignment("hw", WHOLE, "hw.toml")
    assert (found.title, found.about, found.version) == ("Homework 1", "Two arms.", 3)
    assert (found.exam, found.hints, found.pages, found.attempts) == (True, False, ("joints",), 2)
    assert (found.opens, found.due, found.closes) == (moment(8), moment(10), moment(12))
    assert found.lessons == ("v", "t")
    assert [task.number(17) for task in found.tasks] == [17, 4]
    assert found.ends(moment(9)) == moment(10) + 30 * 60  # 90 minutes
    assert found.ends(moment(11)) == moment(12)  # closed before they are over


def test_what_is_left_out_leaves_time_and_attempts_free():
    found = parse_assignment("hw", 'title = "H"\n[[tasks]]\nlesson = "v"\n', "hw.toml")
    assert (found.exam, found.hints, found.pages, found.attempts, found.version) == (False, True, None, 0, 1)
    assert found.ends(0.0) is None
    exam = parse_assignment("hw", 'title = "H"\nexam = true\ndue = 2026-11-30\n[[tasks]]\nlesson = "v"\n', "hw.toml")
    assert (exam.hints, exam.attempts) == (False, 1)
    assert exam.closes == exam.due == datetime.datetime(2026, 11, 30, 23, 59, 59).timestamp()


def test_the_points_of_a_lesson_are_spread_over_its_tasks(own):
    spread, by_step = parse_assignment("hw", WHOLE, "hw.toml").tasks
    assert spread.points_of(library_module.lessons()["v"]) == (2.0, 2.0, 2.0)
    assert by_step.points_of(library_module.lessons()["t"]) == (0.0, 2.5, 2.5)


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        (
            "due = 2026-11-30T10:00:00Z",
            "due = 10:00:00",
            7,
            "due: expected a date or .*, without quotes, got 10:00:00$",
        ),
        ("due = 2026-11-30T10", "due = 2026-11-30T07", 7, "due: expected a moment after opens, "),
        ("closes = 2026-11-30T12", "closes = 2026-11-30T09", 8, "closes: expected a moment after due, "),
        ("minutes = 90", "minutes = 300", 9, "minutes: expected at most the 240 minutes for which it is open, got 300"),
        ("due = 2026-11-30T10:00:00Z\n", "", 10, "late_percent: without a date that it is due nothing is late"),
        ("closes = 2026-11-30T12:00:00Z\n", "", 10, "late_percent: it closes when it is due, so nothing can be late"),
        ("pages", "hints = true\npages", 5, "hints: an exam gives no hints"),
        ("late_percent", "last_hint_percent = 5\nlate_percent", 11, "last_hint_percent: without hints none costs"),
        ("late_percent", "last_hint_percent = 101\nlate_percent", 11, "last_hint_percent: expected 0 to 100, got 101"),
        ("2026-11-30T08:00:00Z", '"Monday"', 6, r"opens: expected a date or a date with a time such as 2026-11-30, "),
        ("2026-11-30T08:00:00Z", "0001-01-01", 6, "opens: expected a year from 1971 to 9998, got 1"),
        ("attempts = 2", "attempt = 2", 10, "attempt: unknown key; did you mean 'attempts'"),
        (
            "variant = 4",
            'variant = "own"',
            19,
            r"tasks\[2\]\.variant: expected \"student\", for one of their own each,",
        ),
        ('lesson = "t"', 'lesson = "v"', 18, r"tasks\[2\]\.lesson: the lesson 'v' is in the assignment already"),
        ("points = 6", "points = -6", 15, r"tasks\[1\]\.points: expected more than 0 and at most 10000 points, got -6"),
        ("version = 3", "version = = 3", 3, "not valid TOML"),
    ],
)
def test_mistakes_are_told_with_file_and_line(old, new, line, says):
    assert WHOLE.count(old) >= 1
    with pytest.raises(ContentError, match=rf"hw\.toml, line {line}: {says}"):
        parse_assignment("hw", WHOLE.replace(old, new, 1), "hw.toml")


def test_an_assignment_without_tasks_is_none():
    with pytest.raises(ContentError, match=r"tasks: expected 1 to 50 tables \[\[tasks\]\] with a lesson each, got 0"):
        parse_assignment("hw", 'title = "H"\n', "hw.toml")


def written(folder, text):
    """Write the file anew, as an editor does; return what the library says of it."""
    (folder / "hw.toml").unlink(missing_ok=True)
    (folder / "hw.toml").write_text(text, encoding="utf-8")
    changed()
    return library_module.lessons()


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"v"', '"w"', r"hw.toml, line 14: tasks[1].lesson: unknown lesson 'w'. Available: t, v"),
        ('"Same"', '"Sane"', "hw.toml, line 21: tasks[2].points.Sane: the lesson 't' has no step 'Sane'; did you mean"),
        (
            '"Same"',
            '"Read"',
            "hw.toml, line 21: tasks[2].points.Read: the step 'Read' of the lesson 't' has nothing to",
        ),
    ],
)
def test_a_mistake_is_told_and_the_assignment_stays_as_it_was(own, tmp_path, old, new, says):
    before = written(tmp_path / "mine", WHOLE)
    assert (before.problems, list(before.assignments)) == ((), ["hw"])
    after = written(tmp_path / "mine", WHOLE.replace(old, new, 1))
    assert says in str(after.problems[0])
    assert after.assignment("hw") is before.assignment("hw")
    (tmp_path / "mine" / "hw.toml").unlink()
    changed()
    gone = library_module.lessons()
    assert (gone.problems, list(gone.assignments)) == ((), [])
    assert gone.assignment("hw") is before.assignment("hw")  # for those who are in it


def test_a_lesson_that_is_not_listed_is_in_no_list(own):
    own(
        v=None, hidden='+++\ntitle = "H"\nchapter = "1"\nlisted = false\nteaches = []\nrobot = "planar_2r"\n+++\n## A\n'
    )
    found = library_module.lessons()
    assert "hidden" in found.lessons
    assert [key for chapter in (*found.course().chapters, *found.others) for key in chapter.lessons] == ["t"]
    with pytest.raises(UnknownName, match=r"unknown name 'hiden'\. Available: t$"):
        found["hiden"]


def test_the_example_of_the_readme_is_an_exam():
    readme = (resources.folder("lessons") / "README.md").read_text(encoding="utf-8")
    (example,) = (part.split("```")[0] for part in readme.split("```toml\n") if part.startswith('title = "Exam 1"'))
    found = parse_assignment("exam_1", example, "exam_1.toml")
    assert [*amiss(found, example, library_module.lessons().lessons, ())] == []
    assert (found.exam, found.minutes, found.closes - found.due) == (True, 90, 30 * 60)


def test_a_lesson_of_assignments_is_in_no_course(own, tmp_path):
    course = 'title = "C"\n[[chapters]]\ntitle = "One"\nlessons = ["t", "w"]\n'
    (tmp_path / "mine" / "course.toml").write_text(course)
    own(w='+++\ntitle = "W"\nchapter = "1"\nlisted = false\nteaches = []\nrobot = "planar_2r"\n+++\n## A\nRead.\n')
    assert library_module.lessons().course("lab").lessons == ("t",)
    assert Outlines([tmp_path / "mine"]).look().courses[0].lessons == ("t",)


def test_the_files_of_a_course_and_of_its_guide_are_no_assignments(tmp_path):
    for name in ("course.toml", "guide.toml", "exam.toml", ".hidden.toml"):
        (tmp_path / name).write_text("", encoding="utf-8")
    assert [source.key for source in assignments_of(tmp_path)] == ["exam"]
