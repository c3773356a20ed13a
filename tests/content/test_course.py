"""Courses: their files with every mistake, what lessons need, and the course of the lab itself."""

import pytest

from armlab import resources
from armlab.content.course import amiss, parse_course, sound
from armlab.content.courses import OF_THE_LAB, mistakes_in
from armlab.content.lesson_file import parse_lesson
from armlab.content.lesson_head import MOST_CAN, head_of, time_said
from armlab.content.lesson_lines import LessonError
from armlab.content.lessons import Library, lessons
from armlab.content.outline import Outlines, first_heads

COURSE = """# "b" in a comment is no lesson
title = "A course"
about = "A word."

[[chapters]]
title = "One"
lessons = [
    "a",
    "b",
]

[[chapters]]
title = "Two"
about = "More."
lessons = ["c", 'd']
"""

LESSON = """+++
title = "Lesson {key}"
chapter = "{chapter}"
after = [{after}]
minutes = 10
can = ["Do {key}."]
teaches = []
robot = "planar_2r"
+++
## Step
{body}
"""


def text(key, *after, chapter="9 Others", body="Text."):
    needed = ", ".join(f'"{each}"' for each in after)
    return LESSON.format(key=key, after=needed, chapter=chapter, body=body)


def write(folder, course=None, **texts):
    """Write a course and lessons into a folder, or take them away (None)."""
    folder.mkdir(exist_ok=True)
    for name, content in {**({"course.toml": course} if course is not None else {}), **texts}.items():
        path = folder / (name if "." in name else f"{name}.md")
        # A file of another number: two writes may fall into one tick of the clock of the file system.
        path.unlink(missing_ok=True)
        if content:
            path.write_text(content, encoding="utf-8")
    return folder


def problems(found):
    return [str(problem) for problem in found.lessons.problems]


# --- The file


def test_what_a_course_holds():
    course = parse_course("mine", COURSE, "course.toml")
    assert (course.key, course.title, course.about) == ("mine", "A course", "A word.")
    assert [(each.title, each.about, each.lessons) for each in course.chapters] == [
        ("One", "", ("a", "b")),
        ("Two", "More.", ("c", "d")),
    ]
    assert course.lessons == ("a", "b", "c", "d")
    assert course.chapter_of["c"] == "Two"
    assert course.among({"a", "b"}).lessons == ("a", "b")
    assert [each.title for each in course.among({"a", "b"}).chapters] == ["One"]
    assert course.among({"a", "b", "c", "d", "e"}) is course


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ('title = "A course"', "title = = 1", 2, "not valid TOML"),
        ('title = "A course"\n', "", 1, "title: missing; the file has about, chapters"),
        ('about = "A word."', 'abuot = "A word."', 3, "abuot: unknown key; did you mean 'about'?"),
        ('title = "One"', 'titel = "One"', 5, r"chapters\[1\].title: missing"),
        ('title = "Two"', 'title = "One"', 13, r"chapters\[2\].title: chapter 1 has this title, too; change one"),
        ("lessons = [\"c\", 'd']", "lessons = []", 15, r"chapters\[2\].lessons: expected at least one lesson"),
        ("lessons = [\"c\", 'd']", 'lessons = "c"', 15, r"chapters\[2\].lessons: expected a list of texts, got 'c'"),
        (
            "[\"c\", 'd']",
            "[\"c\",\n  'b']",
            16,
            r"chapters\[2\].lessons\[2\]: the lesson 'b' is in the course already, at",
        ),
        (COURSE[COURSE.index("[[chapters]]") :], "", 1, "chapters: expected at least one chapter, a table"),
    ],
)
def test_a_mistake_in_the_file_has_its_line(old, new, line, says):
    assert old in COURSE
    with pytest.raises(LessonError, match=rf"^mine/course\.toml, line {line}: {says}"):
        parse_course("mine", COURSE.replace(old, new), "mine/course.toml")


def test_lessons_that_do_not_exist_or_stand_too_early_have_their_lines(tmp_path):
    folder = write(tmp_path / "mine", COURSE)
    known = {"a", "b", "c", "e"}
    told = mistakes_in(folder, known, {"a": ("c", "e"), "b": ("a",), "c": ()})
    assert [str(error) for error in told] == [
        "course.toml, line 8: chapters[1].lessons[1]: the lesson 'a' stands before 'c', which it needs; "
        "put it behind that one",
        "course.toml, line 15: chapters[2].lessons[2]: unknown lesson 'd'. Available: a, b, c, e",
    ]
    assert mistakes_in(tmp_path, known, {}) == []


