"""Facts of quaternions that lessons can check; the product is that of the second one and that of the body."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.quaternion.between import film_share, present_way, turned_in_all, ways_of
from armlab.benches.body.quaternion.film import second
from armlab.benches.body.quaternion.from_matrix import METHODS, found_of
from armlab.benches.body.quaternion.state import Quaternions
from armlab.benches.body.quaternion.state_view import SHOWN, WAYS, QuaternionView
from armlab.kin.quaternions import inverse, logarithm, product
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State


def _both(state: State) -> tuple[np.ndarray, np.ndarray]:
    p, q = second(state), state.derived(forms_of).q
    return product(p, q), product(q, p)


def _off(key: str) -> Callable[[State], float]:
    return lambda state: found_of(state)[key].off


def _turned(key: str) -> Callable[[State], float | None]:
    return lambda state: turned_in_all(state, key)


FACTS = Facts(
    __name__,
    (Body, Quaternions, QuaternionView, Timeline),
    {
        "second": Fact("the second quaternion p, of unit length", second, kind="numbers"),
        "product": Fact("p q, with the quaternion q of the body", lambda s: _both(s)[0], kind="numbers"),
        "reversed": Fact("q p, with the quaternion q of the body", lambda s: _both(s)[1], kind="numbers"),
        "inverse": Fact("the inverse of q", lambda s: inverse(s.derived(forms_of).q), kind="numbers"),
        "logarithm": Fact("the logarithm of q", lambda s: logarithm(s.derived(forms_of).q), kind="numbers"),
        "shown": Fact("what is shown of quaternions", lambda s: s[QuaternionView].shown, kind="text", names=SHOWN),
        **{
            f"{key}_off": Fact(f"the largest difference of an entry of R from that of q, {title}", _off(key))
            for key, title in METHODS.items()
        },
        "way": Fact("the way between both orientations", lambda s: s[QuaternionView].way, kind="text", names=WAYS),
        "shorter": Fact("whether the shorter way is taken", lambda s: s[QuaternionView].shorter, kind="truth"),
        "along": Fact("the scalar product of p and q", lambda s: s.derived(ways_of).along),
        **{
            f"{key}_turned": Fact(f"the angle turned through in all by {title}", _turned(key), "rad")
            for key, title in WAYS.items()
        },
        "on_the_way": Fact(
            "R on the way, row by row", lambda s: present_way(s).rotation(film_share(s)).ravel(), kind="numbers"
        ),
    },
)
