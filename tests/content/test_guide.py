"""The guide to a course: its file with every mistake, and the guide to the course of the lab itself."""

import pytest

from armlab import resources
from armlab.commands._guides import mistakes_in_guide
from armlab.content.guide import parse_guide
from armlab.content.guidebook import Guidebooks
from armlab.content.lesson_lines import LessonError
from armlab.content.lesson_mistakes import Mistakes, mistakes_of
from armlab.content.lessons import lessons
from armlab.window.guide_page import MOST, printed
from support.own_lessons import ARM, lesson, write

GUIDE = """about = "A word."

[[chapters]]
title = "One"
show = ["Show [it](/robot/planar_2r)."]
homework = [
    "Set it.",
    'And $q_1$.',
]

[[chapters]]
title = "Two"
discuss = ["Why?"]
"""

COURSE = """title = "My course"
[[chapters]]
title = "One"
lessons = ["own"]
[[chapters]]
title = "Two"
lessons = ["ik_2r"]
"""


@pytest.fixture(scope="module")
def book():
    return Guidebooks([resources.folder("lessons")]).look()


# --- The guide of the lab


def test_every_chapter_of_the_lab_has_all_that_a_teacher_needs(book):
    (course,) = book.outline.courses
    guide = book.guides[course.key]
    assert book.problems == {}
    assert list(guide.chapters) == [chapter.title for chapter in course.chapters], "in the order of the course"
    for title, written in guide.chapters.items():
        assert len(written.show) >= 3, title
        assert len(written.homework) >= 2, title
        assert len(written.discuss) >= 3, title
        assert all('href="/' in each for each in written.show), f"{title}: each thing to show has its link"


def test_every_link_of_the_guide_leads_somewhere():
    assert [str(each) for each in mistakes_in_guide(resources.folder("lessons"))] == []


def test_homework_is_in_lessons_of_its_chapter_and_each_lesson_names_mistakes(book):
    (course,) = book.outline.courses
    for chapter in course.chapters:
        homework = "".join(book.guides[course.key].chapters[chapter.title].homework)
        assert any(f'href="/lesson/{key}"' in homework for key in chapter.lessons), chapter.title
    assert [key for key in course.lessons if not book.mistakes[key].steps] == []


def test_mistakes_are_those_of_the_whole_lesson(book):
    """The guide reads them by itself, since reading all lessons takes seconds."""
    for key in ("ik_2r", "rotation_matrix", "dc_motor"):
        found = lessons().lessons[key]
        assert book.mistakes[key].varies == found.varies
        for step in found.steps:
            asked = [*(step.check.wrong if step.check else ()), *(step.question.wrong if step.question else ())]
            told = [each.says.strip() for each in asked]
            named = [each.says for each in book.mistakes[key].steps if each.step == step.title]
            live = any("data-live" in each for each in told)
            assert live or sorted(sum(named, ())) == sorted(set(told)), (key, step.title)


def test_printed_are_the_steps_that_name_most_in_the_order_of_the_lesson(book):
    steps = book.mistakes["ik_2r"].steps
    chosen = printed(steps)
    assert len(chosen) == MOST < len(steps)
    assert chosen == [step for step in steps if step in chosen]
    assert min(len(step.says) for step in chosen) >= max(len(step.says) for step in steps if step not in chosen)


# --- The file


def test_what_a_guide_holds():
    guide = parse_guide(GUIDE, "guide.toml")
    assert guide.about == "<p>A word.</p>\n"
    assert list(guide.chapters) == ["One", "Two"]
    one, two = guide.chapters.values()
    assert one.show == ('<p>Show <a href="/robot/planar_2r">it</a>.</p>\n',)
    assert "<math" in one.homework[1]
    assert (two.show, two.homework, two.discuss) == ((), (), ("<p>Why?</p>\n",))


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ('about = "A word."', "about = = 1", 1, "not valid TOML"),
        ('about = "A word."', 'abuot = "A word."', 1, "abuot: unknown key; did you mean 'about'?"),
        ('title = "Two"', 'title = "One"', 12, r"chapters\[2\].title: the chapter 'One' is there already"),
        (
            'discuss = ["Why?"]',
            "",
            12,
            r"chapters\[2\].title: nothing is written of this chapter; expected some of show",
        ),
        ('discuss = ["Why?"]', 'discuss = "Why?"', 13, r"chapters\[2\].discuss: expected a list of texts, got 'Why"),
        ('discuss = ["Why?"]', 'ask = ["Why?"]', 13, r"chapters\[2\].ask: unknown key"),
        ("$q_1$", r"$\foo$", 6, r"chapters\[1\].homework\[2\]: the formula"),
        (GUIDE[GUIDE.index("[[chapters]]") :], "", 1, "chapters: expected at least one chapter"),
    ],
)
def test_a_mistake_in_the_file_has_its_line(old, new, line, says):
    assert old in GUIDE
    with pytest.raises(LessonError, match=rf"^mine/guide\.toml, line {line}: {says}"):
        parse_guide(GUIDE.replace(old, new), "mine/guide.toml")


def test_chapters_and_links_that_are_not_there_have_their_lines(tmp_path):
    write(tmp_path, own=lesson())
    (tmp_path / "guide.toml").write_text(GUIDE, encoding="utf-8")
    assert [str(each) for each in mistakes_in_guide(tmp_path)] == [
        "guide.toml: a guide follows the chapters of a course; put course.toml beside it"
    ]
    (tmp_path / "course.toml").write_text(COURSE, encoding="utf-8")
    assert list(mistakes_in_guide(tmp_path)) == []
    wrong = GUIDE.replace('"Two"', '"Three"').replace("/robot/planar_2r", "/robot/planar_22r")
    wrong = wrong.replace("Why?", "[Why](/page/gone) or [why](/gone/1) or [not](/example/laws/triangle)?")
    (tmp_path / "guide.toml").write_text(wrong, encoding="utf-8")
    told = [str(each) for each in mistakes_in_guide(tmp_path)]
    assert told[0].startswith("guide.toml, line 12: chapters[2].title: the course has no chapter 'Three'")
    assert told[1].startswith(
        "guide.toml, line 5: chapters[1].show[1]: link: unknown robot 'planar_22r'; did you mean 'planar_2r'?"
    )
    assert told[2].startswith("guide.toml, line 13: chapters[2].discuss[1]: link: unknown page 'gone'")
    assert told[3].startswith("guide.toml, line 13: chapters[2].discuss[1]: link: unknown place 'gone' of the lab")
    assert len(told) == 4


def test_titles_and_mistakes_have_the_values_of_the_lesson():
    step = '## Reach {{=m}} m\n\n```question\nkind = "number"\ntext = "?"\n[[wrong]]\nsays = "Not {{=m}}."\n```\n'
    found = mistakes_of("own", lesson(step, ARM + "[variants]\nm = { choose = [3] }\n"), "own.md")
    assert found.steps == (Mistakes("Reach 3 m", ("<p>Not 3.</p>",)),)


def test_a_broken_lesson_says_where_its_words_are_wrong():
    broken = lesson(body='## One\n\n```question\nkind = "number"\ntext = "?"\n[[wrong]]\nsays = "{{=m}}"\n```\n')
    with pytest.raises(Exception, match=r"wrong\[1\]\.says.*unknown"):
        mistakes_of("own", broken, "own.md")
