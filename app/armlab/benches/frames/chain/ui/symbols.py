"""Names of transforms and points as markup: indices at their corners, and names that cancel struck out."""

from __future__ import annotations

from collections.abc import Sequence

from armlab.benches.frames.chain.state import WORLD
from armlab.benches.frames.chain.tree import Step
from armlab.ui.html import Inside, Markup, joined, tag


def called(name: str) -> str:
    """Return a frame in a sentence: its name, or the world."""
    return "the world" if name == WORLD else name


def transform_name(reference: Inside, frame: Inside, letter: str = "T") -> Markup:
    """Return the name of the pose of a frame in a reference."""
    return tag("span.fr-name", tag("sup", reference), letter, tag("sub", frame))


def point_name(frame: Inside, letter: str = "p") -> Markup:
    """Return the name of a point in a frame."""
    return tag("span.fr-name", tag("sup", frame), letter)


def product(steps: Sequence[Step]) -> Markup:
    """Return the factors from the left; each name that stands below in one and above in the next is struck out."""
    last = len(steps) - 1
    return joined(
        [
            transform_name(
                tag("s", step.reference) if k > 0 else step.reference, tag("s", step.frame) if k < last else step.frame
            )
            for k, step in enumerate(steps)
        ],
        between=" ",
    )
