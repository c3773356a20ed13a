"""Facts of coils that lessons can check: forces, torque over a turn, and its ripple."""

from __future__ import annotations

import numpy as np

from armlab.benches.drive.torque.sampled import sampled_of
from armlab.benches.drive.torque.state import Torque, present_angle
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State


def _ripple(state: State) -> float | None:
    part = state[Torque]
    least, largest, mean = part.torques
    return (largest - least) / abs(mean) if mean else None


FACTS = Facts(
    __name__,
    (Torque, Timeline),
    {
        "force": Fact("the force on one side of a coil", lambda s: abs(s[Torque].coil.force), "N"),
        "peak": Fact("the largest torque of one coil", lambda s: abs(s[Torque].coil.peak), "N m"),
        "angle": Fact("the angle of the rotor now", present_angle, "rad"),
        "torque": Fact("the torque now", lambda s: s.derived(sampled_of).now, "N m"),
        "least": Fact("the least torque of a turn", lambda s: s[Torque].torques[0], "N m"),
        "largest": Fact("the largest torque of a turn", lambda s: s[Torque].torques[1], "N m"),
        "mean": Fact("the mean torque of a turn", lambda s: s[Torque].torques[2], "N m"),
        "ripple": Fact("the ripple of the torque", _ripple),
        "zeros": Fact(
            "the number of angles of a turn without torque", lambda s: s.derived(sampled_of).zeros, kind="count"
        ),
        "constant": Fact(
            "the mean torque for each ampere",
            lambda s: abs(s[Torque].torques[2] / s[Torque].current) if s[Torque].current else None,
            "N m/A",
        ),
        "coils": Fact("the number of coils", lambda s: s[Torque].coils, kind="count"),
        "switched": Fact("whether there is a commutator", lambda s: s[Torque].switched, kind="truth"),
        "turned": Fact(
            "the angle at the end of a rotor that is let go",
            lambda s: float(np.asarray(s[Torque].released.theta)[-1]) if s[Torque].motion == "free" else None,
            "rad",
        ),
    },
)
