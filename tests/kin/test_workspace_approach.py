"""Approach directions: bins, samples in a half plane, spherical wrists by convolution, numbers of solutions."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.workspace.approach import Approaches, directions, keeps_upright, spread
from armlab.kin.workspace.elbow_points import elbow_of
from armlab.kin.workspace.half_plane import HalfPlane
from armlab.kin.workspace.planar import lengths_of, planar_workspace, tool_angles
from armlab.kin.workspace.sampled_points import sampling
from armlab.kin.workspace.solution_count import counts
from armlab.kin.workspace.spherical_wrist import ALL, coverage, coverage_at, coverages, directed
from armlab.kin.workspace.wrist_points import front_of
from armlab.kin.workspace.wrist_turns import turns_freely, wrist_turns
from armlab.kin.wrist import wrist_centre
from support.arms import random_pose, random_q

ELBOWS = ("puma560", "irb140", "tx60")


def arm_of(name):
    """Return an arm of the catalogue."""
    return catalogue()[name].arm


def test_bins_of_the_sphere_are_nearly_equal_and_nearest():
    bins, rng = directions(), np.random.default_rng(1)
    d = rng.normal(size=(200_000, 3)).astype(np.float32)
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    found = bins.bins(d)
    share = np.bincount(found, minlength=64) * 64 / len(d)
    assert 0.75 < share.min() <= share.max() < 1.25
    nearest = np.linalg.norm(d[:500, None] - bins.axes, axis=2).argmin(axis=1)
    assert np.array_equal(found[:500], nearest)
    np.testing.assert_allclose(spread(4000).sum(axis=0), 0.0, atol=1.0)


def test_bins_of_the_circle_are_equal_angles():
    bins = directions(36, circle=True)
    angles = np.radians(np.arange(36) * 10.0 + 5.0)
    d = np.stack([np.cos(angles), np.sin(angles), np.full(36, 0.3)], axis=-1)
    assert bins.bins(d).tolist() == list(range(36))
    with pytest.raises(InputError, match="2 to 64"):
        directions(65)


def test_a_cell_counts_each_direction_once():
    bins = directions()
    grid = Approaches([0.0, 0.0], 0.5, (2, 4), bins)
    cells = grid.add([[0.1, 0.1], [0.2, 0.2], [0.6, 1.9], [9.0, 0.0], [-0.1, 0.0]], bins.axes[[3, 3, 63, 0, 0]])
    assert cells.tolist() == [0, 0, 7, -1, -1]
    grid.add([[0.1, 0.1]], bins.axes[[63]])
    assert grid.counts.tolist() == [[2, 0, 0, 0], [0, 0, 0, 1]]
    assert grid.coverage[0, 0] == 2 / 64
    for axis in bins.axes:
        grid.add([[0.6, 0.1]], [axis])
    assert grid.coverage[1, 0] == 1.0


@pytest.mark.parametrize("name", ["puma560", "ur5e", "panda", "scara", "stanford", "planar_3r_unequal", "cartesian_3p"])
def test_samples_are_in_the_half_plane_inside_the_limits_and_turned_as_said(name):
    arm = arm_of(name)
    plane = HalfPlane(arm, 0.5 * sum(arm.limits[0]) + 0.1)
    (met,) = plane.samples(4000)
    q = met.q.astype(np.float64)
    assert len(q) > 1000
    assert np.all((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1]))
    T = arm.fk(q)
    found = plane.joint.split(T[:, :3, 3])
    np.testing.assert_allclose(found[:, :2], met.places, atol=2e-6)
    outward = plane.joint.join(np.stack([1.0, 0.0, plane.s])) - plane.joint.join([0.0, 0.0, plane.s])
    aside = found[:, 2] - plane.s
    np.testing.assert_allclose(found[:, 0] * np.sin(aside) if plane.joint.revolute else aside, 0.0, atol=2e-6)
    if not plane.bins.circle:
        np.testing.assert_allclose(T[:, :3, 2] @ outward, met.axes[:, 0], atol=1e-4)
        np.testing.assert_allclose(T[:, :3, 2] @ plane.joint.axes[:, 2], met.axes[:, 2], atol=1e-6)


def test_the_same_seed_gives_the_same_samples_however_many():
    plane = HalfPlane(arm_of("ur5e"), 0.0)
    few, many = next(plane.samples(20_000, 3)), next(plane.samples(200_000, 3))
    other = next(plane.samples(20_000, 4))
    assert np.array_equal(few.q, many.q)
    assert not np.array_equal(few.q, other.q)


@pytest.mark.parametrize("name", ["planar_3r", "planar_3r_unequal"])
def test_sampled_coverage_of_a_planar_arm_is_never_above_the_closed_form_and_near_it(name):
    arm = arm_of(name)
    lengths = lengths_of(arm)
    plane = HalfPlane(arm, 0.2)
    grid = plane.grid(60)
    for met in plane.samples(400_000):
        grid.add(met.places, met.axes)
    space, shares = planar_workspace(lengths), grid.coverage[:, 0]
    for i, share in enumerate(shares):
        r = np.linspace(*(grid.low[0] + np.array([i, i + 1]) * grid.step + [-1e-6, 1e-6]), 400)
        low, high = tool_angles(lengths, np.maximum(r, 0.0))
        met, kept = np.zeros(64, dtype=bool), np.isfinite(low)
        for a, b in zip(low[kept], high[kept], strict=True):
            turns = np.mod(np.concatenate([np.linspace(a, b, 256), np.linspace(-b, -a, 256)]), math.tau)
            met[np.minimum((turns / math.tau * 64).astype(int), 63)] = True
        assert share <= met.mean() + 2 / 64
        # Cells at the first axis are small, and few samples fall there.
        if i > 2 and kept.all():
            assert share >= (high - low).min() / math.pi - 2 / 64
            assert share == 1.0 or not (space.is_dexterous(r[0]) and space.is_dexterous(r[-1]))


def test_limits_take_orientations_away():
    full = arm_of("planar_3r")
    tight = Arm.from_dh(full.rows, limits=[[-3.0, 3.0], [-2.0, 2.0], [-1.0, 1.0]], task=full.task)
    found = []
    for arm in (full, tight):
        plane = HalfPlane(arm, 0.0)
        grid = plane.grid(40)
        for met in plane.samples(200_000):
            grid.add(met.places, met.axes)
        found.append(grid.coverage.mean())
    assert found[1] < 0.5 * found[0]


def test_which_arms_keep_the_tool_upright():
    flat = {name: keeps_upright(arm_of(name)) for name in ("planar_2r", "scara", "cartesian_3p", "puma560", "scorbot")}
    assert flat == {"planar_2r": True, "scara": True, "cartesian_3p": True, "puma560": False, "scorbot": False}


# -- spherical wrists ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*ELBOWS, "stanford", "iiwa7"])
def test_the_front_of_an_arm_places_its_wrist_centre(name):
    arm, rng = arm_of(name), np.random.default_rng(2)
    front, q = front_of(arm), random_q(arm, rng, 20)
    T = arm.fk(q)
    np.testing.assert_allclose(
        front.position(q[:, : front.n]), T[:, :3, :3] @ wrist_centre(arm) + T[:, :3, 3], atol=1e-12
    )


@pytest.mark.parametrize("name", ELBOWS)
def test_what_the_elbow_reaches_is_what_its_inverse_kinematics_reaches(name):
    front, rng = front_of(arm_of(name)), np.random.default_rng(3)
    points = elbow_of(front)
    p = points.centre + rng.uniform(-1.0, 1.0, (150, 3)) * points.radius
    T = np.eye(4)
    for point, held in zip(p, points.holds(p), strict=True):
        T[:3, 3] = point
        assert held == bool(solve_all(front, T).within_limits.any())


def test_an_elbow_somewhere_in_space_holds_what_it_reaches_and_nothing_outside_its_ball():
    rng = np.random.default_rng(4)
    for convention in ("standard", "modified"):
        for _ in range(10):
            signs = rng.choice([-1.0, 1.0], 2)
            if convention == "standard":
                twists = (signs[0] * np.pi / 2, np.pi * (signs[1] > 0), 0.3)
            else:
                twists = (0.3, signs[0] * np.pi / 2, np.pi * (signs[1] > 0))
            a, d, theta = rng.uniform(0.1, 0.5, 3), rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.3, 0.3, 3)
            rows = [("R", a[i], twists[i], d[i], theta[i]) for i in range(3)]
            limits = np.sort(rng.uniform(-4.0, 4.0, (3, 2)), axis=1)
            arm = Arm.from_dh(rows, convention, random_pose(rng), random_pose(rng), limits)
            points = elbow_of(arm)
            p = arm.position(random_q(arm, rng, 500))
            assert points.holds(p).mean() > 0.995  # those at an edge may be lost to rounding
            assert np.linalg.norm(p - points.centre, axis=1).max() <= points.radius + 1e-9
            far = points.centre + points.radius * 1.001 * spread(100)
            assert not points.holds(far).any()


@pytest.mark.parametrize("name", ["puma560", "kr6r900"])
def test_the_sampled_table_agrees_with_the_closed_form(name):
    front, rng = front_of(arm_of(name)), np.random.default_rng(5)
    exact = elbow_of(front)
    *_, sampled = sampling(front)
    p = exact.centre + rng.uniform(-1.0, 1.0, (40_000, 3)) * exact.radius
    assert (sampled.holds(p) == exact.holds(p)).mean() > 0.97
    q = random_q(front, rng, 5000)
    assert sampled.holds(front.position(q)).mean() > 0.999


@pytest.mark.parametrize("first", [[-1.0, 2.0], [-np.pi, np.pi], [3.0, 8.0], [0.0, 0.5]])
def test_the_table_turns_and_shifts_with_joint_1(first):
    rng = np.random.default_rng(6)
    for rows in ([("R", 0.2, 1.2, 0.1, 0.0)], [("P", 0.2, 1.2, 0.1, 0.0)]):
        arm = Arm.from_dh(
            [*rows, ("R", 0.5, 0.7, 0.1, 0.0), ("R", 0.4, 0.0, 0.1, 0.0)], limits=[first, [-2, 2], [-2, 2]]
        )
        *_, table = sampling(arm)
        p = arm.position(random_q(arm, rng, 3000))
        assert table.holds(p).mean() > 0.98
        assert np.linalg.norm(p - table.centre, axis=1).max() <= table.radius
        beyond = arm.position(np.column_stack([np.full(500, first[1] + 1.2), *rng.uniform(-2, 2, (2, 500))]))
        if first[1] - first[0] < math.tau - 2.4:
            assert table.holds(beyond).mean() < 0.9


def with_wrist(name, limits_deg):
    """Return an arm of the catalogue with other limits of its last three joints."""
    arm = arm_of(name)
    return Arm.from_dh(
        arm.rows,
        arm.convention,
        arm.base,
        arm.tool,
        np.vstack([arm.limits[:-3], np.radians(limits_deg)]),
        task=arm.task,
    )


FREE = [[-180, 180]] * 3
LIMITED = {
    "puma560": ("puma560", None),
    "irb140": ("irb140", None),
    "tx60": ("tx60", None),
    "free": ("irb140", FREE),
    "one side": ("puma560", [[-180, 180], [10, 100], [-180, 180]]),
    "narrow": ("kr6r900", [[40, 160], [-120, 20], [0, 50]]),
}


@pytest.mark.parametrize("case", LIMITED)
def test_coverage_is_what_thousands_of_directions_say(case):
    name, limits = LIMITED[case]
    arm = arm_of(name) if limits is None else with_wrist(name, limits)
    found, rng = coverage(arm), np.random.default_rng(7)
    p = arm.position(random_q(arm, rng, 60))
    off = found.at(p) - np.array([coverage_at(found, point, 1024) for point in p])
    # 512 directions: a few of them lie at an edge; and some change suddenly between two nodes.
    assert np.abs(off).max() < 0.12
    assert np.abs(off).mean() < 0.012
    assert abs(off.mean()) < 0.006


def tool_of(arm):
    """Return the unit vector from the wrist centre to the tool point, in tool axes."""
    centre = wrist_centre(arm)
    return -centre / np.linalg.norm(centre)


def possible(arm, point, direction):
    """Return whether inverse kinematics finds a configuration inside the limits, joint 6 turning as it likes."""
    tool, around = tool_of(arm), np.cross(direction, [0.36, 0.48, 0.8])
    side = np.cross(tool, [0.6, 0.8, 0.0])
    T = np.eye(4)
    T[:3, 3] = point
    to, of = (
        np.stack([a, b / np.linalg.norm(b), np.cross(a, b / np.linalg.norm(b))], 1)
        for a, b in ((direction, around), (tool, side))
    )
    T[:3, :3] = to @ of.T
    low, high = arm.limits[:5].T
    q = np.array(solve_all(arm, T).q).reshape(-1, arm.n)
    return bool((np.mod(q[:, :5] - low, math.tau) <= high - low).all(axis=1).any())


@pytest.mark.parametrize("name", ["puma560", "irb140", "one side", "narrow"])
def test_a_direction_is_possible_where_inverse_kinematics_says_so(name):
    """The tool lies on axis 6 in these arms: its roll is free, whatever joint 6 may do."""
    key, limits = LIMITED[name]
    arm = arm_of(key) if limits is None else with_wrist(key, limits)
    points, turns, rng = elbow_of(front_of(arm)), wrist_turns(arm), np.random.default_rng(8)
    d = rng.normal(size=(6, 12, 3))
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    for point, some in zip(arm.position(random_q(arm, rng, 6)), d, strict=True):
        said = directed(points, turns, point, some)
        assert said.tolist() == [possible(arm, point, direction) for direction in some]


@pytest.mark.parametrize("name", ["puma560", "stanford", "iiwa7", "kr6r900"])
def test_a_direction_in_which_the_arm_was_met_counts_as_possible(name):
    """Forward: at the tool point of a random configuration the share is not zero; the wrist allows its direction."""
    arm, rng = arm_of(name), np.random.default_rng(9)
    q, turns = random_q(arm, rng, 200), wrist_turns(arm)
    front, T = front_of(arm), arm.fk(q)
    home, turned = front.fk(np.zeros(front.n))[:3, :3], front.fk(q[:, : front.n])[:, :3, :3]
    d = T[:, :3, :3] @ tool_of(arm)
    local = np.einsum("kij,ki->kj", turned @ home.T, d)
    assert turns.allows(local).all()
    assert turns.looked_up(local.T).mean() > 0.97  # but for those within two degrees of an edge
    assert (coverage(arm, 48).at(T[:, :3, 3]) > 0.0).mean() > 0.98


def test_a_tool_beside_axis_6_turns_with_joint_6():
    arm = with_wrist("irb140", [[-100, 60], [-50, 80], [-30, 90]])
    tool = np.eye(4)
    tool[:3, 3] = [0.1, 0.05, 0.1]
    arm, rng = Arm.from_dh(arm.rows, arm.convention, tool=tool, limits=arm.limits), np.random.default_rng(10)
    turns, q = wrist_turns(arm), random_q(arm, rng, 100_000)
    front = front_of(arm)
    turned = front.fk(q[:, :3])[:, :3, :3] @ front.fk(np.zeros(3))[:3, :3].T
    met = np.einsum("kij,ki->kj", turned, arm.fk(q)[:, :3, :3] @ tool_of(arm))
    assert turns.allows(met[:2000]).mean() > 0.99  # 180 values of q6 stand for all
    d = spread(3000)
    far = d[cKDTree(met).query(d)[0] > math.radians(8.0)]
    assert len(far) > 300
    assert not turns.allows(far).any()


def test_a_limited_wrist_of_the_stanford_arm_has_its_share_and_not_all_of_the_sphere():
    """The elbow slides: there is no closed form of the forearm. Against inverse kinematics with all limits."""
    arm = arm_of("stanford")
    found, rng, d = coverage(arm, 64), np.random.default_rng(11), spread(40)
    assert 0.3 < found.fraction.max() < 0.55
    assert found.volume == 0.0
    p = arm.position(random_q(arm, rng, 6))
    wanted = [np.mean([possible(arm, point, direction) for direction in d]) for point in p]
    # 40 directions: one standard deviation is up to 0.08 at a point, 0.03 of six.
    assert abs(np.mean(found.at(p) - wanted)) < 0.06


@pytest.mark.parametrize("limits", [[[-180, 180], [-100, 100], [-180, 180]], FREE])
def test_joint_1_that_slides_leaves_an_upper_bound_that_says_so(limits):
    rows = [("P", 0.0, 0.0, 0.1, 0.0), ("R", 0.5, 0.0, 0.0, 0.0), ("R", 0.4, np.pi / 2, 0.0, 0.0)]
    rows += [("R", 0, -np.pi / 2, 0, 0), ("R", 0, np.pi / 2, 0, 0), ("R", 0, 0, 0.1, 0)]
    arm = Arm.from_dh(rows, limits=[[0, 1], [-2, 2], [-2, 2], *np.radians(limits)])
    found = coverage(arm, 32)
    assert found.proper is (limits is FREE)
    assert found.fraction.max() > 0.9


def test_ws2_is_inside_ws1_and_all_directions_are_possible_there():
    found = coverage(with_wrist("kr6r900", FREE), 64)
    assert 0.0 < found.volume < found.reached
    inside = np.argwhere(found.dexterous)[::40]
    for cell in inside:
        assert coverage_at(found, found.low + (cell + 0.5) * found.step) > 2 * ALL - 1.0 - 0.01


def test_an_elbow_without_limits_has_the_coverage_of_two_spheres():
    """W is a ball without a hole: two equal links and a shoulder on axis 1; the tool's shell lies in it up to R - L."""
    rows = [("R", 0, np.pi / 2, 0.3, 0), ("R", 0.5, 0, 0, 0), ("R", 0, np.pi / 2, 0, 0)]
    rows += [("R", 0, -np.pi / 2, 0.5, 0), ("R", 0, np.pi / 2, 0, 0), ("R", 0, 0, 0.2, 0)]
    found = coverage(Arm.from_dh(rows), 96)
    assert found.turns.free
    assert found.points.exact
    assert found.tool == pytest.approx(0.2)
    assert abs(found.volume - 4 / 3 * np.pi * 0.8**3) <= found.volume_error < 0.15 * found.volume
    d = np.array([0.85, 0.95, 1.0, 1.1])
    # The cap of the shell beyond the ball: cos of its edge from the law of cosines.
    wanted = 0.5 * (1.0 - np.clip((d**2 + 0.2**2 - 1.0) / (2 * d * 0.2), -1, 1))
    got = found.at(np.array([0.0, 0.0, 0.3]) + d[:, None] * np.array([0.6, 0.0, 0.8]))
    np.testing.assert_allclose(got, wanted, atol=0.06)


