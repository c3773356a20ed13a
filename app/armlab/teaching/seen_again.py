"""Observations of checks from evidence that anyone may have changed: everything derived is computed again."""

from __future__ import annotations

from dataclasses import replace

from armlab.content.observation import Observation
from armlab.content.robots import Robot
from armlab.session.facts import facts_again
from armlab.session.state import Json
from armlab.teaching.taught import FACTS, taught


def seen_again(data: Json, robot: Robot, plans: bool = True, facts: tuple[str, ...] = ()) -> Observation:
    """Return the observation that a check saw.

    Parameters
    ----------
    data : Json
        Data written by `Observation.to_json`, with the parts of benches from which observations follow.
    robot : Robot
        The robot of the lesson.
    plans : bool
        Whether long work is done again, such as planning a motion, which may take seconds; otherwise its results are
        taken from the data.
    facts : tuple of str
        Words of the facts of benches that the check looks at.

    Raises
    ------
    InputError
        The evidence is not usable.
    """
    work = {each.part.key for each in taught()} | {FACTS}
    kept = {key: value for key, value in data.items() if key not in work} if isinstance(data, dict) else data
    seen = Observation.from_json(kept, robot, {each.key: each.read for each in taught()})
    if facts:
        seen = replace(seen, facts=facts_again(data.get(FACTS), facts, seen, robot, plans))
    if not plans:
        return seen
    told = {each.key: each for each in taught() if each.key in seen.benches}
    again = {key: each.again(data.get(each.part.key), seen.benches[key], robot) for key, each in told.items()}
    return replace(seen, benches=again)
