"""A course in another order: lessons moved, left out and put in, and the sentence about what stands too early."""

import pytest

from armlab.benches.lessons.course_order import course_text, left_out, mistakes, moved, put_back
from armlab.content.course import Chapter, Course, parse_course
from armlab.content.lessons import lessons
from armlab.errors import InputError

COURSE = Course("", 'A "course" \\ of\x7fmine', "", (Chapter("One", "About.", ("a", "b")), Chapter("Two", "", ("c",))))


def order(course):
    return [chapter.lessons for chapter in course.chapters]


@pytest.mark.parametrize(
    ("key", "by", "then"),
    [
        ("a", -1, [("a", "b"), ("c",)]),
        ("a", 1, [("b", "a"), ("c",)]),
        ("b", 1, [("a",), ("b", "c")]),
        ("c", -1, [("a", "b", "c")]),
        ("c", 1, [("a", "b"), ("c",)]),
    ],
)
def test_a_lesson_is_moved_by_one_place_also_into_the_next_chapter(key, by, then):
    assert order(moved(COURSE, key, by)) == then


def test_every_order_can_be_reached_and_is_written_as_it_is():
    course = moved(moved(left_out(COURSE, "b"), "c", -1), "c", -1)
    assert order(course) == [("c", "a")]
    assert order(put_back(course, "b")) == [("c", "a", "b")]
    for each in (COURSE, course, lessons().course("lab")):
        assert parse_course(each.key, course_text(each), "course.toml") == each
    with pytest.raises(InputError, match="at least one lesson"):
        left_out(left_out(course, "a"), "c")
    with pytest.raises(InputError, match="no lesson 'z'"):
        moved(course, "z", 1)


def test_what_stands_before_what_it_needs_or_is_not_there_is_told_with_its_line():
    told = [str(each) for each in mistakes(moved(COURSE, "a", 1), {"a", "b"}, {"b": ("a",)})]
    assert told == [
        "course.toml, line 7: chapters[1].lessons[1]: the lesson 'b' stands before 'a', which it needs; "
        "put it behind that one",
        "course.toml, line 14: chapters[2].lessons[1]: unknown lesson 'c'. Available: a, b",
    ]
    assert mistakes(COURSE, {"a", "b", "c"}, {"b": ("a",)}) == []
