"""Facts of two lines and their common normal that lessons can check."""

from __future__ import annotations

from typing import get_args

from armlab.benches.robot.normal.state import Lines
from armlab.kin.lines import Relation
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (Lines,),
    {
        "kind": Fact(
            "how the lines lie",
            lambda s: s[Lines].normal.kind,
            kind="text",
            names={kind: f"{kind} lines" for kind in get_args(Relation)},
        ),
        "a": Fact("the distance a of the lines", lambda s: s[Lines].normal.a, "m"),
        "alpha": Fact("the twist α from the first line to the second", lambda s: s[Lines].normal.alpha, "rad"),
    },
)
