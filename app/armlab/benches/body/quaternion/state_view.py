"""Choices of the page of quaternions: the view, and the way from one orientation to another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.session.fields import FieldPart, choice, flag
from armlab.session.state import PartType

WAY_KEY = "quaternion_way"
"""Key of the film of the way."""

SHOWN = {"cover": "1 q and −q", "algebra": "2 Algebra", "matrix": "3 From R", "way": "4 Slerp"}

WAYS = {"slerp": "slerp", "line": "lerp", "euler": "Euler angles"}


@dataclass(frozen=True)
class QuaternionView(FieldPart):
    """Choices of the page.

    Attributes
    ----------
    shown : "cover", "algebra", "matrix" or "way"
    way : "slerp", "line" or "euler"
        By which the body goes from the second quaternion p to that of the body, q.
    shorter : bool
        Whether to that of q and -q which is nearer to p.
    """

    key: ClassVar[str] = "quaternion_view"
    looks: ClassVar[tuple[str, ...]] = ("shown", "way")

    shown: str = choice("what is shown of quaternions", "cover", SHOWN)
    way: str = choice("way between two orientations", "slerp", WAYS)
    shorter: bool = flag("shorter way", True)


PART = PartType(QuaternionView, order=39)