def test_the_example_of_the_readme_is_a_course():
    readme = (resources.folder("lessons") / "README.md").read_text(encoding="utf-8")
    (example,) = (part.split("```")[0] for part in readme.split("```toml\n") if part.startswith('title = "My course"'))
    course = parse_course("mine", example, "course.toml")
    assert [len(each.lessons) for each in course.chapters] == [2, 1]
    assert set(course.lessons) - set(lessons().lessons) == {"my_lesson"}


# --- What lessons say of themselves


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ("minutes = 10", "minutes = 0", 5, "minutes: expected a whole number from 1 to 180, got 0"),
        ("minutes = 10", "minutes = 181", 5, "minutes: expected a whole number from 1 to 180, got 181"),
        ("minutes = 10", "minutes = 7.5", 5, "minutes: expected a whole number from 1 to 180, got 7.5"),
        ("minutes = 10", 'minutes = "ten"', 5, "minutes: expected a number, got 'ten'"),
        ("after = []", 'after = ["b", "x"]', 4, r"after\[2\]: the lesson needs itself"),
        ("after = []", 'after = ["b", "b"]', 4, r"after\[2\]: the lesson 'b' is named twice"),
        ("after = []", 'after = "b"', 4, "after: expected a list of texts, got 'b'"),
        ('can = ["Do x."]', "can = []", 6, "can: expected 1 to 4 sentences, got 0"),
        ('can = ["Do x."]', f"can = {['Do.'] * (MOST_CAN + 1)}", 6, "can: expected 1 to 4 sentences, got 5"),
        ('can = ["Do x."]', f'can = ["{"x" * 141}"]', 6, r"can\[1\]: expected a sentence of at most 140 characters"),
        ('can = ["Do x."]', 'can = ["It is {{px}}."]', 6, r"can\[1\]: expected a sentence without live values"),
    ],
)
def test_mistakes_in_what_a_lesson_says_of_itself(old, new, line, says):
    good = text("x")
    assert old in good
    for read in (lambda t: parse_lesson("x", t), lambda t: head_of("x", t, "x.md")):
        with pytest.raises(LessonError, match=rf"^x\.md, line {line}: {says}"):
            read(good.replace(old, new))


def test_a_lesson_need_not_say_it():
    plain = "\n".join(line for line in text("x").splitlines() if line.split(" ")[0] not in ("after", "minutes", "can"))
    lesson = parse_lesson("x", plain)
    assert (lesson.after, lesson.can, lesson.minutes) == ((), (), 0)


def test_the_head_is_that_of_the_lesson_also_in_a_broken_one():
    whole = (
        text("x", "b").replace("Lesson x", "Lesson {{=n}}").replace("+++\n##", "[variants]\nn = {choose=[4]}\n+++\n##")
    )
    head, lesson = head_of("x", whole, "x.md"), parse_lesson("x", whole)
    names = ("key", "title", "chapter", "after", "can", "minutes")
    assert [getattr(head, name) for name in names] == [getattr(lesson, name) for name in names]
    assert head.title == "Lesson 4"
    assert head_of("x", whole.replace("Text.", "$\\foo$"), "x.md") == head


def test_circles_are_named_and_leave_the_rest_sound():
    needs = {"a": ("b",), "b": ("c", "d"), "c": ("a",), "d": (), "e": ("a", "gone")}
    told = amiss(needs, needs)
    assert told["b"] == [
        "a circle: 'b' needs 'c', which needs 'a', which needs 'b'; nobody could begin, so take one of these away"
    ]
    assert set(told) == {"a", "b", "c", "e"}
    assert told["e"][0].startswith("unknown lesson 'gone'")
    assert sound(needs, needs) == {"a": (), "b": ("d",), "c": (), "d": (), "e": ("a",)}


def test_the_time_is_told_as_people_say_it():
    assert [time_said(minutes) for minutes in (0, 1, 59, 60, 61, 120)] == [
        "",
        "1 min",
        "59 min",
        "1 h",
        "1 h 1 min",
        "2 h",
    ]


# --- In a library


@pytest.fixture
def lab(tmp_path):
    return write(tmp_path / "lab", COURSE, a=text("a"), b=text("b", "a"), c=text("c"), d=text("d", "c"))


def test_a_library_has_the_course_and_what_no_course_names(lab):
    write(lab, e=text("e", chapter="10 Last"), f=text("f", "a", chapter="2 First"))
    found = Library([lab]).lessons
    assert [course.key for course in found.courses] == [OF_THE_LAB]
    assert found.course().lessons == ("a", "b", "c", "d")
    assert [(each.title, each.lessons) for each in found.others] == [("2 First", ("f",)), ("10 Last", ("e",))]
    assert [each.title for each in found.chapters()] == ["One", "Two", "2 First", "10 Last"]
    assert found.needs["f"] == ("a",)
    assert found.problems == ()


