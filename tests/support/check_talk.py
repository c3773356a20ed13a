"""What the lab says of checks: every kind of check, in every state that it tells apart."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from armlab.benches.motion.plan.seen_motion import SeenMotion, SeenMove
from armlab.content.check import PLAIN, Words, read_check
from armlab.content.checks.joints_found import JointsFound
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.content.seen_fact import SeenFact, Value
from armlab.kin.convert import converted
from armlab.kin.dh import Row
from armlab.kin.rotations import rotation_from_sequence
from armlab.kin.transforms import transform

IN_OTHER_UNITS = Words(lambda metres: f"{1000.0 * metres:.1f} mm", lambda radians: f"{radians:.3f} rad")

JOINTS = (
    (
        "planar_2r",
        'kind = "joint_at"\njoint = 2\nvalue_deg = 60',
        ((60, 10), (60, -60), (0, math.radians(60)), (0, 60)),
    ),
    ("planar_3r", "q_deg = [10, 40, 90]", ((0, 40, 9), (-10, 4, 9), (90, 40, 10), (40, 10, 90), (-10, -40, -90))),
    ("planar_3r", "q_deg = [10, 40, 90]", ((10, 40, 80), (1, 2, 3), (10, 3, 90), (10, -40, 5), (10, 40, 90))),
    ("planar_2r", "q_deg = [0, 90]", ((90, -90), (1, 90), (5, 5))),
)
"""Configurations, degrees, for checks of joints; all joints are asked for where there is no kind."""

LINES = tuple(
    f'kind = "on_line"\nshape = "{shape}"\npoint = [0.5, 0, 0]\ntolerance_m = 0.01\n{more}'
    for shape, more in (
        ("line", "direction = [0, 1, 0]"),
        ("plane", "normal = [1, 0, 0]"),
        ("circle", "normal = [0, 0, 1]\nradius = 0.3"),
    )
)

OF_ARMS: tuple[tuple[str, str, tuple[tuple[float, ...], ...]], ...] = (
    *((robot, text + "\ntolerance_deg = 1", states) for robot, text, states in JOINTS if "kind" in text),
    *(
        (robot, f'kind = "{kind}"\n{text}\ntolerance_deg = 1', states)
        for kind in ("joints_at", "joints_found")
        for robot, text, states in JOINTS
        if "kind" not in text
    ),
    ("scara", 'kind = "joint_at"\njoint = 3\nvalue_m = 0.1\ntolerance_m = 0.005', ((0, 0, math.degrees(-0.1), 0),)),
    ("puma560", 'kind = "joints_found"\nq_deg = [0, 90, -90, 0, 30, 0]\ntolerance_deg = 1', ((0, 90, -90, 3, 9, 7),)),
    ("planar_2r", 'kind = "joints_at"\nq_deg = [0, 90]\ntolerance_deg = 1\nturns = true', ((0, -270),)),
    ("planar_2r", 'kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.01\nphi_deg = 180', ((0, 90),)),
    ("elbow_3r", 'kind = "branch"\nshoulder = "front"', ((0, 90, 0),)),
    (
        "planar_2r",
        'kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.01\nphi_deg = 0',
        ((0, 90), (90, -90), (5, 9)),
    ),
    (
        "planar_3r",
        'kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.5\nphi_deg = 90',
        ((0, 90, -90), (0, 90, 90)),
    ),
    *(("planar_2r", text, ((0, 0), (60, 80), (90, 90), (0, 120), (-66.42, 132.84))) for text in LINES),
    ("planar_2r", 'kind = "manipulability_at_least"\nvalue = 0.5', ((0, 20), (0, 0), (0, 90))),
    ("planar_2r", 'kind = "manipulability_at_most"\nvalue = 0.5', ((0, 20), (0, 90))),
    ("planar_2r", 'kind = "singular"', ((0, 20), (0, 0))),
    ("planar_2r", 'kind = "singular"\nwant = false', ((0, 20), (0, 0))),
    ("planar_2r", 'kind = "rank"\nvalue = 1', ((0, 20), (0, 0))),
    ("planar_2r", 'kind = "rank"\nvalue = 2', ((0, 0),)),
    ("planar_2r", 'kind = "rank"\nvalue = 0', ((0, 20),)),
    ("planar_2r", 'kind = "from_limits"\nat_least_deg = 30', ((170, 0), (0, 0))),
    ("scara", 'kind = "from_limits"\nat_least_m = 0.05', ((0, 0, 0, 0),)),
    ("planar_2r", 'kind = "branch"\nelbow = "up"', ((0, 90), (0, 0), (0, -90))),
    ("planar_2r", 'kind = "branch"\nelbow = "down"', ((0, 90), (0, 0), (0, -90))),
    *(
        (
            "puma560",
            f'kind = "branch"\n{text}',
            ((0, 90, -90, 0, 40, 0), (0, -150, 30, 0, -40, 0), (0, 90, -90, 0, 0, 0)),
        )
        for text in (
            *('elbow = "up"', 'elbow = "down"', 'shoulder = "left"', 'shoulder = "right"'),
            *('shoulder = "front"', 'shoulder = "back"', 'wrist = "positive"', 'wrist = "negative"'),
        )
    ),
    (
        "planar_2r",
        'kind = "all_of"\n[[checks]]\nkind = "singular"\n[[checks]]\nkind = "from_limits"\nat_least_deg = 30',
        ((0, 0), (170, 0)),
    ),
)
"""Robots, checks, and configurations in degrees in which they are judged."""

RUNS = SeenMotion(3, (SeenMove("joint", "line", "quintic"),) * 2, planned=True, whole=True, within=True, duration=5.0)

MOTIONS = (
    *(SeenMotion(), replace(RUNS, whole=False), replace(RUNS, whole=False, trouble="a path of the motion"), RUNS),
    *(replace(RUNS, within=False, fastest=6.0), replace(RUNS, within=False)),
    *(replace(RUNS, played=True), replace(RUNS, time=2.0)),
    *(replace(RUNS, duration=1.0), replace(RUNS, duration=99.0), replace(RUNS, deviation=0.2), replace(RUNS, moves=())),
    *(replace(RUNS, velocity=0.9), replace(RUNS, acceleration=0.9), replace(RUNS, waypoints=1, moves=())),
    *(replace(RUNS, raised=f"The limit of {name} of joint 2 was raised.") for name in ("velocity", "acceleration")),
    replace(RUNS, moves=(SeenMove("cartesian", "overfly", "cubic"),)),
)

OF_MOTIONS = (
    'kind = "motion_runs"\nat_most_s = 9\nat_least_s = 3\nwaypoints = 2\ndeviation_m = 0.1',
    'kind = "motion_runs"\nvelocity_percent = 60\nacceleration_percent = 60',
    'kind = "motion_played"',
    *(f'kind = "move_is"\n{text}' for text in ('space = "joint"', 'space = "cartesian"', "to = 9\nspace = 'joint'")),
    *(f'kind = "move_is"\n{text}' for text in ('path = "overfly"', 'law = "cubic"', "path = 'line'")),
)

POSES = (
    (1.0, 0.2, 0.3),
    (-1.0, 0.2, 0.3),
    (1.0, -0.2, 0.3),
    (-1.0, -0.2, 0.3),
    (0.2, 1.0, 0.3),
    (1.0, 0.2, -0.3),
    (1.0, 0.3, 0.3),
    (1.0, 0.2, 0.5),
)
"""Points in metres: the one asked for, those with a mistake that is recognised, and, last, another one."""

TURNS = ((20, 40, 60), (60, 40, 20), (0, 0, 90), (0, 0, -90), (0, 90, 0), (180, 0, 90), (20, 50, 60))
"""Roll, pitch and yaw in degrees."""

FACTS: tuple[tuple[str, Value | None], ...] = (
    *(("value = 2\ntolerance = 0.5", value) for value in (None, 1.0)),
    *(("at_least = 2\nat_most = 3", value) for value in (1.0, 4.0)),
    *(
        *(("at_most = 3", value) for value in (4.0, 3.00001)),
        *(("at_least = 3", value) for value in (1.0, 2.99999)),
        ("value = true", False),
        ("value = false", True),
        ('value = "one"', "other"),
    ),
    *(("value = [1, 2]\ntolerance = 0.1", (1.0, 3.0)), ("component = 2\nvalue = 2", (1.0, 3.0))),
    *(("component = 3\nvalue = 2", value) for value in ((1.0, 3.0), (1.0,))),
)


def said_of_checks() -> Iterator[str]:
    """Yield what is said of all of them."""
    for words in (PLAIN, IN_OTHER_UNITS):
        yield from (check.says(seen, words) for check, seen in _judged())


def _judged() -> Iterator[tuple[Any, Observation]]:
    for robot, text, states in OF_ARMS:
        check, arm = _check(text, robot), catalogue()[robot].arm
        for state in states:
            yield check, Observation.of(arm, np.radians(state))
    three, two = catalogue()["planar_3r"].arm, catalogue()["planar_2r"].arm
    for text in ("joints_at", "joints_found"):
        yield _check(f'kind = "{text}"\nq_deg = [0, 90]\ntolerance_deg = 1'), Observation.of(three, [0, 0, 0])
    yield (
        _check('kind = "joint_at"\njoint = 3\nvalue_deg = 60\ntolerance_deg = 1', "planar_3r"),
        Observation.of(two, [0, 0]),
    )
    yield _check('kind = "from_limits"\nat_least_deg = 9'), Observation.of(three, [0, 0, 0])
    one = JointsFound(np.array([1.0]), np.array([0.01]), np.array([True]))
    yield one, Observation.of(type(two).from_dh([("R", 1.0, 0.0, 0.0, 0.0)]), [0.0])
    bare = Observation.of(two, [0.3, 0.6])
    for text in OF_MOTIONS:
        check = _check(text, "puma560")
        yield from (
            (check, replace(bare, benches=benches)) for benches in ({}, *({"motion": motion} for motion in MOTIONS))
        )
    for text, value in FACTS:
        fact = SeenFact("the rank of the Jacobian", "", value)
        word = "velocity.statics.torques"
        yield _check(f'kind = "fact"\nfact = "{word}"\n{text}'), replace(bare, facts={})
        yield _check(f'kind = "fact"\nfact = "{word}"\n{text}'), replace(bare, facts={word: fact})
    for text in ('panel = "joints"', 'switch = "frames"', 'film = "dh"'):
        yield _check(f'kind = "looked_at"\n{text}'), bare
        yield (
            _check(f'kind = "looked_at"\n{text}'),
            replace(bare, panel="joints", switches=frozenset({"frames"}), films=frozenset({"dh"})),
        )
    within = 'kind = "within_seconds"\nat_most_s = 10'
    yield from ((_check(within), replace(bare, seconds=seconds)) for seconds in (5.0, 20.0))
    yield from _of_poses(bare)
    yield from _of_tables()


def _of_poses(bare: Observation) -> Iterator[tuple[Any, Observation]]:
    place = "position = [1.0, 0.2, 0.3]\ntolerance_m = 0.01\n"
    bare_place = _check(f'kind = "target_at"\n{place}', "ur10")
    yield bare_place, bare
    yield bare_place, replace(bare, target=np.eye(4))
    for kind, rpy in (("target_at", TURNS[0]), ("tool_pose", TURNS[0]), ("tool_pose", TURNS[2])):
        check = _check(f'kind = "{kind}"\n{place}rpy_deg = {list(rpy)}\ntolerance_deg = 2', "ur10")
        right = _turned(rpy)
        tried = [(position, R) for position in POSES[1:] for R in (right, right.T)]
        tried.append((POSES[0], np.asarray(rotation_from_sequence("xyz", np.radians(rpy)))))
        tried += [(POSES[0], R) for turn in TURNS for R in (_turned(turn), _turned(turn).T)]
        for pose in (transform(R, position) for position, R in tried):
            yield check, replace(bare, target=pose, tool_pose=pose)


def _turned(rpy: tuple[float, ...]) -> np.ndarray:
    return np.asarray(rotation_from_sequence("xyz", np.radians(rpy), fixed=True))


def _of_tables() -> Iterator[tuple[Any, Observation]]:
    rows = '[[rows]]\ntype = "R"\na = 0.4\nalpha_deg = 90\nd = 0.1\n[[rows]]\ntype = "R"\na = 0.3\ntheta_deg = 45\n'
    check = _check(f'kind = "table_is"\n{rows}')
    arm = catalogue()["planar_2r"].arm
    right = (Row("R", 0.4, math.pi / 2, 0.1, 0.0), Row("R", 0.3, 0.0, 0.0, math.pi / 4))
    first, second = right
    for tried in (
        *(right, right[:1], (replace(first, kind="P"), second), (first, replace(second, kind="P"))),
        *((replace(first, a=value), second) for value in (0.41, -0.4, 400.0, 0.0004)),
        *((replace(first, alpha=value), second) for value in (1.0, -math.pi / 2, math.radians(math.pi / 2))),
        *((first, replace(second, theta=math.pi * 1.25)), (replace(first, a=0.1, d=0.4), second)),
        *((replace(first, alpha=0.0, theta=math.pi / 2), second), (replace(first, d=0.3), second)),
        (Row("R", 0.0, 0.0, 0.1, 0.0), Row("R", 0.4, math.pi / 2, 0.0, math.pi / 4)),
    ):
        made = type(arm).from_dh(tried)
        yield check, Observation.of(made, np.zeros(made.n))
    yield check, Observation.of(converted(type(arm).from_dh(right), "modified"), np.zeros(2))
    modified = _check(f'kind = "table_is"\nconvention = "modified"\n{rows}')
    yield modified, Observation.of(type(arm).from_dh(right), np.zeros(2))
    moved = (Row("R", 0.3, 0.0, 0.1, 0.0), Row("R", 0.0, 0.0, 0.0, math.pi / 4))
    yield modified, Observation.of(type(arm).from_dh(moved, "modified"), np.zeros(2))
    slide = _check('kind = "table_is"\n[[rows]]\ntype = "P"\nalpha_deg = 2')
    for kind, alpha in (("R", 0.5), ("P", 2.0)):
        yield slide, Observation.of(type(arm).from_dh([(kind, 0.0, alpha, 0.0, 0.0)]), np.zeros(1))


def _check(text: str, robot: str = "planar_2r") -> Any:
    return read_check(Table.parse("test.md", text), catalogue()[robot])