def test_a_wrist_whose_limits_leave_no_whole_turn_does_not_turn_freely():
    assert not turns_freely(arm_of("puma560"))
    arm = arm_of("irb140")
    wide = np.array(arm.limits)
    wide[3:] = [[-4, 4], [-3.2, 3.2], [-4, 4]]
    assert turns_freely(Arm.from_dh(arm.rows, arm.convention, limits=wide))
    wide[4] = [-3.0, 3.0]
    assert not turns_freely(Arm.from_dh(arm.rows, arm.convention, limits=wide))


def test_coverage_comes_in_pieces_coarse_first():
    found = [one for one in coverages(arm_of("tx60"), (16, 32)) if one is not None]
    assert [(one.fraction.shape[0], one.finished) for one in found] == [(16, False), (32, True)]


@pytest.mark.parametrize("name", ["ur5e", "planar_3r", "scara"])
def test_arms_without_spherical_wrist_are_refused(name):
    with pytest.raises(InputError, match="spherical wrist"):
        coverage(arm_of(name))


# -- numbers of solutions --------------------------------------------------------------------------------------------


def test_counts_along_a_line_of_the_2r():
    arm = arm_of("planar_2r_unequal")
    space = planar_workspace(lengths_of(arm))
    r = np.array([space.inner - 0.01, space.inner + 0.01, space.outer - 0.01, space.outer + 0.01])
    points = np.stack([np.zeros(4), r, np.zeros(4)], axis=-1)
    assert [str(count) for count in counts(arm, points, np.eye(3))] == ["0", "2", "2", "0"]


def test_counts_of_a_family_and_of_limits():
    found = list(counts(arm_of("planar_2r"), [[0.0, 0.0, 0.0]], np.eye(3)))
    assert math.isinf(found[0].number)
    assert str(found[0]) == "infinitely many"
    arm = arm_of("puma560")
    T = arm.fk(catalogue()["puma560"].home)
    (count,) = counts(arm, [T[:3, 3]], T[:3, :3])
    assert count.complete
    assert 0 < count.inside <= count.number == len(solve_all(arm, T))


def test_points_of_another_shape_are_refused():
    with pytest.raises(InputError, match="points"):
        list(counts(arm_of("planar_2r"), [0.0, 0.0, 0.0], np.eye(3)))
