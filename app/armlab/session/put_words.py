"""A saved part of a bench as a command in files."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import ClassVar

from armlab.errors import InputError
from armlab.plugins import BENCHES
from armlab.session.examples import with_clip_closed
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Part, State, part_types


@dataclass(frozen=True)
class PutPart(Command):
    """Put a bench as it was saved.

    Parameters
    ----------
    part : type
    saved : str
        The saved part, in JSON.
    """

    part: type[Part]
    saved: str
    label: ClassVar[str] = "saved bench"

    def apply(self, state: State) -> State:
        """Return the state with the part; `InputError` when it is not usable with the present arm."""
        try:
            part = self.part.from_json(json.loads(self.saved), state[RobotPart].robot)
        except Exception as error:
            # Nobody can list what a part may raise about data of anyone.
            raise InputError(f"{self.part.key}: what was saved is not usable with this arm: {error}") from error
        return with_clip_closed(state).replace(part)


def put_words(page: str) -> dict[str, type[Part]]:
    """Return the parts of a page such as ``velocity.statics`` by the words of the commands that restore them."""
    parts = [kind for kind in part_types() if kind.__module__.startswith(f"{BENCHES}.{page}.")]
    return {f"{page}.put" if len(parts) == 1 else f"{page}.put_{kind.key}": kind for kind in parts}
