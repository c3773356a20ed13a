"""Motions: a path with a timing law, and what can be known and done with them (chapter 6 of the notes).

A path q(s) comes from `path_type`, a law s(t) from `law_type`; together they are a `Trajectory`. `coordinated` and
`independent` go from one configuration to another; `follow` solves the inverse kinematics along a `ToolPath`. How fast
joints may be is said by `Limits`, or by an arm that has limits of its own; `run_along` keeps them.

>>> from armlab.kin.motion import Trajectory, law_type, path_type
>>> path = path_type("spline").path([[0.0, 0.0], [1.0, 0.5], [2.0, 0.0]])
>>> motion = Trajectory(path, law_type("quintic").law(duration=2.0))
>>> motion.at([0.0, 2.0]).tolist()
[[0.0, 0.0], [2.0, 0.0]]
"""

from armlab.kin.motion.bounds import LawBounds, law_bounds
from armlab.kin.motion.coordinated import coordinated, independent
from armlab.kin.motion.follow import follow
from armlab.kin.motion.followed import Followed, Stop
from armlab.kin.motion.geometry import ArcLength, ByLength, Frenet, curvature, frenet, standstills, torsion
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import LawType, free_law_types, law_type, law_types
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.minimum_time import MinimumTime, minimum_time_spline
from armlab.kin.motion.orientation import Orientation, about_one_axis, by_euler_angles, held, swept, wandering
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType, path_type, path_types
from armlab.kin.motion.peaks import Violation, peaks, violations
from armlab.kin.motion.run_along import run_along
from armlab.kin.motion.scaling import Scaling, as_fast_as_allowed, optimal_scaling, scaled
from armlab.kin.motion.sequence import Hold, Separate, Sequential, Slowed
from armlab.kin.motion.through import Through
from armlab.kin.motion.tool_path import ToolPath
from armlab.kin.motion.trajectory import Motion, Samples, Trajectory

__all__ = [
    "ArcLength",
    "ByLength",
    "Followed",
    "Frenet",
    "Hold",
    "Law",
    "LawBounds",
    "LawType",
    "Limits",
    "MinimumTime",
    "Motion",
    "Orientation",
    "Path",
    "PathType",
    "Samples",
    "Scaling",
    "Separate",
    "Sequential",
    "Slowed",
    "Stop",
    "Through",
    "ToolPath",
    "Trajectory",
    "Violation",
    "about_one_axis",
    "as_fast_as_allowed",
    "by_euler_angles",
    "coordinated",
    "curvature",
    "follow",
    "free_law_types",
    "frenet",
    "held",
    "independent",
    "law_bounds",
    "law_type",
    "law_types",
    "minimum_time_spline",
    "optimal_scaling",
    "path_type",
    "path_types",
    "peaks",
    "run_along",
    "scaled",
    "standstills",
    "swept",
    "torsion",
    "violations",
    "wandering",
]
