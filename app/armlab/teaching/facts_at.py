"""Facts of benches at many configurations of an arm, in an otherwise equal state."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeVar

from armlab.content.seen_fact import SeenFact
from armlab.session.facts import seen_facts
from armlab.session.parts.joints import Joints
from armlab.session.state import Part, State

P = TypeVar("P", bound=Part)


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
            watched = _Watched(begun)
            seen = seen_facts(watched, (word,))
            if not watched.joints_read:
                self._same |= seen
        self._moving = tuple(word for word in words if word not in self._same)

    def __call__(self, q: Any) -> dict[str, SeenFact]:
        """Return the facts by their words, q of shape (n,) in radians and metres."""
        if not self._moving:
            return self._same
        state = self._begun.replace(self._begun[Joints].moved_to(q))
        return self._same | seen_facts(state, self._moving)


class _Watched(State):
    """A state that notes whether somebody looks at the joints, or takes all parts."""

    def __init__(self, state: State) -> None:
        super().__init__(state, state.at)
        self.joints_read = False

    def __getitem__(self, kind: type[P]) -> P:
        self.joints_read |= kind is Joints
        return super().__getitem__(kind)

    def __iter__(self) -> Iterator[Part]:
        self.joints_read = True
        return super().__iter__()

    def replace(self, *parts: Part) -> State:
        self.joints_read = True
        return super().replace(*parts)

    def dated(self, at: float) -> State:
        self.joints_read = True
        return super().dated(at)
