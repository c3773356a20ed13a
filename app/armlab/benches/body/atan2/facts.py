"""Facts of the angle of a point that lessons can check."""

from __future__ import annotations

from armlab.benches.body.atan2.angle import present
from armlab.benches.body.atan2.state import Plane
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (Plane,),
    {
        "point": Fact("the point", lambda s: s[Plane].point, kind="numbers"),
        "atan2": Fact("atan2(y, x)", lambda s: present(s).atan2, "rad"),
        "atan": Fact("atan(y/x)", lambda s: present(s).atan, "rad"),
        "apart": Fact("atan(y/x) less atan2(y, x)", lambda s: present(s).apart, "rad"),
        "right": Fact("whether atan(y/x) is the angle of the point", lambda s: present(s).right, kind="truth"),
        "quadrant": Fact("the quadrant of the point", lambda s: present(s).quadrant, kind="count"),
    },
)
