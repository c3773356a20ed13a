"""``armlab lesson``: what authors of lessons need."""

from __future__ import annotations

from armlab.commands import CommandType, _lesson_check, _lesson_new, _lesson_sheet, _lesson_words

COMMAND = CommandType(
    "lesson",
    20,
    "For authors of lessons.",
    parts=(_lesson_new.PART, _lesson_check.PART, _lesson_sheet.PART, _lesson_words.PART),
)