def test_without_a_file_all_lessons_are_a_course_by_their_chapters(tmp_path):
    folder = write(tmp_path / "lab", z=text("z", chapter="2 First"), y=text("y", chapter="10 Last"))
    found = Library([folder]).lessons
    assert found.courses == ()
    assert found.course().lessons == ("z", "y")
    assert found.others == ()
    assert Library([write(tmp_path / "none")]).lessons.course().lessons == ()


def test_an_own_course_is_shown_before_that_of_the_lab_which_can_be_chosen(lab, tmp_path):
    own = write(
        tmp_path / "My Folder", COURSE.replace("A course", "Mine").replace('"b",', '"own",'), own=text("own", "a")
    )
    found = Library([lab])
    found.add_folder(own)
    assert [(course.key, course.title) for course in found.lessons.courses] == [
        ("my_folder", "Mine"),
        ("lab", "A course"),
    ]
    assert found.lessons.course().lessons == ("a", "own", "c", "d")
    assert found.lessons.course("lab").lessons == ("a", "b", "c", "d")
    assert found.lessons.course("gone").title == "Mine"
    assert found.lessons.others == ()
    write(own, "")
    assert found.changed() == frozenset()
    assert found.lessons.course().title == "A course"


def test_folders_of_one_name_have_courses_of_their_own(lab, tmp_path):
    found = Library([lab])
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        found.add_folder(write(tmp_path / name / "lab", COURSE.replace("A course", name)))
    assert [(course.key, course.title) for course in found.lessons.courses] == [
        ("lab_2", "one"),
        ("lab_3", "two"),
        ("lab", "A course"),
    ]


@pytest.mark.parametrize(
    ("course", "says"),
    [
        (COURSE.replace('"a",', '"a",\n    "zz",'), "course.toml, line 9: chapters[1].lessons[2]: unknown lesson 'zz'"),
        (COURSE.replace("'d'", "'a'"), "course.toml, line 15: chapters[2].lessons[2]: the lesson 'a' is in the course"),
        (COURSE.replace("[[chapters]]", "[[chapters]"), "course.toml, line 5: not valid TOML"),
        (
            COURSE.replace('"a",\n    "b"', '"b",\n    "a"'),
            "course.toml, line 8: chapters[1].lessons[1]: the lesson 'b'",
        ),
    ],
)
def test_a_file_with_a_mistake_is_told_and_leaves_the_course_as_it_was(lab, course, says):
    found = Library([lab])
    before = found.lessons.course()
    write(lab, course)
    found.changed()
    assert found.lessons.course() == before
    (told,) = problems(found)
    assert told.startswith(says)
    write(lab, COURSE.replace("A course", "Mended"))
    found.changed()
    assert (found.lessons.course().title, problems(found)) == ("Mended", [])


def test_a_wrong_own_course_at_the_start_leaves_that_of_the_lab(lab, tmp_path):
    own = write(tmp_path / "mine", COURSE.replace('"a"', '"zz"'))
    found = Library([lab, own])
    assert [course.title for course in found.lessons.courses] == ["A course"]
    assert problems(found)[0].startswith("mine/course.toml, line 8: chapters[1].lessons[1]: unknown lesson 'zz'")


def test_a_broken_lesson_leaves_the_course_without_it(tmp_path):
    lab = write(tmp_path / "lab", COURSE, a=text("a"), b=text("b", body="$\\foo$"), c=text("c"), d=text("d"))
    found = Library([lab])
    assert found.lessons.course().lessons == ("a", "c", "d")
    assert len(problems(found)) == 1
    assert problems(found)[0].startswith("b.md, line 11: step 1: the formula")
    write(lab, b=text("b"))
    found.changed()
    assert found.lessons.course().lessons == ("a", "b", "c", "d")


def test_a_lesson_taken_away_is_missed_in_the_file_and_the_course_goes_on(lab):
    found = Library([lab])
    write(lab, d="")
    found.changed()
    assert found.lessons.course().lessons == ("a", "b", "c")
    assert problems(found) == ["course.toml, line 15: chapters[2].lessons[2]: unknown lesson 'd'. Available: a, b, c"]


