"""The course as a page to print, with a box to tick for each lesson."""

from __future__ import annotations

from collections.abc import Sequence

from armlab.content.as_written import as_part
from armlab.content.course import Chapter, Course
from armlab.content.languages import ENGLISH, only_english
from armlab.content.lesson_head import Head, time_said
from armlab.content.outline import Outline
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.paper import address, document

LOOK = """
header > div { display: flex; gap: 2em; margin-top: 1.2em; }
header > div span { flex: 1; border-bottom: 1px solid var(--rule); color: var(--dim); }
section { margin-top: 1.6em; }
section > div { display: flex; justify-content: space-between; gap: 1em; align-items: baseline; break-after: avoid; }
section > p { break-after: avoid; }
ol { list-style: none; margin: .4em 0 0; padding: 0; }
ol > li { display: grid; grid-template-columns: 1.7em 1fr 4.2em; padding: .35em 0; border-top: 1px solid var(--line); }
ol > li { break-inside: avoid; }
ol > li > i { box-sizing: border-box; width: 1em; height: 1em; margin-top: .2em; }
ol > li > i { border: 1.3px solid var(--ink); border-radius: 2px; }
ol > li > span { text-align: right; white-space: nowrap; }
.in { margin: 0 .7em 0 .5em; }
ul { margin: .1em 0 0; padding: 0 0 0 1.1em; opacity: .85; font-size: .88em; }
"""
"""Rules of style besides those of all pages on paper."""


def course_page(outline: Outline, key: str = "", language: str = ENGLISH) -> str | None:
    """Return the page of a course as a document; None where there is no course with this key.

    Parameters
    ----------
    outline : Outline
    key : str
        Empty for the first course.
    language : str
        Key of that in which it will be read.
    """
    course = next((each for each in outline.courses if key in ("", each.key)), None)
    if course is None:
        return None
    chapters = [_chapter(each, outline, course, language) for each in course.chapters]
    others = [_chapter(each, outline, course, language) for each in outline.others]
    more = (tag("section", tag("div", tag("h2", "More lessons"))), others) if others else None
    return document(course.title, LOOK, _head(course, outline), chapters, more, _others(course, outline))


def _head(course: Course, outline: Outline) -> Markup:
    count = len(course.lessons)
    minutes = time_said(sum(outline.heads[key].minutes for key in course.lessons))
    told = ", ".join(filter(None, (so_many(count, "lesson"), minutes)))
    about = tag("p", course.about) if course.about else None
    hint = tag("p.small.hint", "Ctrl+P prints this page. A title opens its lesson.")
    name = tag("div", tag("span", "Name"), tag("span", "Date"))
    return tag("header", tag("h1", course.title), about, tag("p.small", told), hint, name)


def _chapter(chapter: Chapter, outline: Outline, course: Course, language: str) -> Markup:
    heads = [outline.heads[key] for key in chapter.lessons]
    minutes = time_said(sum(head.minutes for head in heads))
    about = tag("p.small", chapter.about) if chapter.about else None
    lessons = [_lesson(head, _needed(head, outline, course), language) for head in heads]
    title = tag("div", tag("h2", chapter.title), tag("span.small", minutes))
    return tag("section", title, about, tag("ol", lessons))


def _needed(head: Head, outline: Outline, course: Course) -> list[str]:
    """Return the titles of the lessons of the course that a lesson needs."""
    return [as_part(outline.heads[key].title) for key in outline.needs[head.key] if key in course.chapter_of]


def _lesson(head: Head, needed: Sequence[str], language: str) -> Markup:
    can: Inside = tag("ul", [tag("li", sentence) for sentence in head.can]) if head.can else None
    after = tag("small", f" after: {' · '.join(needed)}") if needed else None
    title = tag("b", tag("a", head.title, href=f"/lesson/{head.key}"))
    english = tag("small.in", "in English") if only_english(head, language) else None
    said = tag("div", title, english, after, can)
    return tag("li", tag("i"), said, tag("span", time_said(head.minutes)))


def _others(course: Course, outline: Outline) -> Markup | None:
    """Return links to the other courses."""
    others = [each for each in outline.courses if each is not course]
    links = [tag("li", tag("a", each.title, href=address("course", each.key))) for each in others]
    return tag("nav", tag("p", "Other courses:"), tag("ul", links)) if links else None
