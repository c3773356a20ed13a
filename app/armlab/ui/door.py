"""The door between the lab and one page that speaks another language: what passes it is said in that language.

Only messages are changed. The lab's own record of its controls stays English, so that whoever compares compares
English; an option that the student chooses is said back in English.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from typing import Any

from armlab.ui.speech import Speech


class Door:
    """The door of one page. `out` and `back` are called on the event loop only.

    Parameters
    ----------
    speech : Speech
    """

    def __init__(self, speech: Speech) -> None:
        self._speech = speech
        self._options: dict[str, dict[str, str]] = {}  # of each choice: what an option is called here, in English

    def out(self, message: Any) -> Any:
        """Return a message to the page with its texts in the language; the same one where it has none."""
        props, updates = getattr(message, "props", None), getattr(message, "updates", None)
        if props is not None:
            given = {name: value for name in _SAID if (value := getattr(props, name, None))}
            changed = self._changed(given)
            value = self._chosen(message.uuid, given["options"], message.value) if "options" in given else None
            message = _with(message, props=_with(props, **changed)) if changed else message
            return message if value is None else _with(message, value=value)
        if updates is not None:
            changed = self._changed({name: value for name, value in updates.items() if name in _SAID and value})
            known = self._options.get(getattr(message, "uuid", ""))
            if known and "value" in updates:
                here = {english: said for said, english in known.items()}
                changed["value"] = here.get(updates["value"], updates["value"])
            return _with(message, updates={**updates, **changed}) if changed else message
        return _with(message, title=self._speech.text(message.title)) if hasattr(message, "title") else message

    def back(self, message: Any) -> Any:
        """Return a message of the page with a chosen option in English."""
        uuid, updates = getattr(message, "uuid", ""), getattr(message, "updates", None)
        known = self._options.get(uuid) if isinstance(uuid, str) else None
        if not known or not isinstance(updates, dict) or not isinstance(updates.get("value"), str):
            return message
        return _with(message, updates={**updates, "value": known.get(updates["value"], updates["value"])})

    def _changed(self, texts: dict[str, Any]) -> dict[str, Any]:
        """Return the properties that are others in the language."""
        said = {name: _SAID[name](self._speech, value) for name, value in texts.items()}
        return {name: value for name, value in said.items() if value != texts[name]}

    def _chosen(self, uuid: str, options: tuple[str, ...], value: str) -> str:
        """Keep what the options of a choice are called, and return the chosen one."""
        self._options[uuid] = {self._speech.text(each): each for each in options}
        return self._speech.text(value)


def _with(message: Any, **fields: Any) -> Any:
    """Return a copy with other fields; `dataclasses.replace` would forget whose page a node of the scene is on."""
    found = copy(message)
    for name, value in fields.items():
        setattr(found, name, value)
    return found


def _all(speech: Speech, texts: Any) -> Any:
    return tuple(speech.text(each) for each in texts)


def _labelled(speech: Speech, of: Any) -> Any:
    """Return the axes or curves of a plot with their labels."""
    return tuple({**each, "label": speech.text(each["label"])} if each.get("label") else each for each in of)


_SAID: dict[str, Callable[[Speech, Any], Any]] = {
    "content": Speech.markup,
    **dict.fromkeys(("label", "hint", "text", "title", "body"), Speech.text),
    **dict.fromkeys(("options", "_tab_labels"), _all),
    **dict.fromkeys(("axes", "series"), _labelled),
}
"""The properties of messages that a person reads, and how each is said."""
