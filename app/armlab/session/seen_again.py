"""What a check saw, from evidence that anyone may have changed: what follows from the inputs is worked out again."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.motion.plan.job import with_plan
from armlab.benches.motion.plan.seen import seen_plan
from armlab.benches.motion.plan.state import Plan
from armlab.content import evidence
from armlab.content.observation import Observation
from armlab.content.robots import Robot
from armlab.content.seen_motion import SeenMotion
from armlab.errors import InputError
from armlab.session.parts.lesson import PLAN
from armlab.session.state import Json, State

MOST_POSES = 30_000
"""Poses for which the inverse kinematics of one plan is solved again; more than any lesson asks for."""


def seen_again(data: Json, robot: Robot, plans: bool = True) -> Observation:
    """Return what a check saw.

    Parameters
    ----------
    data : Json
        What `Observation.to_json` wrote, and under `PLAN` what the motion was planned of.
    robot : Robot
        Of the lesson.
    plans : bool
        Whether a motion is planned again, which may take seconds; what is told of it is taken down otherwise.

    Raises
    ------
    InputError
        The evidence is not usable.
    """
    plan = data.get(PLAN) if isinstance(data, dict) else None
    kept = {key: value for key, value in data.items() if key != PLAN} if isinstance(data, dict) else data
    seen = Observation.from_json(kept, robot)
    return seen if seen.motion is None or not plans else replace(seen, motion=_motion(plan, seen.motion, robot))


def _motion(data: Json, told: SeenMotion, robot: Robot) -> SeenMotion:
    """Return what there is to see of a motion, planned again; whether and how far it was played is as told."""
    if data is None:
        raise InputError("motion: what it is planned of is missing")
    part = Plan.from_json(evidence.mapping(data, PLAN, (), tuple(Plan.initial(robot).to_json())), robot)
    poses = part.samples * sum(move.space == "cartesian" for move in part.moves)
    if poses > MOST_POSES:
        raise InputError(f"motion: it has {poses} poses to solve; at most {MOST_POSES} are looked at again")
    state = with_plan(State.initial(robot).replace(replace(part, compared=False, before=None)))
    return replace(seen_plan(state, told.played), time=told.time)
