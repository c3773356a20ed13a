"""Facts of the velocity loop that lessons can check: its speed, and its lasting error."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.control.loop.state import Loop
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _of_sine(value: Callable[[Loop], float]) -> Callable[[State], float | None]:
    """Return a fact that exists only for a sine."""
    return lambda state: value(state[Loop]) if state[Loop].kind == "sine" else None


FACTS = Facts(
    __name__,
    (Loop,),
    {
        "time_constant": Fact("the time constant M/K", lambda s: s[Loop].loop.time_constant, "s"),
        "cutoff": Fact("the angular frequency K/M", lambda s: s[Loop].loop.cutoff, "rad/s"),
        "lasting_error": Fact(
            "the amplitude of the error that stays", lambda s: s[Loop].loop.steady_error(s[Loop].reference), "m/s"
        ),
        "gain": Fact("the gain |W| at the sine", _of_sine(lambda part: float(part.loop.closed_gain(part.omega)))),
        "phase": Fact("the phase of W at the sine", _of_sine(lambda part: float(part.loop.phase(part.omega))), "rad"),
        "first_error": Fact(
            "the error at the start", lambda s: s[Loop].loop.error(0.0, s[Loop].reference, s[Loop].v0), "m/s"
        ),
        "last_error": Fact(
            "the error at the end", lambda s: s[Loop].loop.error(s[Loop].end, s[Loop].reference, s[Loop].v0), "m/s"
        ),
    },
)
