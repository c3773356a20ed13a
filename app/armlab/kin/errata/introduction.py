"""Trials of chapters 1 and 2: velocities of joints, profiles, the matrix exponential, motors, gears and encoders."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import expm  # type: ignore[import-untyped]

from armlab.kin.errata.arms import differences, jacobian_2r, point_2r, point_polar
from armlab.kin.errata.draws import Floats, Generator, matrix, orthogonal, signed, two_links
from armlab.kin.errata.trial import Forms, Quiet, Trial

MEANT = ((1, 0, 1), (-1, 1, 3), (1, 3, 4), (-1, 4, 5), (1, 5, 7), (-1, 7, 8))
"""Intervals of 1.41 as they are meant, one after the other: acceleration, beginning and end, s."""

PRINTED = ((1, 0, 1), (-1, 1, 3 / 8), (1, 3 / 8, 4), (-1, 4, 5 / 8), (1, 5 / 8, 7 / 8), (-1, 7 / 8, 8))
"""The same intervals as they are printed."""

MOMENTS = 400
"""Number of random times at which the intervals of 1.41 are looked at."""

STEPS = 20
"""Number of steps of the simulated motors."""


def _along_the_axis(d1: float, q: Floats, joint: int) -> Forms:
    """1.2: the part along its own axis of what a joint gives the tool, per unit of its speed."""
    slope = differences(lambda each: point_polar(d1, each), q)[:, joint]
    s1, c1 = np.sin(q[0]), np.cos(q[0])
    axes = [[0.0, 0.0, 1.0], [s1, -c1, 0.0], [c1 * np.cos(q[1]), s1 * np.cos(q[1]), np.sin(q[1])]]
    return Forms(0.0, float(joint == 2), slope @ np.array(axes[joint]))


def _polar(rng: Generator, joint: int) -> tuple[float, Floats, int]:
    return float(rng.uniform(0.3, 1.0)), np.array([*rng.uniform(-1.4, 1.4, 2), rng.uniform(0.3, 1.0)]), joint


def _columns(l1: float, l2: float, q1: float, q2: float, rates: Floats) -> Forms:
    """1.18: the velocity of the tool of a 2R from the contributions of its joints."""
    j1, j2 = jacobian_2r(l1, l2, [q1, q2]).T
    by_differences = differences(lambda q: point_2r(l1, l2, q), [q1, q2])
    return Forms(np.vstack([j1, j2]) @ rates, np.column_stack([j1, j2]) @ rates, by_differences @ rates)


def _closeness(J: Floats) -> Forms:
    """1.19: how far the rows are from being parallel, 1 for a right angle with equal lengths."""
    squares = np.linalg.eigvalsh(J @ J.T)
    return Forms(abs(float(np.linalg.det(J))), 1.0 / np.linalg.cond(J), math.sqrt(squares[0] / squares[1]))


def _small_links(rng: Generator) -> tuple[Floats]:
    return (matrix(rng, 2, 2, 0.8, 1.2) * 10.0 ** rng.uniform(-3.0, -1.5),)


def _unclear(intervals: tuple[tuple[float, float, float], ...], times: Floats) -> float:
    """Return the share of some times at which the acceleration has no value, or two."""
    held = [
        np.any([(times >= a) & (times < b) for sign, a, b in intervals if sign * sense > 0], axis=0)
        for sense in (1, -1)
    ]
    return float(np.mean(held[0] == held[1]))


def _intervals(unit: float, size: float, times: Floats) -> Forms:
    """1.41: the share of the time without exactly one acceleration, and speed and place at the end."""
    lengths = unit * np.array([b - a for _, a, b in MEANT])
    speed, place = _end_of(lengths, size * np.array([sign for sign, *_ in MEANT]))
    return Forms(_unclear(PRINTED, times), max(_unclear(MEANT, times), abs(speed), abs(place)), 0.0)


def _end_of(lengths: Floats, accelerations: Floats) -> tuple[float, float]:
    """Return speed and place after pieces of constant acceleration, from rest."""
    speed = place = 0.0
    for h, a in zip(lengths.tolist(), accelerations.tolist(), strict=True):
        place, speed = place + speed * h + a * h * h / 2.0, speed + a * h
    return speed, place


def _change_of_speed(lengths: Floats, accelerations: Floats) -> Forms:
    """1.42: the change of speed of a profile of constant accelerations, from rest."""
    speed, place = _end_of(lengths, accelerations)
    return Forms(place, float(lengths @ accelerations), speed)


def _exponential(T: Floats, decay: Floats, t: float) -> Forms:
    """1.58: e^(A t) of A = T Lambda T^-1."""
    back, middle = np.linalg.inv(T), np.diag(np.exp(decay * t))
    return Forms(back @ middle @ T, T @ middle @ back, expm(T @ np.diag(decay) @ back * t))


def _motor(R: float, L: float, k: float, inertia: float, friction: float) -> Floats:
    """Return the matrix A of (i, omega, theta), notes 2.10."""
    return np.array([[-R / L, -k / L, 0.0], [k / inertia, -friction / inertia, 0.0], [0.0, 1.0, 0.0]])


def _state(A: Floats, apart: float, t: float) -> Forms:
    """2.12: the angle between the shafts of two motors that differ in their angle alone, from their states."""
    both = np.array([[0.5, 0.5], [2.0, 2.0], [0.0, apart]])
    told = (A @ both)[:, 1] - (A @ both)[:, 0]  # of the printed states, and so of all that follows from them
    from_states = expm(A * t) @ (both[:, 1] - both[:, 0])
    h, x = t / STEPS, both
    for _ in range(STEPS):  # the midpoint rule
        x = x + h * A @ (x + h / 2.0 * A @ x)
    return Forms(float(np.abs(told).max()), from_states[2], x[2, 1] - x[2, 0])


def _two_motors(rng: Generator) -> tuple[Floats, float, float]:
    R, L, k, inertia, friction = rng.uniform([0.5, 0.05, 0.05, 0.01, 0.01], [2.0, 0.2, 0.5, 0.1, 0.1])
    return _motor(R, L, k, inertia, friction), float(signed(rng, 0.2, 3.0)), float(rng.uniform(0.2, 1.0))


def _speed_per_volt(R: float, k: float, friction: float) -> Forms:
    """2.20: the speed that one volt comes to, in parts of that of 2.10."""
    _, speed = np.linalg.solve([[R, k], [k, -friction]], [1.0, 0.0])
    return Forms(k / (R * friction) / speed, k / (R * friction + k * k) / speed, 1.0)


def _harmonic(teeth: int) -> Forms:
    """2.29: turns of the wave generator for one turn of the flexspline."""
    circular = teeth + 2
    meshed = teeth - circular  # in one turn of the wave generator, counted in teeth
    return Forms(teeth / 2.0, -teeth / 2.0, 1.0 / (meshed / teeth))


def _ratio(motor: float, load: float, a: float, n: float) -> Forms:
    """2.38: the derivative of the torque by the reduction ratio, N m."""

    def torque(ratio: float) -> float:
        return (motor * ratio + load / ratio) * a

    h = 1e-4 * n
    slope = (torque(n + h) - torque(n - h)) / (2.0 * h)
    return Forms((motor + load / n**2) * a, (motor - load / n**2) * a, slope)


def _gear(rng: Generator) -> tuple[float, float, float, float]:
    motor, load, a = rng.uniform([1e-3, 0.5, 1.0], [2e-2, 5.0, 10.0]).tolist()
    return motor, load, a, math.sqrt(load / motor) * float(rng.uniform(0.5, 2.0))


def _waves(phase: Floats) -> tuple[Floats, Floats]:
    """Return the signals A and B of an encoder at electrical angles in parts of a cycle; A leads B by a quarter."""
    return (phase % 1.0 < 0.5).astype(float), ((phase - 0.25) % 1.0 < 0.5).astype(float)


def _leads(sense: float, start: float) -> float:
    """Return +1 if A leads B, -1 if B leads A, from the level of B where A rises."""
    A, B = _waves(start + sense * np.linspace(0.0, 2.0, 2001))
    rise = int(np.flatnonzero(np.diff(A) > 0.0)[0]) + 1
    return 1.0 if B[rise] == 0.0 else -1.0


def _direction(start: float) -> Forms:
    """2.AB: the sense of rotation that is told of a shaft that turns forward, and of one that turns back."""
    return Forms([1.0, 1.0], [_leads(1.0, start), _leads(-1.0, start)], [1.0, -1.0])


def _edges(phase: Floats, rising: bool, falling: bool, of_b: bool) -> Floats:
    """Return the places of the counted edges, in parts of a cycle from the first place."""
    A, B = _waves(phase)
    steps = [np.diff(A)] + ([np.diff(B)] if of_b else [])
    hits = [np.flatnonzero((rising & (step > 0.0)) | (falling & (step < 0.0))) for step in steps]
    return np.sort(phase[np.concatenate(hits)])


def _per_pulse(pulses: int, by: int, start: float) -> Forms:
    """2.AR: the angle of one counted edge, degrees."""
    edges = _edges(start + np.linspace(0.0, 9.0, 36001), True, by > 1, by > 2)
    between = 360.0 / pulses * float(edges[-1] - edges[0]) / (len(edges) - 1)
    return Forms(float(pulses), 360.0 / (pulses * by), between)


def _unevenness(start: float) -> Forms:
    """2.D2: the largest gap between counted edges, in parts of the even one, less 1."""
    phase = start + np.linspace(0.0, 6.0, 24001)
    gaps = [np.diff(_edges(phase, True, falling, of_b)) for falling, of_b in ((False, True), (True, False))]
    return Forms(gaps[0].max() / 0.5 - 1.0, gaps[1].max() / 0.5 - 1.0, 0.0)


def _changing_bits(tracks: int) -> Forms:
    """2.40: the most bits that change between two neighbouring sectors."""
    sectors = np.arange(2**tracks)
    codes = (sectors, sectors ^ (sectors >> 1))
    most = [max(int(each).bit_count() for each in code ^ np.roll(code, 1)) for code in codes]
    return Forms(float(most[0]), float(most[1]), 1.0)


TRIALS = (
    Trial(
        "1.2",
        "a configuration of the polar arm, whose joint 3 slides",
        lambda rng: _polar(rng, 2),
        _along_the_axis,
        "part of the velocity along the joint's own axis, per unit of its speed",
        "central differences of the direct kinematics",
        1e-8,
        quiet=Quiet(lambda rng: _polar(rng, int(rng.integers(2))), "for the joints that turn"),
    ),
    Trial(
        "1.18",
        "a planar 2R and its joint speeds",
        lambda rng: (*two_links(rng), signed(rng, 0.3, 2.0, 2)),
        _columns,
        "velocity of the tool",
        "central differences of the direct kinematics",
        1e-7,
        "m/s",
    ),
    Trial(
        "1.19",
        "a well-conditioned 2 × 2 Jacobian of an arm of some millimetres or centimetres",
        _small_links,
        _closeness,
        "distance from singularity, from 0 to 1",
        "eigenvalues of J Jᵀ",
        1e-9,
    ),
    Trial(
        "1.41",
        "400 times between 0 and 8 s, the size of the acceleration and the unit of time",
        lambda rng: (*rng.uniform(0.5, 2.0, 2), rng.uniform(0.0, 8.0, MOMENTS)),
        _intervals,
        "share of the time without exactly one acceleration; of the correct form also speed and place at the end",
        "the answers of the notes themselves: both are 0",
    ),
    Trial(
        "1.42",
        "eight pieces of constant acceleration",
        lambda rng: (rng.uniform(0.5, 2.0, 8), signed(rng, 0.2, 2.0, 8)),
        _change_of_speed,
        "change of speed",
        "adding up the pieces one after the other",
        unit="m/s",
    ),
    Trial(
        "1.58",
        "eigenvectors, two decaying eigenvalues and a time",
        lambda rng: (
            matrix(rng, 2, 2) @ np.diag([1.0, 2.0]),
            -rng.uniform([0.2, 1.5], [1.0, 4.0]),
            rng.uniform(0.3, 1.0),
        ),
        _exponential,
        "largest difference of an entry",
        "scipy.linalg.expm",
        quiet=Quiet(
            lambda rng: (orthogonal(rng, 2), np.full(2, -rng.uniform(0.2, 2.0)), rng.uniform(0.3, 1.0)),
            "where both eigenvalues are the same",
        ),
    ),
    Trial(
        "2.12",
        "a motor, and the angle between its shaft and that of a second one",
        _two_motors,
        _state,
        "angle between both shafts some time later",
        "the motion of each motor by itself",
        unit="rad",
    ),
    Trial(
        "2.20",
        "a motor with a weak magnet and little friction",
        lambda rng: tuple(rng.uniform([0.5, 0.02, 1e-5], [3.0, 0.1, 1e-4]).tolist()),
        _speed_per_volt,
        "speed that one volt comes to, in parts of the right one",
        "the two equations of the motor at rest of its current",
    ),
    Trial(
        "2.29",
        "an even number of teeth of the flexspline",
        lambda rng: (2 * int(rng.integers(40, 160)),),
        _harmonic,
        "turns of the wave generator for one of the output, with sign",
        "counting teeth in one turn",
    ),
    Trial(
        "2.38",
        "both inertias, an acceleration, and a ratio about the best one",
        _gear,
        _ratio,
        "derivative of the torque by the ratio",
        "central differences of the torque",
        1e-8,
        "N m",
    ),
    Trial(
        "2.AB",
        "the angle at which a shaft starts, forward and back",
        lambda rng: (float(rng.uniform(0.01, 0.99)),),
        _direction,
        "sense of rotation that is told, +1 or −1",
        "the sense in which the shaft was turned",
    ),
    Trial(
        "2.AR",
        "pulses per round, the counting and the angle at the start",
        lambda rng: (int(rng.integers(200, 4000)), int(rng.choice((1, 2, 4))), float(rng.uniform(0.01, 0.99))),
        _per_pulse,
        "angle of one count",
        "edges of simulated signals",
        1e-4,
        "°",
    ),
    Trial(
        "2.D2",
        "the angle at the start",
        lambda rng: (float(rng.uniform(0.01, 0.99)),),
        _unevenness,
        "largest gap between counts over the even one, less 1",
        "edges of simulated signals, which are to be even",
        1e-6,
    ),
    Trial(
        "2.40",
        "a number of tracks",
        lambda rng: (int(rng.integers(3, 13)),),
        _changing_bits,
        "most bits that change at once between neighbours",
        "one bit at a time, as it is to be read safely",
    ),
)
"""The trials of both chapters."""
