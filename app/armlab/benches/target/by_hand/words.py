"""How the solutions of an arm are found, in words."""

from __future__ import annotations

from typing import NamedTuple

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand import method_of, why_not
from armlab.kin.ik.closed_form import closed_form_of, known_structure


class MethodWords(NamedTuple):
    """How the solutions of an arm are found, in words.

    Attributes
    ----------
    title, why : str
    instead : str
        Where to look when there is no derivation to be shown; empty where there is one.
    """

    title: str
    why: str
    instead: str


def method_words(arm: Arm) -> MethodWords:
    """Return in words how the solutions of an arm are found, and where to see them."""
    form, structure, worked = closed_form_of(arm), known_structure(arm), method_of(arm)
    if worked is not None:
        return MethodWords(worked.title, form[1] if form is not None else structure.why, "")
    there = "See the page Solutions for all of them, and Iterate for how one is found step by step."
    if form is not None:
        return MethodWords(form[0].title, why_not(arm), there)
    if structure.key == "srs" and structure.free == 1:
        return MethodWords(structure.title, why_not(arm), "The page Solutions lists families, which a search finds.")
    how = "The solutions form families: a search finds them." if structure.free else "All are found by elimination."
    if not structure.free and (arm.n != 6 or not bool(arm.revolute.all())):
        how = "They are found by a search from random starts."
    return MethodWords("No closed form by hand", why_not(arm), f"{how} {there}")
