"""Facts of the page of history that lessons can check."""

from __future__ import annotations

from armlab.benches.robot.history.laws import decide
from armlab.benches.robot.history.state import History
from armlab.benches.robot.history.things import DEFINITIONS, THINGS
from armlab.benches.robot.history.timeline import EVENTS
from armlab.session.facts import Fact, Facts

DECISIONS = {
    "act": "it has to do it",
    "refrain": "it must not do it",
    "free": "it may do it or not",
    "conflict": "no answer",
}
"""Words for what the laws say."""

FACTS = Facts(
    __name__,
    (History,),
    {
        "shown": Fact("what is shown of the history", lambda s: s[History].shown, kind="text"),
        "event": Fact(
            "the key of the entry that is looked at",
            lambda s: s[History].event,
            kind="text",
            names={key: each.title for key, each in EVENTS.items()},
        ),
        "year": Fact("the year of the entry that is looked at", lambda s: EVENTS[s[History].event].year, kind="count"),
        "definition": Fact(
            "the key of the definition",
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
            "what the laws say (act, refrain, free or conflict)",
            lambda s: decide(s[History].holds).kind,
            kind="text",
            names=DECISIONS,
        ),
        "law": Fact("the law that decides", lambda s: decide(s[History].holds).law, kind="count"),
    },
)
