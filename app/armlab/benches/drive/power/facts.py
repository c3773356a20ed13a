"""Facts of power that lessons can check: the chain, and a load that is held."""

from __future__ import annotations

import math

from armlab.benches.drive.power.chains import CHAINS
from armlab.benches.drive.power.state import SHOWN, Power
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _part(state: State) -> Power:
    return state[Power]


def _rise(state: State) -> float | None:
    rise = state[Power].held.rise
    return rise if math.isfinite(rise) else None


FACTS = Facts(
    __name__,
    (Power,),
    {
        "kind": Fact(
            "the kind of the chain",
            lambda s: _part(s).kind,
            kind="text",
            names={key: each.title for key, each in CHAINS.items()},
        ),
        "supplied": Fact("the power of the supply", lambda s: _part(s).chain.supplied, "W"),
        "useful": Fact("the power at the load", lambda s: _part(s).chain.useful, "W"),
        "efficiency": Fact("the efficiency of the chain", lambda s: _part(s).chain.efficiency),
        "lost": Fact("the heat of the chain", lambda s: sum(_part(s).chain.losses), "W"),
        "largest_loss": Fact("the largest heat of a converter", lambda s: max(_part(s).chain.losses), "W"),
        "load_effort": Fact(
            "the torque in N m, or force in N, at the load", lambda s: _part(s).chain.passed[-1].effort
        ),
        "supply_current": Fact("the current of the supply", lambda s: _part(s).chain.passed[0].flow, "A"),
        "held_torque": Fact("the torque of the load that is held", lambda s: _part(s).load, "N m"),
        "held_current": Fact("the current of the motor that holds it", lambda s: _part(s).held.current, "A"),
        "held_heat": Fact("the heat of the motor that holds it", lambda s: _part(s).held.heat, "W"),
        "held_rise": Fact("the rise of its temperature in the long run", _rise, "K"),
        "endures": Fact("whether the winding stands it", lambda s: _part(s).endures, kind="truth"),
        "shown": Fact("what is shown of power", lambda s: _part(s).shown, kind="text", names=SHOWN),
    },
)
