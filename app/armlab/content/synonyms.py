"""Words of the field that mean the same to whoever looks for something."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache

from armlab.content.languages import ENGLISH, words_in

GROUPS: tuple[tuple[str, ...], ...] = (
    ("arm", "robot", "manipulator"),
    ("approach", "orientation"),
    ("colour", "color"),
    ("csv", "spreadsheet", "excel"),
    ("damping", "dls", "levenberg", "damped least squares"),
    ("dark", "night"),
    ("envelope", "workspace", "reach"),
    ("export", "download", "save"),
    ("fast", "speed", "velocity"),
    ("fk", "forward kinematics", "direct kinematics"),
    ("force", "wrench"),
    ("gripper", "hand", "tool", "tcp", "effector", "flange"),
    ("ik", "inverse kinematics"),
    ("import", "upload", "load"),
    ("jog", "move"),
    ("kernel", "nullspace", "null-space", "self-motion"),
    ("lambda", "damping"),
    ("manipulability", "dexterity", "yoshikawa"),
    ("motion", "trajectory", "movement"),
    ("path", "trajectory"),
    ("pinv", "pseudoinverse", "pseudo-inverse"),
    ("profile", "law"),
    ("qp", "least squares"),
    ("redundant", "redundancy"),
    ("rpy", "roll pitch yaw", "yaw"),
    ("rotate", "rotation", "turn"),
    ("screenshot", "image", "photo"),
    ("share", "link", "url"),
    ("singular", "singularity", "singularities", "det", "determinant"),
    ("solution", "branch", "configuration", "posture"),
    ("svd", "singular value decomposition"),
    ("task", "exercise", "homework"),
    ("teacher", "instructor", "lecturer"),
    ("torque", "moment"),
    ("trapezoid", "trapezoidal", "lspb"),
    ("waypoint", "via point"),
    ("zoom", "camera"),
)
"""Groups of synonyms, in lower case. Only single words are looked for; what they stand for may be several words.

Those of another language are the translations of the groups, each as a list in one text."""


@cache
def _others(language: str) -> Mapping[str, tuple[str, ...]]:
    """Return the words that have synonyms in a language or in English, with these."""
    words = words_in(language)
    lists = dict.fromkeys((*GROUPS, *(tuple(words(", ".join(group)).split(", ")) for group in GROUPS)))
    found: dict[str, dict[str, None]] = {}
    for group in lists:
        for word in group:
            if " " not in word:
                found.setdefault(word.replace("-", ""), {}).update(
                    dict.fromkeys(each for each in group if each != word)
                )
    return {word: tuple(others) for word, others in found.items()}


def synonyms(forms: Iterable[str], language: str = ENGLISH) -> tuple[str, ...]:
    """Return the words, and rows of words, that mean the same as one of some forms of a word.

    >>> synonyms(["ik"])
    ('inverse kinematics',)
    """
    known = _others(language)
    return tuple(dict.fromkeys(other for form in forms for other in known.get(form, ())))


def singular(word: str) -> str:
    """Return the singular of a word that may be a plural, or the word itself.

    >>> singular("waypoints"), singular("singularities"), singular("axes"), singular("torus"), singular("jacobian")
    ('waypoint', 'singularity', 'axis', 'torus', 'jacobian')
    """
    if len(word) < MOST_SHORT or word.endswith(("ss", "us", "is")):
        return word
    if word in ("axes", "matrices", "vertices", "indices"):
        return {"axes": "axis", "matrices": "matrix", "vertices": "vertex", "indices": "index"}[word]
    if word.endswith("ies"):
        return f"{word[:-3]}y"
    return word.removesuffix("s")


MOST_SHORT = 4
"""Length of the shortest word that is taken for a plural, in letters."""
