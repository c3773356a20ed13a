"""The simulation of a run from its settings: made in pieces, thinned for drawing, with its figures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.chosen import Setup, refuse_steps
from armlab.benches.motion.api import Planned
from armlab.benches.motion.api import Question as PlanQuestion
from armlab.benches.motion.api import making as planning
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.control.encoder import encoder
from armlab.kin.control.error_laws import predicted_error
from armlab.kin.control.plant import Plant, Push, plant
from armlab.kin.control.record import Run
from armlab.kin.control.reference import CircleReference, FixedPose, JointReference, LineReference, Reference
from armlab.kin.control.run import Settings, simulating
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.work import Work, result_of

Floats = NDArray[np.float64]

SHOWN = 1201
"""Number of instants of a run that are kept for plots, scene and playback."""


class Question(NamedTuple):
    """All arguments of a run; equal questions have equal answers.

    Attributes
    ----------
    arm : Arm
    setup : Setup
        Of colour 0 and without a name: neither matters.
    target : bytes
        Of the pose (4, 4) that stands still; empty where none does.
    plan : PlanQuestion or None
        Of the motion to follow.
    """

    arm: Arm
    setup: Setup
    target: bytes
    plan: PlanQuestion | None


class Peak(NamedTuple):
    """A largest value, and its time."""

    value: float
    time: float


@dataclass(frozen=True)
class Figures:
    """Figures on the card of a run.

    Attributes
    ----------
    speeds : tuple of Peak
        Largest speed of each joint, rad/s or m/s.
    position, rotation : Peak
        Largest error, m and rad.
    final_position, final_rotation : float
        Errors at the end.
    sigma_min : Peak
        The smallest singular value.
    saturated : float
        Seconds in which the motors could not do what was wanted.
    steps : int
    duration : float
    left_range : tuple of int and float, or None
        The joint, 0-based, that is first beyond its limits, and when, seconds.
    """

    speeds: tuple[Peak, ...]
    position: Peak
    rotation: Peak
    final_position: float
    final_rotation: float
    sigma_min: Peak
    saturated: float
    steps: int
    duration: float
    left_range: tuple[int, float] | None = None


@dataclass(frozen=True, eq=False)
class Outcome:
    """Result of a run.

    Attributes
    ----------
    question : Question
    run : Run or None
        Thinned; None when there is nothing to run.
    figures : Figures or None
        Of all its steps.
    refused : str
        Why there is nothing to run.
    predicted : ndarray, shape (k,), or None
        Error of the position that e_p' = -J K J# e_p predicts for a law of the joints, m.
    """

    question: Question
    run: Run | None = None
    figures: Figures | None = None
    refused: str = ""
    predicted: Floats | None = None


def making(question: Question, known: Planned | None = None) -> Work[Outcome]:
    """Make a run in pieces of some 20 ms; ``known`` is its motion if that has been planned."""
    try:
        return (yield from _made(question, known))
    except InputError as refusal:
        return Outcome(question, refused=str(refusal))


def outcome_of(question: Question, known: Planned | None = None) -> Outcome:
    """Return the result of a run, at once."""
    return result_of(making(question, known))


def _made(question: Question, known: Planned | None) -> Work[Outcome]:
    arm, setup = question.arm, question.setup
    reference, start = yield from _reference(question, known)
    refuse_steps(reference.duration, setup.step)
    q0 = start + np.array(setup.offset)
    run = yield from simulating(arm, setup.law, reference, q0, settings_of(arm, setup))
    yield
    thin = run.thinned(SHOWN)
    return Outcome(question, thin, figures_of(run), predicted=_predicted(setup, thin))


def _reference(question: Question, known: Planned | None) -> Work[tuple[Reference, Floats]]:
    """Return the reference, and the joint values at its start."""
    arm, setup, start = question.arm, question.setup, np.array(question.setup.start)
    if question.plan is not None:
        if known is None or known.question != question.plan:
            known = yield from _planned(question.plan)
        if known.motion is None:
            raise InputError(f"the planned motion cannot be run: {known.trouble}")
        return JointReference(known.motion), np.array(known.motion.at(0.0))
    if question.target:
        return FixedPose(np.frombuffer(question.target).reshape(4, 4), setup.duration), start
    pose, along = np.asarray(arm.fk(start), dtype=np.float64), direction(arm, setup)
    if setup.reference == "line":
        return LineReference(pose, setup.speed * along, setup.duration), start
    axis = arm.base[:3, 2]
    inwards = np.cross(axis, along)
    rate = setup.speed / setup.radius
    return CircleReference(pose, pose[:3, 3] + setup.radius * inwards, axis, rate, setup.duration), start


def reference_points(arm: Arm, setup: Setup) -> Floats:
    """Return points (k, 3) of a line or circle before it is run, world, metres; the first point of other references."""
    p, along = np.asarray(arm.position(np.array(setup.start)), dtype=np.float64), direction(arm, setup)
    if setup.reference == "line":
        return np.array([p, p + setup.speed * setup.duration * along])
    if setup.reference == "circle":
        inwards = np.cross(arm.base[:3, 2], along)
        return np.array([p, *(p + setup.radius * (inwards + way) for way in (inwards, along, -along))])
    return p[None]


def _planned(question: PlanQuestion) -> Work[Planned]:
    planned: Planned | None = None
    for found in planning(question):
        planned = found
        yield
    assert planned is not None
    return planned


def direction(arm: Arm, setup: Setup) -> Floats:
    """Return the unit vector (3,), in the world, of azimuth and elevation in frame 0; a circle has no elevation."""
    up = setup.elevation if setup.reference == "line" else 0.0
    level = math.cos(up)
    local = [level * math.cos(setup.azimuth), level * math.sin(setup.azimuth), math.sin(up)]
    return np.asarray(arm.base[:3, :3] @ np.array(local))


def settings_of(arm: Arm, setup: Setup) -> Settings:
    """Return the settings of the simulation."""
    return Settings(
        setup.step,
        setup.integrator,
        setup.inverse,
        dict(setup.inverse_options),
        dict(setup.law_options),
        setup.null,
        setup.null_gain,
        _plant(arm, setup),
    )


def _plant(arm: Arm, setup: Setup) -> Plant:
    return plant(
        arm,
        sampling=setup.sampling,
        saturation=setup.saturation,
        speed_limits=speed_limits(arm, setup),
        encoder=encoder(setup.counts, setup.shaft, setup.ratio) if setup.counts else None,
        wrong_by=setup.wrong,
        link=setup.link,
        pushes=tuple(Push(t, (x, y, z)) for t, x, y, z in setup.pushes),
    )


def speed_limits(arm: Arm, setup: Setup) -> Floats:
    """Return the limits of the joint speeds of a run, (n,): those of the arm unless others are given."""
    limits = np.array(arm.speed_limits)
    for turns, given in ((True, setup.limit), (False, setup.slide_limit)):
        if given is not None:
            limits[arm.revolute == turns] = given
    return limits


def figures_of(run: Run) -> Figures:
    """Return the figures of a run."""

    def peak(values: Floats) -> Peak:
        k = int(np.argmax(values))
        return Peak(float(values[k]), float(run.t[k]))

    least = int(np.argmin(run.sigma_min))
    return Figures(
        tuple(peak(np.abs(run.qdot[:, i])) for i in range(run.arm.n)),
        peak(run.error_position),
        peak(run.error_rotation),
        float(run.error_position[-1]),
        float(run.error_rotation[-1]),
        Peak(float(run.sigma_min[least]), float(run.t[least])),
        run.saturated_time,
        run.steps,
        run.duration,
        run.left_range(),
    )


def _predicted(setup: Setup, run: Run) -> Floats | None:
    """Return the error that 7.24 predicts for a law of the joints on a plant without disturbances.

    Regulation has no feed-forward: after a reference that moves it keeps an error, of which the equation knows nothing.
    """
    disturbed = setup.counts or setup.wrong or setup.pushes or setup.sampling or setup.saturation != "none"
    lags = setup.law == "joint_regulation" and setup.moves
    if lags or setup.kind.space != "joints" or disturbed or run.error_joint is None or not run.arm.task.position:
        return None
    K = setup.kind.prepare(ScaledTask(run.arm), setup.kind.options(dict(setup.law_options)))["K"]
    error = predicted_error(run.arm, run.t, run.q, K, run.error[0])
    place, _ = ScaledTask(run.arm).kinds(error)
    return place
