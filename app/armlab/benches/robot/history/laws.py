"""Asimov's three laws as a rule of decision: which law says what a robot has to do in a situation."""

from __future__ import annotations

from typing import NamedTuple

LAWS = {
    1: "A robot harms no human being, nor lets one come to harm by doing nothing.",
    2: "It obeys the orders of human beings, unless the first law is against it.",
    3: "It protects itself, unless one of the others is against it.",
}
"""The laws in short, by number."""

SIGNS: dict[str, tuple[int, int]] = {
    "harms": (1, -1),
    "saves": (1, 1),
    "ordered": (2, 1),
    "forbidden": (2, -1),
    "risks": (3, -1),
    "protects": (3, 1),
}
"""Signs of an action: the law that it concerns, and whether it speaks for (1) or against (-1) the action."""

FLAGS = {
    "harms": "harms a person",
    "saves": "saves a person",
    "ordered": "is ordered",
    "forbidden": "is forbidden",
    "risks": "damages the robot",
    "protects": "saves the robot",
}
"""The same in words, which continue "the action"."""

DECISIONS = {
    "act": "it has to do it",
    "refrain": "it must not do it",
    "free": "it may do it or not",
    "conflict": "the laws give no answer",
}
"""Kinds of decisions, in words."""


class Decision(NamedTuple):
    """Answer of the laws about an action.

    Attributes
    ----------
    kind : str
        ``"act"``, ``"refrain"``, ``"free"`` where no law says anything, ``"conflict"`` where one law says both.
    law : int
        The law that decides, or is in conflict with itself; 0 for none.
    """

    kind: str
    law: int


def decide(holds: frozenset[str]) -> Decision:
    """Return what the laws say of an action of which some of `SIGNS` hold: the first law that speaks decides."""
    for law in LAWS:
        votes = {sign for flag, (of, sign) in SIGNS.items() if of == law and flag in holds}
        if len(votes) == 2:
            return Decision("conflict", law)
        if votes:
            return Decision("act" if votes == {1} else "refrain", law)
    return Decision("free", 0)
