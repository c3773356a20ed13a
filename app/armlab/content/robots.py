"""Robot files: ``robots/*.toml``, one arm each, with its source and poses that verify it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources.abc import Traversable

import numpy as np
from numpy.typing import NDArray

from armlab import resources
from armlab.content.folder import Folder
from armlab.content.joint_limits import outside
from armlab.content.reader import Table, joint_values
from armlab.errors import ContentError, InputError
from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.dh import CONVENTIONS, Row, common_normals
from armlab.kin.rotations import is_rotation, rotation_from_sequence
from armlab.kin.task import NAMED
from armlab.kin.transforms import transform

KEY = re.compile(r"[a-z0-9][a-z0-9_]{0,63}\Z")
"""Pattern of keys, which are part of links, in lower case so that they are easy to say and type."""

TAKEN = ("random",)
"""Names that poses cannot have, as their buttons do something else. The button "zero" first looks for such a pose."""

LOOSEST = 1e-3
"""Largest tolerance of an expected pose: a millimetre. With a larger one a wrong table could pass."""

FARTHEST_CAMERA = 100.0
"""Largest factor of the distance of a camera; from there an arm is a dot."""

FAMILIES = ("planar", "spatial 3R to 5R", "with sliding joints", "six joints", "seven joints and more")


@dataclass(frozen=True, eq=False)
class Expected:
    """A pose from a data sheet, a paper or a closed form that the table must reproduce.

    Attributes
    ----------
    q : ndarray, shape (n,)
    T : ndarray, shape (4, 4)
        Rotation rows are NaN when only the position is given.
    flange : bool
        Whether the pose is of frame n instead of the tool.
    tolerance : float
        Tolerance of every entry; metres for the position.
    source : str
    """

    q: NDArray[np.float64]
    T: NDArray[np.float64]
    flange: bool
    tolerance: float
    source: str


@dataclass(frozen=True)
class Camera:
    """First view of the arm: angles in degrees, and a factor of the distance."""

    azimuth_deg: float
    elevation_deg: float
    distance: float


DEFAULT_CAMERA = Camera(-50.0, 22.0, 1.0)


@dataclass(frozen=True, eq=False)
class Robot:
    """A robot file.

    Attributes
    ----------
    key : str
        File name without its ending.
    name, family, summary, source : str
    words : tuple of str
        Other words by which it is found, such as its maker.
    arm : Arm
    poses : dict
        Named configurations; the first is where the arm stands when it is chosen.
    expected : tuple of Expected
    camera : Camera
    """

    key: str
    name: str
    family: str
    summary: str
    source: str
    arm: Arm
    poses: dict[str, NDArray[np.float64]]
    expected: tuple[Expected, ...]
    camera: Camera
    words: tuple[str, ...] = ()

    @property
    def home(self) -> NDArray[np.float64]:
        """The first named pose, shape (n,), rad and m."""
        return next(iter(self.poses.values()))


def parse_robot(key: str, text: str, file: str | None = None, *, proven: bool = True) -> Robot:
    """Read the text of a robot file.

    Parameters
    ----------
    key, text : str
    file : str, optional
        Its name in messages.
    proven : bool
        Whether expected poses must prove the table. A student's own arm may come without any; it may come without
        named poses, too, and then stands with every joint at 0 or at the limit nearest to it.

    Raises
    ------
    ContentError
        Anything wrong, with file, key, what was expected and what is available.
    """
    file = file or f"{key}.toml"
    if not KEY.match(key):
        raise ContentError(
            file,
            "",
            f"expected a file name of lower-case letters, digits and underscores, got {key!r}; rename the file",
        )
    top = Table.parse(file, text)
    name, summary = top.text("name"), top.text("summary")
    family, source = top.choice("family", FAMILIES), top.text("source")
    convention = next(c for c in CONVENTIONS if c == top.choice("convention", CONVENTIONS))
    task = top.choice("task", NAMED) if top.has("task") else None
    joints = top.tables("joints")
    if not 1 <= len(joints) <= MAX_JOINTS:
        raise top.fail("joints", f"expected 1 to {MAX_JOINTS} tables [[joints]], got {len(joints)}")
    base, tool, camera = read_pose(top.table("base")), read_pose(top.table("tool")), top.table("camera")
    rows, limits, speeds, accelerations = zip(*map(_joint, joints), strict=True)
    try:
        arm = Arm.from_dh(rows, convention, base, tool, limits, speeds, accelerations, task, name)
    except InputError as error:
        raise ContentError(file, "", str(error)) from None
    kinds = "".join(row.kind for row in rows)
    robot = Robot(
        key=key,
        name=name,
        family=family,
        summary=summary,
        source=source,
        arm=arm,
        poses=dict(_named_poses(top, arm, kinds, required=proven)) or {"home": _rest(arm)},
        expected=tuple(_expected(table, kinds) for table in top.tables("expected")),
        camera=DEFAULT_CAMERA if camera is None else read_camera(camera),
        words=top.texts("words"),
    )
    if proven and len(robot.expected) < 2:
        raise top.fail("expected", f"give at least two poses that prove the table, got {len(robot.expected)}")
    top.done()
    return robot


def _turn(table: Table, key: str) -> float:
    """Return an angle of the table in radians."""
    degrees = table.number(key, 0.0)
    if abs(degrees) > 360.0:
        raise table.fail(key, f"expected -360 to 360, got {degrees:g}")
    return float(np.radians(degrees))


def _joint(table: Table) -> tuple[Row, tuple[float, float], float, float]:
    kind = table.choice("type", ("R", "P"))
    revolute = kind == "R"
    row = Row(
        "R" if revolute else "P",
        a=table.number("a", 0.0),
        alpha=_turn(table, "alpha_deg"),
        d=table.number("d", 0.0),
        theta=_turn(table, "theta_deg"),
    )
    unit, factor = ("deg", float(np.pi) / 180.0) if revolute else ("m", 1.0)
    low, high = table.numbers(f"limits_{unit}", 2)
    if low > high:
        raise table.fail(f"limits_{unit}", f"the smaller comes first, got [{low:g}, {high:g}]")
    bounds = []
    for key in (f"speed_{unit}_s", f"acceleration_{unit}_s2"):
        bound = table.number(key) if table.has(key) else np.inf
        if bound <= 0:
            raise table.fail(key, f"expected a positive number, got {bound:g}")
        bounds.append(bound * factor)
    table.done()
    return row, (float(low) * factor, float(high) * factor), bounds[0], bounds[1]


def read_pose(table: Table | None) -> NDArray[np.float64]:
    """Read ``position`` in metres and ``rpy_deg``: roll, pitch, yaw with R = Rz(yaw) Ry(pitch) Rx(roll).

    Three rows ``rotation`` may stand in place of the angles.

    Returns
    -------
    ndarray, shape (4, 4)
        The identity without a table.
    """
    if table is None:
        return np.eye(4)
    position = table.numbers("position", 3, [0.0, 0.0, 0.0])
    if table.has("rotation"):
        R = table.matrix("rotation")
        if not is_rotation(R):
            raise table.fail("rotation", "expected a rotation matrix: orthonormal, determinant +1, within 1e-6")
        table.done()
        return np.array(transform(R, position), dtype=np.float64)
    roll_pitch_yaw = np.radians(table.numbers("rpy_deg", 3, [0.0, 0.0, 0.0]))
    table.done()
    pose = np.array(transform(rotation_from_sequence("xyz", roll_pitch_yaw, fixed=True), position), dtype=np.float64)
    # Quarter turns are meant to be exact.
    nearest = np.round(pose[:3, :3])
    pose[:3, :3] = np.where(np.abs(pose[:3, :3] - nearest) < 1e-12, nearest, pose[:3, :3])
    return pose


def _rest(arm: Arm) -> NDArray[np.float64]:
    """Return joint values 0, or the limits nearest to it."""
    q = np.array(arm.clip(np.zeros(arm.n)), dtype=np.float64)
    q.setflags(write=False)
    return q


def _named_poses(top: Table, arm: Arm, kinds: str, *, required: bool) -> Iterable[tuple[str, NDArray[np.float64]]]:
    tables = top.tables("poses")
    if required and not tables:
        raise top.fail("poses", "give at least one named pose [[poses]]; the arm opens in the first")
    names = set(TAKEN)
    for table in tables:
        name, q = table.text("name"), joint_values(table, kinds)
        if name in names:
            raise table.fail("name", f"{name!r} is taken; choose a name that is not {', '.join(sorted(names))}")
        names.add(name)
        if not arm.within_limits(q):
            raise table.fail("q", f"the pose {name!r} is outside the joint limits: {outside(arm, q)}")
        q.setflags(write=False)
        table.done()
        yield name, q


def _expected(table: Table, kinds: str) -> Expected:
    T = np.eye(4)
    T[:3, 3] = table.numbers("position", 3)
    T[:3, :3] = table.matrix("rotation") if table.has("rotation") else np.nan
    tolerance = table.number("tolerance", 1e-9)
    if not 0.0 < tolerance <= LOOSEST:
        raise table.fail("tolerance", f"expected a positive number up to {LOOSEST:g}, got {tolerance:g}")
    expected = Expected(
        q=joint_values(table, kinds),
        T=T,
        flange=table.choice("of", ("tool", "flange"), "tool") == "flange",
        tolerance=tolerance,
        source=table.text("source"),
    )
    table.done()
    return expected


def read_camera(table: Table) -> Camera:
    """Read ``azimuth_deg``, ``elevation_deg`` and ``distance``, in robot files and lessons."""
    camera = Camera(table.number("azimuth_deg"), table.number("elevation_deg"), table.number("distance", 1.0))
    if not 0.0 < camera.distance <= FARTHEST_CAMERA:
        raise table.fail("distance", f"expected a positive number up to {FARTHEST_CAMERA:g}, got {camera.distance:g}")
    table.done()
    return camera


OWN = "own"
"""Key of an arm that was edited on screen."""


def own_robot(arm: Arm, name: str, like: Robot | None = None) -> Robot:
    """Return the robot of an arm that was edited on screen.

    Parameters
    ----------
    arm : Arm
    name : str
        "My arm" when empty.
    like : Robot, optional
        What it was made from: gives the camera and those named poses that still fit, with the same joint types and
        inside the limits. Without any the only pose is "home", every joint at 0 or at the limit nearest to it.
    """
    name = name.strip() or "My arm"
    poses: dict[str, NDArray[np.float64]] = {}
    if like is not None and np.array_equal(like.arm.revolute, arm.revolute):
        poses = {pose: q for pose, q in like.poses.items() if arm.within_limits(q)}
    return Robot(
        key=OWN,
        name=name,
        family=family_of(arm),
        summary="An arm of your own.",
        source="Edited on screen.",
        arm=arm if arm.name == name else replace(arm, name=name),
        poses=poses or {"home": _rest(arm)},
        expected=(),
        camera=like.camera if like is not None else DEFAULT_CAMERA,
    )


def family_of(arm: Arm) -> str:
    """Return the family of an arm, by its structure."""
    planar, spatial, sliding, six, more = FAMILIES
    if not arm.revolute.all():
        return sliding
    if arm.n >= 6:
        return six if arm.n == 6 else more
    between = common_normals(arm.rows, arm.convention)[1 : arm.n]
    # Revolute axes are parallel when no link between two of them has a twist.
    return planar if all(abs(np.sin(alpha)) < 1e-9 for _, alpha in between) else spatial


class Catalogue(Folder[Robot]):
    """All robot files."""

    kind = "robot"
    ending = ".toml"

    @property
    def robots(self) -> dict[str, Robot]:
        """The robots by key: by family, then by number of joints."""
        return self.found


def read_catalogue(files: Iterable[Traversable]) -> Catalogue:
    """Read robot files; a broken one is reported and does not affect the others."""
    return Catalogue.read(files, parse_robot, lambda robot: (FAMILIES.index(robot.family), robot.arm.n, robot.key))


@cache
def catalogue() -> Catalogue:
    """Return the robots of the lab, read once."""
    return read_catalogue(resources.files("robots", ".toml"))
