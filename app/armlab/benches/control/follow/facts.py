"""Facts of the selected run that lessons can check, known once the run has been made."""

from __future__ import annotations

from armlab.benches.control.follow.job import JOB
from armlab.benches.control.follow.runs import Figures
from armlab.benches.control.follow.state import Control, questions
from armlab.benches.motion.api import Plan
from armlab.session.facts import Fact, Facts, facts_of
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _figures(state: State) -> Figures | None:
    """Return the figures of the selected run with its present settings, or None while there are none."""
    part = state[Control]
    outcome = part.outcome
    if outcome is None or outcome.question != state.derived(questions)[part.selected]:
        return None
    return outcome.figures


_of_run = facts_of(_figures)

FACTS = Facts(
    __name__,
    (Control, Plan, Joints),
    {
        "largest_error": Fact("the largest error of the position", _of_run(lambda f: f.position.value), "m"),
        "last_error": Fact("the error of the position at the end", _of_run(lambda f: f.final_position), "m"),
        "largest_turn_error": Fact("the largest error of the orientation", _of_run(lambda f: f.rotation.value), "rad"),
        "last_turn_error": Fact("the error of the orientation at the end", _of_run(lambda f: f.final_rotation), "rad"),
        "peak_speeds": Fact(
            "the largest speeds of the joints, in rad/s and m/s",
            _of_run(lambda f: [peak.value for peak in f.speeds]),
            kind="numbers",
        ),
        "smallest_sigma": Fact("the smallest singular value on the way", _of_run(lambda f: f.sigma_min.value)),
        "saturated": Fact("how long the motors were at their limits", _of_run(lambda f: f.saturated), "s"),
        "duration": Fact("the duration of the run", _of_run(lambda f: f.duration), "s"),
        "in_range": Fact("all joints stay in their ranges", _of_run(lambda f: f.left_range is None), kind="truth"),
        "runs": Fact("the number of runs", lambda s: len(s[Control].runs), kind="count"),
    },
    JOB,
)
