"""The guide to a course for its teacher as a page to print, chapter by chapter.

Goals, minutes and mistakes are made of the lessons; what to show, to set and to discuss is written by hand.
"""

from __future__ import annotations

from collections.abc import Sequence

from armlab.content.as_written import as_part
from armlab.content.course import Chapter, Course
from armlab.content.guide import NOTHING
from armlab.content.guidebook import Guidebook
from armlab.content.lesson_head import Head, time_said
from armlab.content.lesson_mistakes import Mistakes, Named
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.paper import address, document, text

MOST = 3
"""Largest number of mistakes of a lesson that are printed; the others are folded and seen on a screen only."""

LOOK = """
header ol { columns: 2 14em; column-gap: 2.6em; margin: .8em 0 0; padding-left: 1.8em; font-size: .92em; }
section { margin-top: 2.4em; }
section + section { break-before: page; }
section > div:first-child { display: flex; justify-content: space-between; gap: 1em; align-items: baseline; }
section > div:first-child { border-bottom: 1px solid var(--rule); }
h2 { font-size: 1.35em; }
h3 { font-size: 1em; margin: 1em 0 .2em; color: var(--mark); break-after: avoid; }
h3 small { margin-left: .5em; }
table { border-collapse: collapse; width: 100%; font-size: .92em; }
td { vertical-align: top; padding: .3em .6em .3em 0; border-top: 1px solid var(--line); }
td:last-child { padding-right: 0; }
tr { break-inside: avoid; }
td:first-child { width: 34%; }
td:nth-child(2) { white-space: nowrap; width: 4em; }
code { font-size: .85em; color: var(--dim); }
ul, main ol { margin: .2em 0; padding-left: 1.3em; }
li { margin: .15em 0; }
td ul { padding-left: 1em; }
.wrong { font-size: .92em; }
.wrong > p { margin-top: .5em; break-after: avoid; }
details { color: var(--dim); }
.problem { border: 2px solid #b03a00; border-radius: 4px; padding: .4em .8em; margin-top: .8em; }
@media print {
  details { display: none; }
  h3 { color: inherit; }
  .links a::after { content: " (" attr(href) ")"; font-size: .8em; color: var(--dim); }
}
"""
"""Rules of style besides those of all pages on paper."""


def guide_page(book: Guidebook, key: str = "") -> str | None:
    """Return the guide to a course as a document; None where there is no course with this key.

    Parameters
    ----------
    book : Guidebook
    key : str
        Empty for the first course.
    """
    course = next((each for each in book.outline.courses if key in ("", each.key)), None)
    if course is None:
        return None
    chapters = [_chapter(i, each, book, course) for i, each in enumerate(course.chapters, start=1)]
    return document(
        f"Guide to {as_part(course.title)}", LOOK, _head(book, course), tag("main", chapters), _others(book, course)
    )


def _head(book: Guidebook, course: Course) -> Markup:
    guide = book.guides.get(course.key)
    wrong = [tag("p.problem", f"{error}. The guide is shown as it was before.") for error in _problems(book, course)]
    links = [tag("li", tag("a", each.title, href=f"#{i}")) for i, each in enumerate(course.chapters, start=1)]
    return tag(
        "header",
        tag("h1", f"Guide to “{as_part(course.title)}”"),
        tag("p", "For teachers. ", text(guide.about)) if guide is not None and guide.about else None,
        tag("p.small.hint", "Ctrl+P prints this page, each chapter from a new sheet on. Titles open lessons."),
        wrong,
        tag("ol", links),
    )


def _problems(book: Guidebook, course: Course) -> list[str]:
    return [str(error).rstrip(".") for error in book.problems.get(course.key, ())]


def _chapter(number: int, chapter: Chapter, book: Guidebook, course: Course) -> Markup:
    heads = [book.outline.heads[key] for key in chapter.lessons]
    guide = book.guides.get(course.key)
    written = guide.chapters.get(chapter.title, NOTHING) if guide is not None else NOTHING
    named = [(head, book.mistakes.get(head.key, Named())) for head in heads]
    title = tag("div", tag("h2", f"{number} ", tag("span", chapter.title)), tag("span.small", _minutes(heads)))
    return tag(
        "section",
        title,
        tag("p.small", chapter.about) if chapter.about else None,
        tag("h3", "Goals"),
        tag("table", [_goals(head, found) for head, found in named]),
        _listed("On the projector", "ul.links", written.show),
        _mistakes(named),
        _listed("Homework", "ol.links", written.homework),
        _listed("For discussion", "ol.links", written.discuss),
        id=str(number),
    )


def _minutes(heads: Sequence[Head]) -> str:
    return time_said(sum(head.minutes for head in heads))


def _goals(head: Head, named: Named) -> Markup:
    """Return a lesson with its minutes, and what one can do afterwards."""
    variant = tag("a", "variant 1", href=f"/lesson/{head.key}/1")
    varies = tag("br"), tag("small", "own numbers for each: ", variant)
    title = tag("a", head.title, href=f"/lesson/{head.key}")
    can = tag("ul", [tag("li", sentence) for sentence in head.can])
    about = tag("td", title, tag("br"), tag("code", head.key), varies if named.varies else None)
    return tag("tr", about, tag("td", time_said(head.minutes)), tag("td", can))


def _listed(title: str, kind: str, texts: Sequence[str]) -> Inside:
    if not texts:
        return None
    return tag("h3", title), tag(kind, [tag("li", text(each)) for each in texts])


def _mistakes(named: Sequence[tuple[Head, Named]]) -> Inside:
    """Return the mistakes of the lessons of a chapter: of each those printed, and the others folded."""
    count = sum(len(step.says) for _, found in named for step in found.steps)
    if not count:
        return None
    told = tag("small", f"{count} are named by the lessons, in these words")
    return tag("h3", "What students get wrong", told), [_of_lesson(*each) for each in named if each[1].steps]


def _of_lesson(head: Head, named: Named) -> Markup:
    chosen = printed(named.steps)
    said = [_said(step.step, step.says[:1]) for step in chosen]
    rest = [_said(step.step, step.says[1:] if step in chosen else step.says) for step in named.steps]
    count = sum(len(step.says) for step in named.steps) - len(chosen)
    more = tag("details", tag("summary", f"{count} more"), tag("ul", rest)) if count else None
    return tag("div.wrong", tag("p", tag("b", head.title)), tag("ul", said), more)


def printed(steps: Sequence[Mistakes]) -> list[Mistakes]:
    """Return the steps whose first mistake is printed: those that name most, in the order of the lesson."""
    most = sorted(steps, key=lambda step: -len(step.says))[:MOST]
    return [step for step in steps if step in most]


def _said(step: str, says: Sequence[str]) -> Inside:
    title = step if step.endswith(("?", "!")) else f"{as_part(step)}:"
    return [tag("li", tag("i", title), " ", text(each)) for each in says]


def _others(book: Guidebook, course: Course) -> Markup:
    """Return links to what else there is on paper."""
    others = [each for each in book.outline.courses if each is not course]
    links = [("The course, for students", address("course", course.key))]
    links += [("Formulas on two pages", address("formulas"))]
    links += [(f"Guide to {as_part(each.title)}", address("guide", each.key)) for each in others]
    return tag(
        "nav", tag("p", "More on paper:"), tag("ul", [tag("li", tag("a", title, href=to)) for title, to in links])
    )
