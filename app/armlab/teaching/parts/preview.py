"""The state that waits while somebody looks at a lesson or an assignment as a student sees it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.held import HeldAssignment
from armlab.content.robots import Robot
from armlab.session.share import state_of_parts
from armlab.session.state import Json, Part, PartType, Stand, State

ASIDE = ("own_lessons", "preview")
"""Keys of the parts that stay as they are when a preview ends."""


@dataclass(frozen=True)
class Preview(Part):
    """The state to which the preview leads back.

    Attributes
    ----------
    before : State or None
        None where there is no preview.
    panel : str
        The page from which it began.
    without_dates : HeldAssignment or None
        The assignment that is looked at, which can be begun at any time.
    number : int
        Number of the preview among those that follow each other without going back; not saved.
    """

    key: ClassVar[str] = "preview"
    called: ClassVar[str] = "the work before the preview"
    kept_by_undo: ClassVar[bool] = True

    before: State | None = None
    panel: str = ""
    without_dates: HeldAssignment | None = None
    number: int = 0

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part of somebody who looks at nothing."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    @property
    def stand(self) -> Stand | None:
        """The place of the lesson that is looked at, whose history ends with it."""
        return None if self.before is None else Stand(self.key, f"{self.key} {self.number}")

    def waiting_at(self, stand: str) -> State | None:
        """Return the state to which the preview leads back; it lies over all that waits in the preview."""
        return None if stand == self.key else self.before

    def to_json(self) -> Json:
        """Return the state to which it leads back as JSON, without the parts that stay; None for none."""
        if self.before is None:
            return None
        parts = {key: part for key, part in self.before.to_json().items() if key not in ASIDE}
        return {"panel": self.panel, "parts": parts}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; raises when the state is not usable."""
        if data is None:
            return cls()
        parts = {key: part for key, part in data["parts"].items() if key not in ASIDE}
        return cls(state_of_parts(parts), str(data["panel"]))

    @classmethod
    def with_states(cls, data: Json, change: Callable[[Json], Json]) -> Json:
        """Return the JSON with the parts of the state changed."""
        return None if data is None else {**data, "parts": change(data["parts"])}


PART = PartType(Preview, order=98)
