"""Facts of two rotations in both orders that lessons can check."""

from __future__ import annotations

from armlab.benches.body.order.film import ends_of, pairs_of
from armlab.benches.body.order.state import ABOUT, ENDS, Order
from armlab.session.facts import Fact, Facts

SAME = 1e-14
"""Angle between the ends, radians, up to which both orders end alike."""

FACTS = Facts(
    __name__,
    (Order,),
    {
        "angles": Fact("the angles of both rotations", lambda s: s[Order].angles, "rad", "numbers"),
        "largest": Fact("the larger angle of both rotations", lambda s: ends_of(s).largest, "rad"),
        "apart": Fact("the angle between the ends of both orders", lambda s: ends_of(s).apart, "rad"),
        "rule": Fact("the product of both angles and the sine between the axes", lambda s: ends_of(s).rule, "rad"),
        "beyond": Fact("the largest difference of an entry from I + S(dφ)", lambda s: ends_of(s).beyond),
        "alike": Fact("whether both orders end alike", lambda s: ends_of(s).apart < SAME, kind="truth"),
        "first_a": Fact(
            "R after a and then b, row by row", lambda s: pairs_of(s)[0].at(ENDS[-1]).ravel(), "", "numbers"
        ),
        "first_b": Fact(
            "R after b and then a, row by row", lambda s: pairs_of(s)[1].at(ENDS[-1]).ravel(), "", "numbers"
        ),
        "about": Fact("the axes that are turned about", lambda s: s[Order].about, kind="text", names=ABOUT),
    },
)
