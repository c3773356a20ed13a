"""The arm of a lesson: a table ``[arm]`` with the same fields as a robot file."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

from armlab.content.lesson_fields import Fields
from armlab.content.reader import shown
from armlab.content.robots import OWN, Robot, family_of, parse_robot
from armlab.errors import ContentError

_LEFT_OUT = {"family": "planar", "summary": "The arm of this lesson.", "source": "The lesson."}
"""Fields that a robot file requires and a lesson does not; the family is then determined from the table."""


def read_arm(top: Fields) -> Robot:
    """Take the table ``arm``.

    Raises
    ------
    ContentError
        As of a robot file; the keys begin with ``arm``.
    """
    given = top.value("arm")
    if not isinstance(given, dict):
        raise top.fail("arm", f"expected a table [arm] with name, convention and [[arm.joints]], got {shown(given)}")
    try:
        robot = parse_robot(OWN, toml({**_LEFT_OUT, **given}), top.file, proven=False)
    except ContentError as error:
        raise top.fail(f"arm.{error.key}" if error.key else "arm", error.problem) from None
    return robot if "family" in given else replace(robot, family=family_of(robot.arm))


def toml(table: dict[str, Any]) -> str:
    """Return a parsed TOML table as text, one line a key.

    >>> toml({"a": [1.0, {"b": "c"}]})
    '"a" = [1.0, {"b" = "c"}]'
    """
    return "\n".join(f"{_text(key)} = {_written(value)}" for key, value in table.items())


def _written(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list):
        return f"[{', '.join(map(_written, value))}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{_text(key)} = {_written(entry)}' for key, entry in value.items())}}}"
    return str(value)


def _text(text: str) -> str:
    """Return a basic string of TOML; it is escaped as in JSON, with DEL escaped as well."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
