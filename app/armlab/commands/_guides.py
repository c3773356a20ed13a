"""Faults of the guides that lie beside courses: in their files, in their chapters, and links that lead nowhere."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources.abc import Traversable

from armlab.commands._links import leading_nowhere
from armlab.content.course import parse_course
from armlab.content.guidebook import guide_in
from armlab.content.lesson_folder import GUIDE, course_of
from armlab.content.lesson_lines import LessonError, line_of
from armlab.errors import ContentError


def mistakes_in_guide(folder: Traversable) -> Iterator[ContentError]:
    """Yield what is wrong with the guide of a folder, if it has one; mistakes in its course are told elsewhere."""
    source = course_of(folder)
    try:
        course = parse_course(source.key, source.read()[0], source.file) if source is not None else None
    except ContentError:
        course = None
    guide, text, problems = guide_in(folder, course)
    yield from problems
    if guide is None:
        return
    yield from (LessonError(GUIDE, "about", says, line_of(text, "about")) for says in leading_nowhere(guide.about))
    for i, written in enumerate(guide.chapters.values(), start=1):
        for key, texts in written._asdict().items():
            where = f"chapters[{i}].{key}"
            for j, each in enumerate(texts, start=1):
                for says in leading_nowhere(each):
                    yield LessonError(GUIDE, f"{where}[{j}]", says, line_of(text, where))
