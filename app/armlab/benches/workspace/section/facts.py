"""Facts of the section of the workspace that lessons can check, known once the section has been found."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.workspace.section.found import Found
from armlab.benches.workspace.section.job import JOB
from armlab.benches.workspace.section.state import SectionView, found_of
from armlab.kin.workspace.section_size import Reach
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _size(unit: str) -> Callable[[State], float | None]:
    def found(state: State) -> float | None:
        seen = _finished(state)
        size = None if seen is None else seen.size
        return size.value if size is not None and size.unit == unit else None

    return found


def _reach(title: str, value: Callable[[Reach], float]) -> Fact:
    """Return a fact of the reach: from the axis of a joint 1 that turns; the page has coordinates where it slides."""

    def found(state: State) -> float | None:
        seen = _finished(state)
        if seen is None or seen.reach is None or not seen.section.joint.revolute:
            return None
        return value(seen.reach)

    return Fact(title, found, "m", only="where joint 1 turns")


def _finished(state: State) -> Found | None:
    found = found_of(state)
    return found if found is not None and found.finished else None


FACTS = Facts(
    __name__,
    (SectionView,),
    {
        "area": Fact("the area of the workspace of a planar arm", _size("m²"), "m²"),
        "volume": Fact("the volume of the workspace of an arm in space", _size("m³"), "m³"),
        "inner": _reach("the least distance from the axis of joint 1", lambda reach: reach.inner),
        "outer": _reach("the largest distance from the axis of joint 1", lambda reach: reach.outer),
        "lowest": _reach("the least height along the axis of joint 1", lambda reach: reach.low),
        "highest": _reach("the largest height along the axis of joint 1", lambda reach: reach.high),
        "farthest": _reach("the largest distance that is reached", lambda reach: reach.farthest),
    },
    JOB,
)
