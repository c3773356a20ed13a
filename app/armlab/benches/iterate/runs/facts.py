"""Facts of the selected run of iterations that lessons can check, known once its film has been made."""

from __future__ import annotations

from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.job import JOB
from armlab.benches.iterate.runs.state import Iterations, questions
from armlab.benches.iterate.runs.worked import methods
from armlab.session.facts import Fact, Facts, facts_of
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _film(state: State) -> Film | None:
    """Return the film of the selected run with its present settings, or None while it is being made."""
    part = state[Iterations]
    film = part.films.get(part.run.colour)
    asked = state.derived(questions)[part.runs.index(part.run)]
    return film if film is not None and film.question == asked else None


_of_film = facts_of(_film)


def _start(state: State) -> tuple[float, ...]:
    """Return where the runs begin: a held joint stays where it is, whatever start was chosen for it."""
    return state.derived(questions)[0].start


ENDS = {
    "converged": "at the target",
    "stuck": "stuck, not at the target",
    "singular": "stopped at a singular configuration",
    "representation": "stopped where the Euler angles are singular",
    "diverged": "diverged",
    "jumped": "not reached, and a joint has jumped",
    "limit": "stopped at the limits of joints",
    "most": "not reached after the most steps",
    "out of reach": "out of reach",
    "locked": "all joints are locked",
    "unfit": "too few free joints for the method",
    "going": "not yet at the target",
    "unstable": "the time step is too long",
    "refused": "it cannot begin",
}
"""Words for how a run ends."""

FACTS = Facts(
    __name__,
    (Iterations, Joints),
    {
        "steps": Fact("the number of steps", _of_film(lambda f: f.last), kind="count"),
        "converged": Fact("the target is reached", _of_film(lambda f: f.success), kind="truth"),
        "status": Fact("how the run ends", _of_film(lambda f: f.status), kind="text", names=ENDS),
        "last_error": Fact("the error of the position at the end", _of_film(lambda f: f.position_error[-1]), "m"),
        "last_turn_error": Fact(
            "the error of the orientation at the end", _of_film(lambda f: f.rotation_error[-1]), "rad"
        ),
        "end": Fact("the joint values at the end, in rad and m", _of_film(lambda f: f.q[-1]), kind="numbers"),
        "method": Fact(
            "the method",
            lambda s: s[Iterations].run.method,
            kind="text",
            names={key: f"{each.title[:1].upper()}{each.title[1:]}" for key, each in methods().items()},
        ),
        "start": Fact("the start, in rad and m", _start, kind="numbers"),
    },
    JOB,
)
