"""Facts of the three meanings of a rotation matrix that lessons can check."""

from __future__ import annotations

from armlab.benches.body.forms.state import Body
from armlab.benches.body.meanings.state import Meanings, image_of
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (Body, Meanings),
    {
        "shown": Fact("the meaning that is shown", lambda s: s[Meanings].shown, kind="text"),
        "vector": Fact("the vector p", lambda s: s[Meanings].p, kind="numbers"),
        "image": Fact("R p", image_of, kind="numbers"),
    },
)
