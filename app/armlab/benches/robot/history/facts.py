"""Facts of the page of history that lessons can check."""

from __future__ import annotations

from armlab.benches.robot.history.laws import DECISIONS, decide
from armlab.benches.robot.history.state import SHOWN, History
from armlab.benches.robot.history.things import DEFINITIONS, THINGS
from armlab.benches.robot.history.timeline import EVENTS
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (History,),
    {
        "shown": Fact("what is shown of the history", lambda s: s[History].shown, kind="text", names=SHOWN),
        "event": Fact(
            "the entry that is looked at",
            lambda s: s[History].event,
            kind="text",
            names={key: each.title for key, each in EVENTS.items()},
        ),
        "year": Fact("the year of the entry that is looked at", lambda s: EVENTS[s[History].event].year, kind="count"),
        "definition": Fact(
            "the definition",
            lambda s: s[History].definition,
            kind="text",
            names={key: each.title for key, each in DEFINITIONS.items()},
        ),
        "judged": Fact(
            "the number of things that are judged by the definition", lambda s: len(s[History].judged), kind="count"
        ),
        "right": Fact("the number of them that are judged rightly", lambda s: s[History].right, kind="count"),
        "all_right": Fact(
            "whether all things are judged rightly", lambda s: s[History].right == len(THINGS), kind="truth"
        ),
        "decision": Fact(
            "what follows from the laws",
            lambda s: decide(s[History].holds).kind,
            kind="text",
            names=DECISIONS,
        ),
        "law": Fact("the law that decides", lambda s: decide(s[History].holds).law, kind="count"),
    },
)
