"""The present value of a fact that a bench publishes, for checks of lessons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from armlab.content import evidence
from armlab.kin.checks import wrong

Value = float | tuple[float, ...] | str | bool
"""Value of a fact: a number, several numbers, a text, or a truth value."""

MOST_NUMBERS = 100


@dataclass(frozen=True)
class SeenFact:
    """The present value of a fact.

    Attributes
    ----------
    title : str
        The fact in words, such as ``"the torques of the joints"``.
    unit : str
        Empty for none.
    value : Value or None
        None where the arm has no such thing, or it is not worked out yet.
    slow : bool
        Whether it takes long to work out.
    names : mapping of str to str
        Words for its values, where these are keys.
    """

    title: str
    unit: str
    value: Value | None
    slow: bool = False
    names: Mapping[str, str] = field(default_factory=dict, compare=False)

    def named(self, value: Value | None) -> Value | None:
        """Return a value of the fact, for a key its words."""
        return self.names.get(value, value) if isinstance(value, str) else value


def read_value(value: object, where: str) -> Value | None:
    """Return the value of a fact from a file that anyone may have changed.

    Raises
    ------
    InputError
        It is of no such kind, or too large.
    """
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return evidence.name(value, where)
    if isinstance(value, list):
        if len(value) > MOST_NUMBERS:
            raise wrong(where, f"at most {MOST_NUMBERS} numbers", value)
        return tuple(evidence.number(each, where) for each in value)
    return evidence.number(value, where)
