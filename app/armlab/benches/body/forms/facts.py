"""Facts of the orientation of the body that lessons can check."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.session.facts import Fact, Facts
from armlab.session.state import State

ROUNDING = 1e-9
"""Angle, radians, by which half a turn may be exceeded by rounding."""


def _distance(state: State) -> float | None:
    nearest = state.derived(forms_of).nearest
    return None if nearest is None else nearest.distance


def _defined(state: State) -> float | None:
    triples = state.derived(forms_of).triples
    return triples.defined if triples.singular else None


def _without_whole_turns(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return angles in (-pi, pi], where rounding makes no -pi of pi: whole turns leave the body as it is."""
    return angles - math.tau * np.ceil((angles - math.pi - ROUNDING) / math.tau)


FACTS = Facts(
    __name__,
    (Body,),
    {
        "matrix": Fact("R, row by row", lambda s: s.derived(forms_of).R.ravel(), kind="numbers"),
        "quaternion": Fact("the unit quaternion, scalar first", lambda s: s.derived(forms_of).q, kind="numbers"),
        "axis": Fact("the axis, of unit length", lambda s: s.derived(forms_of).axis, kind="numbers"),
        "angle": Fact(
            "the angle about the axis, without whole turns",
            lambda s: _without_whole_turns(np.array(s.derived(forms_of).angle)).item(),
            "rad",
        ),
        "angles": Fact(
            "the three angles, without whole turns",
            lambda s: _without_whole_turns(s.derived(forms_of).triples.shown),
            "rad",
            "numbers",
        ),
        "other_angles": Fact(
            "the other triple of angles", lambda s: s.derived(forms_of).triples.other, "rad", "numbers"
        ),
        "singular": Fact(
            "whether first and third axis coincide", lambda s: s.derived(forms_of).triples.singular, kind="truth"
        ),
        "defined": Fact("the sum or difference that is defined at a singularity", _defined, "rad"),
        "distance": Fact("the distance of the typed matrix from the nearest rotation", _distance),
    },
)
