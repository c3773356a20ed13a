"""One live value of a text, of the arm or of what a bench tells of itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from armlab.content.check import PLAIN, Words
from armlab.content.observation import Observation
from armlab.kin.arm import Arm

NONE = "–"
"""Sign for a live value that the present arm does not have."""


@dataclass(frozen=True)
class LiveValue:
    """One live value.

    Parameters
    ----------
    missing : callable
        ``missing(arm)``: why an arm does not have it; empty when it has.
    text : callable
        ``text(observation, words)``: the value with its unit; only asked where nothing is missing.
    """

    missing: Callable[[Arm], str]
    text: Callable[[Observation, Words], str]

    def __call__(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the value with its unit as plain text, or `NONE`."""
        return NONE if self.missing(observation.arm) else self.text(observation, words)


def always(arm: Arm) -> str:
    """Return the empty reason of a value that every arm has."""
    del arm
    return ""
