"""The start of a lesson as commands in its file: the benches as they are in a state, and nothing of the others."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from armlab.errors import InputError
from armlab.plugins import BENCHES
from armlab.session.arguments import WrongArgument, read_arguments
from armlab.session.fields import EXAMPLE, FieldPart, declarations
from armlab.session.parts.robot import RobotPart
from armlab.session.put_words import put_words
from armlab.session.state import Part, State, part_types
from armlab.session.words import words_of


def begun_as(state: State) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield words and their arguments that put the benches of a fresh state as those of a state are.

    Only of benches that differ from how they open with the arm on the table, and only the fields of these that differ
    where a bench can be put in place by its fields.
    """
    robot = state[RobotPart].robot
    for kind in part_types():
        page = ".".join(kind.__module__.removeprefix(f"{BENCHES}.").split(".")[:2])
        if not kind.__module__.startswith(f"{BENCHES}."):
            continue
        part, begun = state[kind], kind.initial(robot)
        saved = part.to_json()
        if saved == begun.to_json():
            continue
        word = next(name for name, each in put_words(page).items() if each is kind)
        fields = _fields(part, begun, state)
        by_fields = word.replace(".put", ".set")
        if fields and _puts(page, by_fields, fields, part, state):
            yield by_fields, fields
        else:
            yield word, {"saved": json.dumps(saved, ensure_ascii=False)}


def _fields(part: Part, begun: Part, state: State) -> dict[str, Any]:
    """Return the fields that differ as a file writes them; none where one of them cannot be written."""
    if not isinstance(part, FieldPart):
        return {}
    now, before = part.to_json(), begun.to_json()
    if not isinstance(now, Mapping) or not isinstance(before, Mapping):
        return {}
    # A bench that is set by its fields leaves the example that it was by itself.
    keys = {name: each.under for name, each in declarations(type(part)).items() if name != EXAMPLE}
    found = {name: now[key] for name, key in keys.items() if key in now and now[key] != before.get(key)}
    return found if all(_writable(value) for value in found.values()) else {}


def _writable(value: Any) -> bool:
    return all(map(_writable, value)) if isinstance(value, list) else isinstance(value, (bool, int, float, str))


def _puts(page: str, name: str, fields: Mapping[str, Any], part: Part, state: State) -> bool:
    """Return whether a word with these fields puts a part, as it opens, in place as it is."""
    known = words_of(page).get(name)
    if known is None:
        return False
    fresh = state.replace(type(part).initial(state[RobotPart].robot))
    try:
        made = known.make(**read_arguments(known.arguments, fields)).apply(fresh)
    except (InputError, WrongArgument):
        return False
    return bool(made[type(part)].to_json() == part.to_json())
