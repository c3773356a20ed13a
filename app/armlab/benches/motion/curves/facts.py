"""Facts of the selected curve through knots that lessons can check; lengths are in the unit of the page."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.curves.made import Made
from armlab.benches.motion.curves.state import Curves
from armlab.kin.motion.path_types import path_types
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _of_curve(value: Callable[[Made], float]) -> Callable[[State], float | None]:
    """Return a fact of the selected curve, which is None if there is no such curve through these knots."""

    def found(state: State) -> float | None:
        part = state[Curves]
        made = part.outcomes[part.selected]
        return value(made) if isinstance(made, Made) else None

    return found


def _kept(state: State) -> bool | None:
    part = state[Curves]
    made = part.outcomes[part.selected]
    return not made.beyond(part.v_max, part.a_max) if isinstance(made, Made) else None


FACTS = Facts(
    __name__,
    (Curves,),
    {
        "knots": Fact("the number of knots", lambda s: len(s[Curves].knots), kind="count"),
        "path": Fact(
            "the path of the curve",
            lambda s: s[Curves].curves[s[Curves].selected].path.key,
            kind="text",
            names={key: each.title for key, each in path_types().items()},
        ),
        "duration": Fact("the time from the first knot to the last", _of_curve(lambda m: m.trajectory.duration), "s"),
        "overshoot": Fact("how far the curve goes beyond its knots", _of_curve(lambda m: m.overshoot)),
        "missed": Fact("the largest distance from a knot", _of_curve(lambda m: m.missed())),
        "peak_velocity": Fact("the largest velocity", _of_curve(lambda m: m.largest(1))),
        "peak_acceleration": Fact("the largest acceleration", _of_curve(lambda m: m.largest(2))),
        "peak_jerk": Fact("the largest jerk", _of_curve(lambda m: m.largest(3))),
        "bending": Fact("the integral of the squared acceleration", _of_curve(lambda m: m.bending)),
        "limits_kept": Fact("the curve keeps the limits", _kept, kind="truth"),
    },
)
