"""Facts of the three meanings of a rotation matrix that lessons can check."""

from __future__ import annotations

from typing import Any

from armlab.benches.body.forms.state import Body
from armlab.benches.body.meanings.state import SHOWN, Meanings, elementary_of, image_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _of(state: State, name: str) -> Any:
    """Return a field of the elementary rotation, or None if the axis is none of the base."""
    found = elementary_of(state)
    return None if found is None else getattr(found, name)


FACTS = Facts(
    __name__,
    (Body, Meanings),
    {
        "shown": Fact("the meaning that is shown", lambda s: s[Meanings].shown, kind="text", names=SHOWN),
        "vector": Fact("the vector p", lambda s: s[Meanings].p, kind="numbers"),
        "image": Fact("R p", image_of, kind="numbers"),
        "axis": Fact("the axis of an elementary rotation", lambda s: _of(s, "axis"), kind="text"),
        "alpha": Fact(
            "the angle of the vector in the plane perpendicular to that axis", lambda s: _of(s, "alpha"), "rad"
        ),
    },
)
