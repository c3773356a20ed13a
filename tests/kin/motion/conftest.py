"""Examples of every path and every law found by folder, for the properties all of them share."""

from dataclasses import dataclass, field

import pytest

from armlab.kin.motion.law_types import free_law_types
from armlab.kin.motion.path_types import path_types


@dataclass(frozen=True)
class PathExample:
    """Options, what is claimed of the path, and which waypoints it meets."""

    options: dict = field(default_factory=dict)
    continuity: float = 3
    rest: int = 0
    """Derivatives that vanish at both ends."""
    meets: str = "all"
    m: int = 3
    knots: int = 2


PATHS = {
    "line": [PathExample()],
    "polyline": [PathExample(continuity=0, knots=5)],
    "hermite": [PathExample(continuity=1, rest=1, knots=5)],
    "circle": [PathExample(knots=3), PathExample({"full": True}, knots=3, meets="first", m=4)],
    "overfly": [
        PathExample(continuity=1, knots=5, meets="ends"),
        PathExample({"shape": "quartic", "speed": [1.0, 2.0, 0.5, 3.0]}, continuity=2, knots=5, meets="ends"),
        PathExample({"by": "time", "amount": 0.05, "speed": 2.0}, continuity=1, knots=4, meets="ends", m=2),
        PathExample({"amount": 0.0}, continuity=0, knots=4),
    ],
    "blends": [
        PathExample(continuity=1, rest=1, knots=5, meets="ends"),
        PathExample({"ends": "moving", "duration": 3.0}, continuity=1, knots=4, meets="ends", m=6),
        PathExample({"shape": "quartic"}, continuity=2, rest=2, knots=5, meets="ends"),
        PathExample({"blend": 0.0}, continuity=0, knots=4),
    ],
    "cubic": [PathExample(rest=1), PathExample({"v_start": [1, 2, 3], "v_end": [0, -1, 4], "duration": 2.0})],
    "quintic": [PathExample(rest=2), PathExample({"v_start": [1, 2], "a_end": [3, -1], "duration": 0.5}, m=2)],
    "polynomial": [
        PathExample({"degree": 7}, rest=3),
        PathExample({"degree": 15}, rest=3, m=1),
        PathExample({"start": [[1, 2, 3], [0, 1, 0]], "end": [[0, 1, 0]]}),
    ],
    "lts_434": [PathExample(continuity=2, rest=2, knots=4), PathExample({"times": [0, 1, 3, 4]}, 2, 2, "all", 6, 4)],
    "spline": [
        PathExample(continuity=2, rest=1, knots=7),
        PathExample({"ends": "natural", "spacing": "uniform"}, continuity=2, knots=6, m=1),
        PathExample({"ends": "both"}, continuity=2, rest=2, knots=5),
        PathExample({"v_start": [1, 0, 0], "times": [0, 0.2, 3, 3.1]}, continuity=2, knots=4),
    ],
    "interpolating": [PathExample(knots=6), PathExample({"spacing": "uniform"}, knots=11, m=1)],
    "harmonic": [PathExample(rest=1)],
    "cycloidal": [PathExample(rest=2)],
    "exponential": [PathExample(), PathExample({"rate": -4.0})],
    "clothoid": [PathExample(), PathExample({"turn": -3.0}, m=2), PathExample({"turn": 9.0, "normal": [1, 2, 3]})],
    "helix": [PathExample(), PathExample({"turns": -3.0, "radius": 0.7, "side": [1, -2, 1]})],
}
"""At least one example of each path in the folder."""

LAWS = {
    "constant": [({}, 3, 0)],
    "cubic": [({}, 3, 1)],
    "quintic": [({}, 3, 2)],
    "septic": [({}, 3, 3)],
    "trapezoidal": [({}, 1, 1), ({"ramp": 0.5}, 1, 1), ({"ramp": 0.1, "sdot_start": 0.2, "sdot_end": 0.4}, 1, 0)],
    "bang_bang": [({}, 1, 1)],
    "double_s": [({}, 2, 2), ({"rounding": 0.5, "ramp": 0.5}, 2, 2), ({"sdot_start": 0.3, "sdot_end": 0.1}, 2, 0)],
    "cosine": [({}, 3, 1)],
    "table": [({}, 1, 1), ({"rows": [[0, 1, 2], [1, 3, -0.5], [3, 4, 0], [4, 5, -1]]}, 1, 1)],
}
"""Options, the class inside, and the class from and to rest; at least one of each law that needs no path."""


def waypoints(example, rng):
    return rng.normal(size=(example.knots, example.m))


@pytest.fixture(params=[(key, k) for key in path_types() for k in range(len(PATHS.get(key, [None])))], ids=str)
def path_case(request, rng):
    """Kind, example, waypoints and path, for each example of each kind found."""
    key, k = request.param
    assert key in PATHS, f"{key}: add an example to this file"
    example = PATHS[key][k]
    knots = waypoints(example, rng)
    return path_types()[key], example, knots, path_types()[key].path(knots, **example.options)


@pytest.fixture(params=[(key, k) for key in free_law_types() for k in range(len(LAWS.get(key, [None])))], ids=str)
def law_case(request):
    """Kind, options, class inside and class from rest, for each example of each kind found."""
    key, k = request.param
    assert key in LAWS, f"{key}: add an example to this file"
    return free_law_types()[key], *LAWS[key][k]
