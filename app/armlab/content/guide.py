"""The guide to a course for its teacher, as it is written by hand: what to show, to set and to discuss in each chapter.

Goals, minutes and mistakes are not written here: they are made of the lessons.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from armlab.content.course import Course
from armlab.content.lesson_fields import Fields
from armlab.content.lesson_lines import LessonError, line_of, located
from armlab.content.markdown import to_html
from armlab.content.reader import Table
from armlab.errors import suggestion


class Written(NamedTuple):
    """Texts of a chapter, as HTML.

    Attributes
    ----------
    show : tuple of str
        What to show on the projector.
    homework, discuss : tuple of str
        What to set, and questions for discussion.
    """

    show: tuple[str, ...] = ()
    homework: tuple[str, ...] = ()
    discuss: tuple[str, ...] = ()


NOTHING = Written()


@dataclass(frozen=True)
class Guide:
    """A guide.

    Attributes
    ----------
    about : str
        HTML that stands before the chapters; empty for none.
    chapters : mapping of str to Written
        By the title of the chapter in the course.
    """

    about: str
    chapters: MappingProxyType[str, Written]


def parse_guide(text: str, file: str, own: bool = False) -> Guide:
    """Read the text of a guide.

    Parameters
    ----------
    text : str
    file : str
        Its name in messages.
    own : bool
        Whether it is a teacher's own, which is not translated.

    Raises
    ------
    LessonError
        It is no TOML, a key is missing or unknown, a text cannot be converted, or a chapter is there twice.
    """
    with located(file, "", text, 1):
        top = Table.parse(file, text)
        about = top.text("about", "")
        tables = top.tables("chapters")
        top.done()
        if not tables:
            raise top.fail("chapters", "expected at least one chapter, a table [[chapters]] with its title")
        chapters: dict[str, Written] = {}
        for table in tables:
            title, written = _chapter(Fields.of(table), own)
            if title in chapters:
                raise table.fail("title", f"the chapter {title!r} is there already; write all of it in one place")
            chapters[title] = written
        return Guide(to_html(about, file, "about", own) if about else "", MappingProxyType(chapters))


def _chapter(fields: Fields, own: bool) -> tuple[str, Written]:
    title = fields.text("title")
    written = Written(*(_texts(fields, key, own) for key in Written._fields))
    fields.done()
    if written == NOTHING:
        raise fields.fail("title", "nothing is written of this chapter; expected some of show, homework and discuss")
    return title, written


def _texts(fields: Fields, key: str, own: bool) -> tuple[str, ...]:
    given = fields.words(key)
    return tuple(to_html(text, fields.file, f"{fields.where}.{key}[{i}]", own) for i, text in enumerate(given, start=1))


def strange(guide: Guide, course: Course, text: str, file: str) -> Iterator[LessonError]:
    """Yield the chapters of a guide that the course does not have; ``text`` and ``file`` are those of the guide."""
    titles: list[str] = [chapter.title for chapter in course.chapters]
    for i, title in enumerate(guide.chapters, start=1):
        if title not in titles:
            where = f"chapters[{i}].title"
            problem = f"the course has no chapter {title!r}{suggestion(title, titles)}"
            yield LessonError(file, where, problem, line_of(text, where) or 1)
