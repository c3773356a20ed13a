"""Facts of the sampled workspace that lessons can check, known once it has been sampled with the present settings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.benches.workspace.cloud.job import JOB
from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import SampleWorkspace, Workspace, question_of
from armlab.kin.workspace.measures import MEASURES
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _of_samples(value: Callable[[Sampled], Any]) -> Callable[[State], Any]:
    def known(state: State) -> Any:
        found = state[Workspace].found
        return value(found) if found is not None and found.finished and found.question == question_of(state) else None

    return known


FACTS = Facts(
    __name__,
    (Workspace,),
    {
        "samples": Fact("the number of samples", _of_samples(lambda found: found.done), kind="count"),
        "measure": Fact(
            "the measure",
            lambda s: s[Workspace].measure,
            kind="text",
            names={key: each.title for key, each in MEASURES.items()},
        ),
        "farthest": Fact(
            "the largest distance of a sample from frame 0", _of_samples(lambda found: found.farthest), "m"
        ),
    },
    JOB,
    SampleWorkspace().apply,
)
