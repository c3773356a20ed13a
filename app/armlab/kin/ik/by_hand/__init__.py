"""Closed forms worked by hand: every step with its equation, present numbers, branches and geometry."""

from armlab.kin.ik.by_hand.derive import derived, every_derivation, method_of, why_not
from armlab.kin.ik.by_hand.step import (
    Arc,
    Branch,
    Circle,
    Derivation,
    Line,
    Point,
    Quantity,
    Segment,
    Shape,
    Step,
    Triangle,
    Worked,
)

__all__ = [
    "Arc",
    "Branch",
    "Circle",
    "Derivation",
    "Line",
    "Point",
    "Quantity",
    "Segment",
    "Shape",
    "Step",
    "Triangle",
    "Worked",
    "derived",
    "every_derivation",
    "method_of",
    "why_not",
]
