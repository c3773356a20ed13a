"""Facts of quaternions that lessons can check; the product is that of the second one and that of the body."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.quaternion.film import second
from armlab.benches.body.quaternion.state import Quaternions
from armlab.kin.quaternions import product
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _both(state: State) -> tuple[np.ndarray, np.ndarray]:
    p, q = second(state), state.derived(forms_of).q
    return product(p, q), product(q, p)


FACTS = Facts(
    __name__,
    (Body, Quaternions),
    {
        "second": Fact("the second quaternion p, of unit length", second, kind="numbers"),
        "product": Fact("p q, with the quaternion q of the body", lambda s: _both(s)[0], kind="numbers"),
        "reversed": Fact("q p, with the quaternion q of the body", lambda s: _both(s)[1], kind="numbers"),
    },
)