def test_what_is_wrong_with_needs_is_told_with_file_and_line_and_the_lessons_stay(lab):
    found = Library([lab])
    write(lab, a=text("a", "b"), c=text("c", "cc"))
    assert found.changed() == {"a", "c"}
    assert list(found.lessons.lessons) == ["a", "b", "c", "d"]
    assert problems(found) == [
        "a.md, line 4: after: a circle: 'a' needs 'b', which needs 'a'; nobody could begin, so take one of these away",
        "b.md, line 4: after: a circle: 'b' needs 'a', which needs 'b'; nobody could begin, so take one of these away",
        "c.md, line 4: after: unknown lesson 'cc'; did you mean 'c'? Available: a, b, c, d",
    ]
    assert {key for key, errors in found.lessons.amiss.items() if errors} == {"a", "b", "c"}
    assert found.lessons.needs == {"a": (), "b": (), "c": (), "d": ("c",)}


def test_nothing_is_read_again_that_has_not_changed(lab, monkeypatch):
    found = Library([lab])
    before = found.lessons
    monkeypatch.setattr("armlab.content.lesson_folder.Source.read", lambda self: pytest.fail("read"))
    assert found.changed() == frozenset()
    assert found.lessons is before


def test_a_course_that_leads_out_of_its_folder_is_refused(lab, tmp_path):
    (tmp_path / "secret.toml").write_text(COURSE, encoding="utf-8")
    own = write(tmp_path / "mine")
    (own / "course.toml").symlink_to("../secret.toml")
    found = Library([lab, own])
    assert problems(found) == ["mine/course.toml: it leads out of the folder mine; put the file itself there"]
    assert [course.key for course in found.lessons.courses] == ["lab"]


# --- Without the lessons themselves


def test_the_outline_is_that_of_the_library_and_follows_the_files(lab, tmp_path):
    own = write(tmp_path / "mine", e=text("e", "a"))
    library, outlines = Library([lab, own]), Outlines([lab, own])
    outline, found = outlines.look(), library.lessons
    assert (outline.courses, outline.others) == (found.courses, found.others)
    assert {key: head.title for key, head in outline.heads.items()} == {k: v.title for k, v in found.lessons.items()}
    assert dict(outline.needs) == dict(found.needs)
    assert outlines.look() is outline
    write(lab, COURSE.replace("A course", "Another").replace('"b",', ""))
    assert outlines.look().courses[0].title == "Another"
    assert [each.lessons for each in outlines.look().others] == [("b", "e")]
    write(lab, "title = = 1")
    assert outlines.look().courses[0].title == "Another"
    write(lab, "")
    assert [(each.key, each.lessons) for each in outlines.look().courses] == [("", ("a", "b", "c", "d", "e"))]


# --- The lab's own


def test_the_course_of_the_lab_holds_every_lesson_once_and_without_a_mistake():
    found = lessons()
    missing = [key for chapter in found.others for key in chapter.lessons]
    assert missing == [], "a new lesson is one line in lessons/course.toml"
    assert [str(problem) for problem in found.problems] == []
    assert sorted(found.course(OF_THE_LAB).lessons) == sorted(lesson.key for lesson in found.listed)


def test_every_lesson_of_the_lab_says_what_it_needs_what_one_can_do_and_how_long_it_takes():
    for lesson in lessons().listed:
        key, steps = lesson.key, len(lesson.steps)
        assert 1.5 * steps <= lesson.minutes <= 4.5 * steps, f"{key}: {lesson.minutes} min for {steps} steps"
        assert lesson.can, key
        assert all(sentence[0].isupper() and sentence.endswith(".") for sentence in lesson.can), key
    first = lessons().course(OF_THE_LAB).lessons[0]
    assert lessons()[first].after == ()


def test_the_first_visit_gets_the_heads_of_the_first_lessons():
    found = lessons()
    for head, key in zip(first_heads(3), found.course(OF_THE_LAB).lessons, strict=False):
        lesson = found.lessons[key]
        assert (head.key, head.title, head.minutes, head.can) == (key, lesson.title, lesson.minutes, lesson.can)
    assert len(first_heads(3)) == 3


def test_the_first_visit_does_without_a_course_that_cannot_be_read(tmp_path, monkeypatch):
    folder = write(tmp_path / "lessons", "title = = 1")
    monkeypatch.setattr(resources, "folder", lambda name: folder)
    assert first_heads.__wrapped__(3) == ()
    write(folder, "")
    assert first_heads.__wrapped__(3) == ()
    write(folder, COURSE, a=text("a"), b="nothing")
    assert first_heads.__wrapped__(3) == ()
    write(folder, b=text("b"))
    assert [head.key for head in first_heads.__wrapped__(3)] == ["a", "b"]
