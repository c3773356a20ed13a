"""Facts of a point in three kinds of coordinates that lessons can check."""

from __future__ import annotations

from armlab.benches.frames.coordinates.state import SHOWN, Coordinates, where_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _theta(state: State) -> float | None:
    found = state.derived(where_of)
    return None if found.on_axis else found.theta


def _phi(state: State) -> float | None:
    found = state.derived(where_of)
    return None if found.at_origin else found.phi


FACTS = Facts(
    __name__,
    (Coordinates,),
    {
        "point": Fact("the Cartesian coordinates", lambda s: s[Coordinates].p, "m", "numbers"),
        "from_axis": Fact("the distance r from the z axis", lambda s: s.derived(where_of).r, "m"),
        "theta": Fact("the azimuth θ", _theta, "rad"),
        "h": Fact("the height h", lambda s: s.derived(where_of).h, "m"),
        "from_origin": Fact("the distance r from the origin", lambda s: s.derived(where_of).R, "m"),
        "phi": Fact("the angle φ from the z axis", _phi, "rad"),
        "by_atan": Fact("the angle atan(y / x)", lambda s: s.derived(where_of).by_atan, "rad"),
        "on_axis": Fact("whether θ is not defined", lambda s: s.derived(where_of).on_axis, kind="truth"),
        "shown": Fact("the coordinates that are drawn", lambda s: s[Coordinates].shown, kind="text", names=SHOWN),
    },
)
