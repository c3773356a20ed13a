"""The lines of the closed form at the present target, and words for an arm that has none."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import DerivationStep, closed_form_of, known_structure
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import target_pose
from armlab.session.state import State


class MethodWords(NamedTuple):
    """How the solutions of an arm are found, in words.

    Attributes
    ----------
    title, why : str
    instead : str
        Where to look when there is no derivation to be shown.
    """

    title: str
    why: str
    instead: str


def derivation(state: State) -> tuple[DerivationStep, ...]:
    """Return the lines at the present target, or none if no derivation is written for the arm."""
    arm = state[Joints].arm
    form = closed_form_of(arm)
    if form is None or form[0].steps is None:
        return ()
    return form[0].steps(arm, np.asarray(inverse(arm.base) @ target_pose(state), dtype=np.float64))


def failing(lines: Sequence[DerivationStep]) -> int | None:
    """Return the first line, 0-based, with a quantity that has no value at all, or None if every line has one."""
    for k, line in enumerate(lines):
        if any(not any(math.isfinite(value) for value in values) for values in line.numbers.values()):
            return k
    return None


def ways_of(state: State) -> int:
    """Return the number of placements of a spherical wrist at the present target; 0 for other closed forms."""
    form, lines = closed_form_of(state[Joints].arm), state.derived(derivation)
    if form is None or form[0].key != "spherical_wrist" or len(lines) < 2:
        return 0
    return max((len(values) for values in lines[1].numbers.values()), default=0)


def method_words(arm: Arm) -> MethodWords:
    """Return in words how the solutions of an arm are found, and where to see them."""
    form, structure = closed_form_of(arm), known_structure(arm)
    there = "See the page Solutions for all of them, and Iterate for how one is found step by step."
    if form is not None and form[0].steps is not None:
        return MethodWords(form[0].title, form[1], f"Its offsets are not in the derivation of the notes. {there}")
    if form is not None:
        return MethodWords(form[0].title, form[1], f"Its closed form is not worked line by line here. {there}")
    how = "The solutions form families: a search finds them." if structure.free else "All are found by elimination."
    if not structure.free and (arm.n != 6 or not bool(arm.revolute.all())):
        how = "They are found by a search from random starts."
    return MethodWords("No derivation by hand", structure.why, f"{how} {there}")
