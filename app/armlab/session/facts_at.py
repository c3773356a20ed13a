"""Facts of benches at many configurations of an arm, in an otherwise equal state."""

from __future__ import annotations

from typing import Any

from armlab.content.seen_fact import SeenFact
from armlab.session.facts import seen_facts
from armlab.session.parts.joints import Joints
from armlab.session.state import Part, State


class FactsAt:
    """Values of facts as functions of the joint values.

    A fact that never looks at the joints is the same at all configurations, and is worked out once.

    Parameters
    ----------
    begun : State
    words : tuple of str
    """

    def __init__(self, begun: State, words: tuple[str, ...]) -> None:
        self._begun = begun
        self._same: dict[str, SeenFact] = {}
        for word in words:
            parts = _Watched(begun)
            seen = seen_facts(State(parts, begun.at), (word,))
            if not parts.joints_read:
                self._same |= seen
        self._moving = tuple(word for word in words if word not in self._same)

    def __call__(self, q: Any) -> dict[str, SeenFact]:
        """Return the facts by their words, q of shape (n,) in radians and metres."""
        if not self._moving:
            return self._same
        state = self._begun.replace(self._begun[Joints].moved_to(q))
        return self._same | seen_facts(state, self._moving)


class _Watched(dict[type[Part], Part]):
    """The parts of a state, which notes whether somebody looks at the joints, or at all of them."""

    def __init__(self, state: State) -> None:
        super().__init__({type(part): part for part in state})
        self.joints_read = False

    def __getitem__(self, kind: type[Part]) -> Part:
        self.joints_read |= kind is Joints
        return super().__getitem__(kind)

    def __or__(self, other: Any) -> Any:
        self.joints_read = True
        return super().__or__(other)

    def values(self) -> Any:
        self.joints_read = True
        return super().values()

    def items(self) -> Any:
        self.joints_read = True
        return super().items()
