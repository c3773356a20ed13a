"""Facts of the screw motion between two poses that lessons can check."""

from __future__ import annotations

from typing import Any

import numpy as np

from armlab.benches.frames.screw.film import Ways, part_of, ways_of
from armlab.benches.frames.screw.state import KINDS, Screw
from armlab.kin.screw_motion import ScrewMotion
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State


def _ways(state: State) -> Ways:
    return state.derived(ways_of)


def _screw(state: State) -> ScrewMotion:
    return _ways(state).screw


def _of_axis(name: str, state: State) -> Any:
    """Return an attribute of the screw; None where nothing turns, so that there is no axis."""
    found = _screw(state)
    return getattr(found, name) if found.kind in ("rotation", "screw") else None


def _pitch(state: State) -> float | None:
    found = _screw(state)
    return found.pitch if np.isfinite(found.pitch) else None


def _apart(state: State) -> float:
    """Return the distance between the origins on both ways, at the present time of the film."""
    found, s = _ways(state), part_of(state)
    return float(np.linalg.norm(found.at(s)[:3, 3] - found.straight(s)[:3, 3]))


FACTS = Facts(
    __name__,
    (Screw, Timeline),
    {
        "kind": Fact("the kind of motion", lambda s: _screw(s).kind, kind="text", names=KINDS),
        "direction": Fact("the direction of the axis", lambda s: _of_axis("direction", s), kind="numbers"),
        "point": Fact(
            "the point of the axis that is nearest to the origin", lambda s: _of_axis("point", s), "m", "numbers"
        ),
        "angle": Fact("the angle about the axis", lambda s: _screw(s).angle, "rad"),
        "distance": Fact("the distance along the axis", lambda s: _screw(s).distance, "m"),
        "pitch": Fact("the pitch, in metres for each radian", _pitch),
        "twist": Fact("the twist, v in m and omega in rad", lambda s: _screw(s).twist, kind="numbers"),
        "pose": Fact(
            "the pose of the body on the screw at present, by rows, m",
            lambda s: _ways(s).at(part_of(s)),
            kind="numbers",
        ),
        "length": Fact("the length of the way of the origin on the screw", lambda s: _ways(s).length, "m"),
        "chord": Fact("the length of the straight way", lambda s: _ways(s).chord, "m"),
        "apart": Fact("the distance between both ways at present", _apart, "m"),
    },
)
