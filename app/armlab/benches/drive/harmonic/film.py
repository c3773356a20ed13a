"""The film of a harmonic drive: three turns of the input, and what can be counted meanwhile."""

from __future__ import annotations

import math
from typing import NamedTuple

from armlab.benches.drive.harmonic.state import CLIP_KEY, TURN, TURNS, Harmonic
from armlab.kin.drive.strain_wave import StrainWave
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

DURATION = TURNS * TURN


class Counted(NamedTuple):
    """Turns and teeth that can be counted in the picture since the film began.

    Attributes
    ----------
    turns : float
        Turns of the input.
    passed_circular, passed_flexible : float
        Teeth of the circular spline, and of the flexspline, that one lobe of the wave generator has come past, counted
        in its sense.
    moved : float
        Teeth by which the marked tooth of the flexspline has moved along the circular spline, in its own teeth.
    out : float
        Turns of the output.
    """

    turns: float
    passed_circular: float
    passed_flexible: float
    moved: float
    out: float


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its start while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def turned_at(time: float) -> float:
    """Return the angle of the input, radians."""
    return 2.0 * math.pi * time / TURN


def counted(drive: StrainWave, theta: float) -> Counted:
    """Return what has passed when the input is turned by theta."""
    generator, flexible, circular = (each / (2.0 * math.pi) for each in drive.angles(theta))
    out = flexible if drive.output == "flexible" else circular
    return Counted(
        theta / (2.0 * math.pi),
        (generator - circular) * drive.circular,
        (generator - flexible) * drive.flexspline,
        (flexible - circular) * drive.flexspline,
        out,
    )


def counted_now(state: State) -> Counted:
    """Return what has passed at the present time of the film."""
    return counted(state[Harmonic].drive, turned_at(film_time(state)))
