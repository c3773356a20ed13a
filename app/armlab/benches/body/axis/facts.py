"""Facts of axis and angle that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.axis.film import steps_of
from armlab.benches.body.axis.inverse import inverse_of
from armlab.benches.body.axis.state import SHOWN, Axis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.kin.axis_angle import rodrigues_terms
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _term(k: int, state: State) -> np.ndarray:
    return rodrigues_terms(state.derived(forms_of).axis)[k].ravel()


def _determined(state: State) -> bool:
    return not inverse_of(state).still


FACTS = Facts(
    __name__,
    (Body, Axis),
    {
        "frame": Fact("C = (n s r), row by row", lambda s: steps_of(s).C.ravel(), kind="numbers"),
        "dyad": Fact("r rᵀ, row by row", lambda s: _term(0, s), kind="numbers"),
        "skew": Fact("S(r), row by row", lambda s: _term(2, s), kind="numbers"),
        "trace": Fact("the trace of R", lambda s: np.trace(s.derived(forms_of).R)),
        "arccos": Fact("the angle by arccos", lambda s: inverse_of(s).arccos, "rad"),
        "atan2": Fact("the angle by atan2", lambda s: inverse_of(s).atan2, "rad"),
        "with_half": Fact(
            "the angle by atan2 with a factor ½ before the root only", lambda s: inverse_of(s).printed, "rad"
        ),
        "lost_digits": Fact("the digits that arccos loses", lambda s: inverse_of(s).lost(inverse_of(s).arccos)),
        "determined": Fact("whether the axis is determined", _determined, kind="truth"),
        "shown": Fact("what is shown of axis and angle", lambda s: s[Axis].shown, kind="text", names=SHOWN),
    },
)
