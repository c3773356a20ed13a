"""Questions on errata: the correct form of what the course notes print, with the answer and mistakes of its task."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from armlab.content.question import Asked, Question, QuestionType, ToHtml
from armlab.content.reader import Table
from armlab.errors import suggestion


def read(table: Table, asked: Asked, to_html: ToHtml) -> Question:
    """Read ``erratum``, the id of one that has a task; the lesson has the text of its own."""
    from armlab.content.errata_task import task_of, with_tasks  # which reads questions itself

    del to_html
    key = table.text("erratum")
    if key not in with_tasks():
        raise table.fail("erratum", f"unknown erratum with a task {key!r}{suggestion(key, with_tasks())}")
    question: Any = task_of(key).question
    return cast(Question, replace(question, html=asked.html, hide=asked.hide))


QUESTION = QuestionType("erratum", 50, read)
