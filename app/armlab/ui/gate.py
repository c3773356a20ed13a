"""The messages that a page may send to the lab. All others, which a stranger can send, are dropped before any use."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from typing import Any

log = logging.getLogger(__name__)

SAID = frozenset(
    {
        "CommandTriggerMessage",
        "GetRenderResponseMessage",
        "GuiUpdateMessage",
        "SceneNodeClickMessage",
        "ScenePointerMessage",
        "TransformControlsDragEndMessage",
        "TransformControlsDragStartMessage",
        "TransformControlsUpdateMessage",
        "ViewerCameraMessage",
    }
)
"""Messages that the lab's own page sends; viser knows more, for files, forms and public tunnels."""

FARTHEST = 1e6
"""Largest number in a message of the scene, such as a length in metres; with larger ones products would overflow."""

LEAST = 1e-6
"""Least value of the largest number of a direction."""

LONGEST_NAME = 200
"""Largest number of characters in the name of a node or a control."""

MOST_NUMBERS = 64
"""Largest number of numbers in one field of a message."""


VECTORS = {"position": 3, "look_at": 3, "up_direction": 3, "wxyz": 4}
"""Number of components of the vectors of a pose or a camera, by field."""

NUMBERS = frozenset({int, float})
"""Types of the numbers in a message that was read."""

DIRECTIONS = frozenset({"up_direction", "wxyz"})
"""Vectors that are invalid if all components are zero."""

POSITIVE = frozenset({"fov", "near", "far", "image_height", "image_width"})


class Gate:
    """A gate that checks each message of one connection, and logs the first one that it drops.

    Parameters
    ----------
    on_nonsense : callable, optional
        Called with each that it drops and that no page of the lab can have sent, whatever a hand has done on it.
    """

    def __init__(self, on_nonsense: Callable[[], None] = lambda: None) -> None:
        self.dropped = 0
        self._on_nonsense = on_nonsense

    def passes(self, kind: str, fields: Mapping[str, Any], value_now: Any) -> bool:
        """Return whether a message may go on.

        Parameters
        ----------
        kind : str
            Name of its type.
        fields : mapping
            What it says.
        value_now : object
            Of the control an update is for, None where there is none.
        """
        wrong = _wrong(kind, fields, value_now)
        if wrong:
            # A handle that is dragged to the horizon may be anywhere.
            self.drop(wrong, nonsense=kind not in SAID or kind == "GuiUpdateMessage")
        return not wrong

    def drop(self, why: str, nonsense: bool = False) -> None:
        """Count a dropped message; only the first one is logged."""
        self.dropped += 1
        if nonsense:
            self._on_nonsense()
        if self.dropped == 1:
            log.warning("a page that is not ours: %s; this and what follows of the kind is dropped", why[:200])


def _wrong(kind: str, fields: Mapping[str, Any], value_now: Any) -> str:
    """Return the fault of a message, or an empty text."""
    if kind not in SAID:
        return f"it sent {kind[:60]}"
    if kind == "GuiUpdateMessage":
        updates = fields.get("updates")
        if not isinstance(updates, dict) or set(updates) != {"value"}:
            return "it wants to change what a control is"
        return (
            "" if value_now is None or _fits(updates["value"], value_now) else "it gives a control what it cannot hold"
        )
    for name, value in fields.items():
        if not isinstance(value, bytes) and not _is_plain(value):
            return f"{kind} with a {name} that cannot be"
        if name in VECTORS and not _is_vector(value, VECTORS[name], name in DIRECTIONS):
            return f"{kind} with a {name} that is none"
        if name in POSITIVE and not (isinstance(value, (int, float)) and value > 0):
            return f"{kind} with a {name} that is not above zero"
    if "look_at" in fields and list(fields["look_at"]) == list(fields["position"]):
        return f"{kind} that looks nowhere"
    return ""


def _fits(value: Any, now: Any) -> bool:
    """Return whether a control that holds ``now`` can hold a value: the same kind, and as many components."""
    if isinstance(now, bool) or isinstance(value, bool):
        return isinstance(value, bool) and isinstance(now, bool)
    if isinstance(now, (int, float)):
        # However large: a person may have typed it, and is to see where it stops.
        return isinstance(value, (int, float)) and math.isfinite(value)
    if isinstance(now, str):
        return isinstance(value, str)
    if isinstance(now, tuple):
        alike = isinstance(value, (list, tuple)) and len(value) == len(now)
        return alike and all(_fits(one, held) for one, held in zip(value, now, strict=True))
    return False


def _is_vector(value: Any, length: int, is_direction: bool) -> bool:
    """Return whether a field is a list of the given length of numbers, and not all zero if it is a direction."""
    if not isinstance(value, (list, tuple)) or len(value) != length:
        return False
    return NUMBERS.issuperset(map(type, value)) and (not is_direction or max(map(abs, value)) > LEAST)


def _is_plain(value: Any) -> bool:
    """Return whether a field of a message of the scene is small and finite."""
    if type(value) in NUMBERS:
        return bool(-FARTHEST <= value <= FARTHEST)  # which what is no number is not
    if value is None or isinstance(value, bool):
        return True
    if isinstance(value, str):
        return len(value) <= LONGEST_NAME
    return isinstance(value, (list, tuple)) and len(value) <= MOST_NUMBERS and all(map(_is_plain, value))
