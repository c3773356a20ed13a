"""Folders of lessons: found, added, read again when they change, and never left."""

import os
import threading

import pytest

from armlab.content import lesson_reading as module
from armlab.content.lesson_folder import MOST_LESSONS, MOST_TEXT
from armlab.content.lesson_reading import MOST_VARIANTS
from armlab.content.lessons import Library, lesson, lessons, library
from armlab.content.pictures import MOST_PICTURES
from armlab.errors import ContentError, InputError, UnknownName
from support.lesson_texts import RICH

FRONT = """+++
title = "{title}"
chapter = "{chapter}"
teaches = []
robot = "planar_2r"
+++
## Step
{body}
"""
PNG = b"\x89PNG\r\n\x1a\n" + b"\0" * 20


def text(title="A lesson", chapter="1", body="Text."):
    return FRONT.format(title=title, chapter=chapter, body=body)


@pytest.fixture
def lab(tmp_path):
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "first.md").write_text(text("First"), encoding="utf-8")
    return folder


@pytest.fixture
def mine(tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    return folder


def problems(found):
    return sorted(str(problem) for problem in found.lessons.problems)


def test_the_lessons_of_the_lab_are_there():
    assert library().lessons is lessons()
    assert lesson("first_arm") is lessons()["first_arm"]
    assert lesson("first_arm", 12) is lesson("first_arm", 12)
    assert lesson("first_arm", 12).variant == 12
    with pytest.raises(UnknownName, match="lesson: unknown name 'frist_arm'; did you mean 'first_arm'"):
        lesson("frist_arm")


def test_a_variant_is_there_while_the_files_are_looked_at():
    with library()._lock:
        seen = []
        reader = threading.Thread(target=lambda: seen.append(library().lesson("first_arm", 3).variant))
        reader.start()
        reader.join(10.0)
        assert seen == [3]


def test_a_broken_lesson_disturbs_no_other(lab):
    (lab / "broken.md").write_text("nothing", encoding="utf-8")
    (lab / "binary.md").write_bytes(b"\xff\xfe\x00")
    (lab / "README.md").write_text("no lesson", encoding="utf-8")
    (lab / "Bad Name.md").write_text(text(), encoding="utf-8")
    (lab / ".hidden.md").write_text("nothing", encoding="utf-8")
    (lab / "notes.txt").write_text("nothing", encoding="utf-8")
    (lab / "empty").mkdir()
    for key, chapter in (("ten", "10 Last"), ("two", "2 First"), ("also_two", "2 First")):
        (lab / f"{key}.md").write_text(text(chapter=chapter), encoding="utf-8")
    found = Library([lab])
    assert list(found.lessons.lessons) == ["first", "also_two", "two", "ten"]
    assert problems(found) == [
        "Bad Name.md: expected a file name of lower-case letters, digits and underscores, got 'Bad Name'; rename it",
        "binary.md: not a text in UTF-8: invalid start byte",
        "broken.md, line 1: expected a first line +++ before title, robot and the rest",
    ]
    with pytest.raises(ContentError, match=r"broken\.md, line 1: expected a first line"):
        found.lesson("broken")
    with pytest.raises(UnknownName, match="lesson: unknown name 'tenn'; did you mean 'ten'"):
        found.lesson("tenn")


# --- Changes


def test_nothing_is_read_when_nothing_changed(lab, monkeypatch):
    found = Library([lab])
    before = found.lessons
    monkeypatch.setattr("armlab.content.lesson_folder.Source.read", lambda self: pytest.fail("read"))
    assert found.changed() == frozenset()
    assert found.lessons is before


def test_what_changes_is_read_again(lab):
    found = Library([lab])
    (lab / "first.md").write_text(text("Another title"), encoding="utf-8")
    (lab / "second.md").write_text(text("Second"), encoding="utf-8")
    assert found.changed() == {"first", "second"}
    assert found.lesson("first").title == "Another title"
    assert found.changed() == frozenset()


def test_what_changes_while_the_files_are_read_is_seen_at_the_next_look(lab, monkeypatch):
    found, read = Library([lab]), module.Readings.read

    def read_and_meanwhile(readings, source):
        reading = read(readings, source)
        (lab / "first.md").write_text(text("Later"), encoding="utf-8")
        return reading

    (lab / "second.md").write_text(text("Second"), encoding="utf-8")
    with monkeypatch.context() as patch:
        patch.setattr(module.Readings, "read", read_and_meanwhile)
        assert found.changed() == {"second"}
    assert found.changed() == {"first"}


def test_what_changes_beside_a_link_that_leads_nowhere_is_read_again(lab):
    (lab / "broken.md").symlink_to(lab / "gone.md")
    found = Library([lab])
    assert found.changed() == frozenset()
    (lab / "first.md").write_text(text("Another title"), encoding="utf-8")
    assert found.changed() == {"first"}


def test_a_file_written_again_as_it_was_has_not_changed(lab):
    found = Library([lab])
    before = found.lesson("first")
    (lab / "first.md").write_text(text("First"), encoding="utf-8")
    os.utime(lab / "first.md", (1, 1))
    assert found.changed() == frozenset()
    assert found.lesson("first") is before


def test_a_file_that_became_broken_keeps_its_last_lesson(lab):
    found = Library([lab])
    good = found.lesson("first")
    (lab / "first.md").write_text(text(body="$\\foo$"), encoding="utf-8")
    assert found.changed() == {"first"}
    assert found.lesson("first") is good
    assert list(found.lessons.lessons) == ["first"]
    assert len(problems(found)) == 1
    assert problems(found)[0].startswith("first.md, line 8: step 1: the formula")
    assert found.changed() == frozenset()
    (lab / "first.md").write_text(text("Mended"), encoding="utf-8")
    assert found.changed() == {"first"}
    assert found.lesson("first").title == "Mended"
    assert problems(found) == []


def test_a_lesson_taken_away_stays_for_those_who_are_in_it(lab):
    found = Library([lab])
    good = found.lesson("first")
    (lab / "first.md").unlink()
    assert found.changed() == {"first"}
    assert found.lessons.lessons == {}
    assert found.lesson("first") is good
    (lab / "first.md").write_text(text("Back"), encoding="utf-8")
    assert found.changed() == {"first"}
    assert found.lesson("first").title == "Back"
    assert found.lessons.gone == {}


def test_a_file_becomes_a_folder(lab):
    found = Library([lab])
    (lab / "first.md").unlink()
    (lab / "first").mkdir()
    (lab / "first" / "lesson.md").write_text(text("First", body="![x](a.png)"), encoding="utf-8")
    (lab / "first" / "a.png").write_bytes(PNG)
    assert found.changed() == {"first"}
    assert found.lesson("first").file == "first/lesson.md"


def test_a_lesson_that_moves_as_it_is_into_another_folder_is_found_there(lab, mine):
    found = Library([lab, mine])
    (lab / "first.md").rename(mine / "first.md")
    found.changed()
    assert found.lesson("first").file == "mine/first.md"


def test_a_picture_that_changes_changes_its_lesson(lab):
    (lab / "second").mkdir()
    (lab / "second" / "lesson.md").write_text(text(body="![x](a.png)"), encoding="utf-8")
    (lab / "second" / "a.png").write_bytes(PNG)
    found = Library([lab])
    before = found.lesson("second")
    (lab / "second" / "a.png").write_bytes(PNG + b"\0")
    assert found.changed() == {"second"}
    after = found.lesson("second")
    assert (before.digest, before.steps[0].html) != (after.digest, after.steps[0].html)
    assert before.digest != after.digest
    (lab / "second" / "a.png").unlink()
    assert found.changed() == {"second"}
    assert found.lesson("second") is after
    assert "unknown picture 'a.png'" in problems(found)[0]


def test_threads_read_and_write_at_once(lab):
    found = Library([lab])
    seen, wrong = [], []

    def look():
        try:
            for _ in range(60):
                found.changed()
                seen.append(found.lesson("first", 3).title)
        except Exception as error:
            wrong.append(error)

    threads = [threading.Thread(target=look) for _ in range(4)]
    for thread in threads:
        thread.start()
    for i in range(30):
        fresh = lab / "fresh.tmp"
        fresh.write_text(text(f"Title {i}"), encoding="utf-8")
        fresh.replace(lab / "first.md")
    for thread in threads:
        thread.join()
    assert wrong == []
    found.changed()
    assert found.lesson("first").title == "Title 29"
    assert {title.split()[0] for title in seen} <= {"First", "Title"}


# --- Variants


def test_variants_are_kept_and_follow_the_file(lab):
    (lab / "rich.md").write_text(RICH, encoding="utf-8")
    found = Library([lab])
    third = found.lesson("rich", 3)
    assert (third.variant, third.varies) == (3, True)
    assert found.lesson("rich", 3) is third
    assert found.lesson("rich", 0) is found.lessons["rich"]
    (lab / "rich.md").write_text(RICH.replace("## Compute", "## Compute it"), encoding="utf-8")
    assert found.changed() == {"rich"}
    again = found.lesson("rich", 3)
    assert again.steps[1].title == "Compute it"
    assert again.values == third.values


def test_the_number_of_variants_kept_is_bounded(lab, monkeypatch):
    (lab / "rich.md").write_text(RICH, encoding="utf-8")
    found = Library([lab])
    first = found.lesson("rich", 1)
    monkeypatch.setattr("armlab.content.lesson_reading.MOST_VARIANTS", 3)
    for number in range(2, 6):
        found.lesson("rich", number)
    assert found.lesson("rich", 5) is found.lesson("rich", 5)
    assert found.lesson("rich", 1) is not first
    assert MOST_VARIANTS > 100


def test_a_variant_that_cannot_be_used_says_so(lab):
    body = text().replace("+++\n##", '[variants]\na = { choose = [1, 0] }\nb = "1 / a"\n+++\n##')
    (lab / "second.md").write_text(body, encoding="utf-8")
    found = Library([lab])
    assert found.lesson("second").values == {"a": 1.0, "b": 1.0}
    numbers = [number for number in range(1, 20) if _is_broken(found, number)]
    assert numbers
    with pytest.raises(ContentError, match=rf"b: it has no value in variant {numbers[0]}: .*division by zero"):
        found.lesson("second", numbers[0])


def _is_broken(found, number):
    try:
        found.lesson("second", number)
    except ContentError:
        return True
    return False


# --- A teacher's folder


def test_a_folder_brings_its_lessons(lab, mine):
    (mine / "own.md").write_text(text("Mine"), encoding="utf-8")
    found = Library([lab])
    assert found.add_folder(mine) == {"own"}
    assert found.add_folder(mine) == frozenset()
    assert found.lesson("own").file == "mine/own.md"
    (mine / "more.md").write_text(text("More"), encoding="utf-8")
    assert found.changed() == {"more"}


def test_no_lesson_replaces_one_there_is(lab, mine):
    (mine / "first.md").write_text(text("Mine"), encoding="utf-8")
    (mine / "own.md").write_text(text("Mine"), encoding="utf-8")
    (mine / "own").mkdir()
    (mine / "own" / "lesson.md").write_text(text("Mine, too"), encoding="utf-8")
    found = Library([lab])
    found.add_folder(mine)
    assert found.lesson("first").title == "First"
    assert problems(found) == [
        "mine/first.md: the lesson 'first' is there already, in first.md of the lab; rename this one",
        "mine/own.md: the lesson 'own' is there already, in mine/own/lesson.md; rename this one",
    ]


def test_what_is_no_folder(lab, mine):
    (mine / "x.md").write_text("x", encoding="utf-8")
    for path in (mine / "x.md", mine / "none"):
        with pytest.raises(InputError, match="expected a folder"):
            Library([lab]).add_folder(path)


def test_links_that_lead_out_are_refused(lab, mine, tmp_path):
    secret = tmp_path / "secret"
    secret.mkdir()
    (secret / "lesson.md").write_text(text("Secret", body="![x](a.png)"), encoding="utf-8")
    (secret / "a.png").write_bytes(PNG)
    (mine / "inside.md").write_text(text("Inside"), encoding="utf-8")
    (mine / "again.md").symlink_to("inside.md")
    (mine / "out.md").symlink_to(secret / "lesson.md")
    (mine / "around.md").symlink_to("../secret/lesson.md")
    (mine / "whole").symlink_to(secret, target_is_directory=True)
    (mine / "picture").mkdir()
    (mine / "picture" / "lesson.md").write_text(text(body="![x](a.png)"), encoding="utf-8")
    (mine / "picture" / "a.png").symlink_to(secret / "a.png")
    (mine / "loop.md").symlink_to("loop.md")
    found = Library([lab])
    assert found.add_folder(mine) == {"inside", "again", "out", "around", "picture"}
    assert set(found.lessons.lessons) == {"first", "inside", "again"}
    leads_out = "it leads out of the folder mine; put the file"
    assert [problem.split(": ")[0] for problem in problems(found)] == [
        "mine/around.md",
        "mine/out.md",
        "mine/picture/a.png",
        "mine/whole",
    ]
    assert all(leads_out in problem for problem in problems(found))


def test_too_much_is_refused(lab, mine, monkeypatch):
    (mine / "large.md").write_text(text() + "x" * MOST_TEXT, encoding="utf-8")
    (mine / "many").mkdir()
    (mine / "many" / "lesson.md").write_text(text(), encoding="utf-8")
    for i in range(MOST_PICTURES + 1):
        (mine / "many" / f"p{i}.png").write_bytes(PNG)
    found = Library([lab])
    found.add_folder(mine)
    assert problems(found) == [
        "mine/large.md: expected at most 1000 kB, got more",
        "mine/many/lesson.md: expected at most 20 pictures, got 21",
    ]
    monkeypatch.setattr("armlab.content.lesson_folder.MOST_LESSONS", 2)
    for key in "abc":
        (mine / f"{key}.md").write_text(text(), encoding="utf-8")
    assert found.changed() >= {"a", "b"}
    assert "mine/: expected at most 2 lessons, got 5; those from mine/c.md on are left out" in problems(found)
    assert set(found.lessons.lessons) == {"first", "a", "b"}
    assert MOST_LESSONS == 500


def test_a_harmful_drawing_is_refused(lab, mine):
    (mine / "draw").mkdir()
    (mine / "draw" / "lesson.md").write_text(text(body="![x](a.svg)"), encoding="utf-8")
    (mine / "draw" / "a.svg").write_text("<svg><script>alert(1)</script></svg>", encoding="utf-8")
    found = Library([lab])
    found.add_folder(mine)
    assert problems(found) == ["mine/draw/a.svg: the drawing has an element script; draw it without"]
    (mine / "draw" / "a.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>', encoding="utf-8")
    found.changed()
    assert '<img src="data:image/svg+xml;base64,' in found.lesson("draw").steps[0].html


def test_a_folder_that_is_taken_away_leaves_its_lessons_to_those_in_them(lab, mine):
    (mine / "own.md").write_text(text("Mine"), encoding="utf-8")
    found = Library([lab])
    found.add_folder(mine)
    (mine / "own.md").unlink()
    mine.rmdir()
    assert found.changed() == {"own"}
    assert found.lesson("own").title == "Mine"
    assert "own" not in found.lessons.lessons


def test_a_mistake_of_ours_is_a_problem_of_one_file(lab, monkeypatch, caplog):
    (lab / "second.md").write_text(text("Second"), encoding="utf-8")

    def fails(key, *rest):
        if key == "second":
            raise RuntimeError("ours")
        return real(key, *rest)

    real = module.parse_lesson
    monkeypatch.setattr(module, "parse_lesson", fails)
    found = Library([lab])
    assert set(found.lessons.lessons) == {"first"}
    assert problems(found) == ["second.md: cannot be used: RuntimeError('ours')"]
    assert "second.md cannot be read" in caplog.text
