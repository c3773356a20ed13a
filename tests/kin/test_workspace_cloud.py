"""The cloud of a workspace: samples, what colours them, and the voxels that count them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import armlab
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.workspace.cloud import SINGLE, Samples, samples, single_limits
from armlab.kin.workspace.measures import MEASURES, SQUARED, measure_named
from armlab.kin.workspace.voxels import Voxels, reach_box, voxels_for
from support.arms import random_arm, random_q

NAMES = armlab.robots()


def whole(arm: Arm, count: int, **settings: object) -> Samples:
    """Return all samples as one."""
    pieces = list(samples(arm, count, **settings))
    return Samples(*(np.concatenate(parts) for parts in zip(*pieces, strict=True)))


def exact_scale(arm: Arm) -> float:
    return arm.reach + float(np.linalg.norm(arm.base[:3, 3]))


@pytest.mark.parametrize("name", NAMES)
def test_every_point_of_every_robot_obeys_its_limits_and_its_forward_kinematics(name: str) -> None:
    arm = armlab.load(name)
    found = whole(arm, 3000, seed=1)
    assert {each.dtype for each in found} == {np.dtype(np.float32)}
    q = found.q.astype(float)
    assert np.all(q >= arm.limits[:, 0])
    assert np.all(q <= arm.limits[:, 1])
    assert_allclose(found.points, arm.position(q), rtol=0, atol=SINGLE * exact_scale(arm))
    low, high = reach_box(arm)
    assert np.all(found.points >= low - 1e-6)
    assert np.all(found.points <= high + 1e-6)


def test_the_same_seed_gives_the_same_samples_however_they_are_cut() -> None:
    arm = armlab.load("puma560")
    long, short = whole(arm, 5000, seed=3), whole(arm, 5000, seed=3, chunk=37)
    for one, other in zip(long, short, strict=True):
        assert_array_equal(one, other)
    assert_array_equal(whole(arm, 100, seed=3).q, long.q[:100])
    assert not np.array_equal(whole(arm, 100, seed=4).q, long.q[:100])


def test_the_first_piece_is_small_and_no_piece_is_larger_than_asked_for() -> None:
    arm = armlab.load("puma560")
    sizes = [len(piece.q) for piece in samples(arm, 150_001)]
    assert sizes == [4096, 65_536, 65_536, 14_833]
    assert max(len(piece.q) for piece in samples(arm, 9000, measure="sigma_min")) == 4096
    assert [len(piece.q) for piece in samples(arm, 10, chunk=4)] == [4, 4, 2]


def test_limits_that_are_no_single_precision_numbers_are_kept() -> None:
    rng = np.random.default_rng(5)
    for _ in range(50):
        arm = random_arm(rng, 4)
        middle = rng.uniform(-1, 1, 4)
        width = 10.0 ** rng.uniform(-6, 0, 4)
        limits = np.column_stack([middle - width, middle + width])
        arm = Arm.from_dh(arm.rows, arm.convention, limits=limits)
        q = whole(arm, 500).q.astype(float)
        assert np.all(q >= limits[:, 0])
        assert np.all(q <= limits[:, 1])


def test_a_joint_that_cannot_move_stays_where_it_is() -> None:
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)], limits=[[-1, 1], [0.1, 0.1]])
    low, high = single_limits(arm)
    assert low[1] == high[1] == np.float32(0.1)
    assert np.all(whole(arm, 100).q[:, 1] == np.float32(0.1))


@pytest.mark.parametrize(("settings", "says"), [({"count": 0}, "count"), ({"count": 5, "chunk": 0}, "chunk")])
def test_a_count_below_one_is_refused_before_the_first_piece(settings: dict[str, int], says: str) -> None:
    with pytest.raises(InputError, match=f"{says}: expected at least 1, got 0"):
        samples(armlab.load("planar_2r"), **settings)


def test_an_unknown_measure_lists_those_there_are() -> None:
    with pytest.raises(UnknownName, match="inverse_condition, manipulability, sigma_min"):
        samples(armlab.load("planar_2r"), 10, measure="sigma")
    assert measure_named("sigma_min") is MEASURES["sigma_min"]


@pytest.mark.parametrize("name", NAMES)
def test_measures_are_those_of_singular_values_of_the_scaled_task_jacobian(name: str) -> None:
    arm = armlab.load(name)
    q = random_q(arm, np.random.default_rng(7), 40)
    task = ScaledTask(arm)
    sigma = np.array([np.linalg.svd(task.scaled(task.jacobian(each)), compute_uv=False) for each in q])
    floor = SQUARED * sigma[:, 0]
    assert_allclose(MEASURES["sigma_min"].values(arm, q), sigma[:, -1], rtol=1e-6, atol=2 * floor.max())
    assert_allclose(MEASURES["inverse_condition"].values(arm, q), sigma[:, -1] / sigma[:, 0], rtol=1e-6, atol=2e-7)
    assert_allclose(MEASURES["manipulability"].values(arm, q), arm.manipulability(q))


def test_a_singular_arm_measures_zero_and_never_less() -> None:
    arm = armlab.load("planar_2r")
    q = np.array([[0.3, 0.0], [0.3, np.pi], [0.3, 1e-9]])
    for measure in MEASURES.values():
        values = measure.values(arm, q)
        assert np.all(values >= 0.0)
        assert np.all(values < 1e-8)
    # What is below the digits of the squares is zero: of noise a logarithmic scale would make a picture.
    assert MEASURES["sigma_min"].values(arm, q).tolist() == [0.0, 0.0, 0.0]
    assert MEASURES["inverse_condition"].values(arm, q).tolist() == [0.0, 0.0, 0.0]
    still = Arm.from_dh([("R", 0, 0, 0, 0)], task="xy")
    assert MEASURES["inverse_condition"].values(still, np.zeros((3, 1))).tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("name", "w", "sigma"),
    [("planar_2r", "m²", "m"), ("puma560", "m³", ""), ("cartesian_3p", "", ""), ("planar_3r", "m²", "")],
)
def test_units_are_those_of_the_task(name: str, w: str, sigma: str) -> None:
    arm = armlab.load(name)
    assert MEASURES["manipulability"].unit(arm) == w
    assert MEASURES["sigma_min"].unit(arm) == sigma
    assert MEASURES["inverse_condition"].unit(arm) == ""


def test_a_full_2r_cloud_is_the_disc_of_its_links() -> None:
    arm = armlab.load("planar_2r_unequal")
    a1, a2 = (row.a for row in arm.rows)
    arm = Arm.from_dh(arm.rows)
    r = np.hypot(*whole(arm, 200_000).points[:, :2].T.astype(float))
    assert abs(a1 - a2) - 1e-6 <= r.min() < abs(a1 - a2) + 0.002
    assert a1 + a2 - 0.002 < r.max() <= a1 + a2 + 1e-6
    # Uniform q_2 puts half of the samples beyond the distance at q_2 = 90°.
    assert np.mean(r > np.hypot(a1, a2)) == pytest.approx(0.5, abs=0.005)


def test_voxels_count_each_point_once_where_it_lies() -> None:
    rng = np.random.default_rng(8)
    low, step, shape = np.array([-1.0, 0.5, 2.0]), 0.25, (8, 5, 11)
    points = low + rng.random((5000, 3)) * np.array(shape) * step * 0.999
    values = rng.random(5000)
    grid = Voxels(low, step, shape)
    for part in range(0, 5000, 700):
        grid.add(points[part : part + 700], values[part : part + 700])
    edges = [low[k] + step * np.arange(shape[k] + 1) for k in range(3)]
    count = np.histogramdd(points, edges)[0]
    total = np.histogramdd(points, edges, weights=values)[0]
    assert_array_equal(grid.count, count)
    assert_allclose(grid.mean()[grid.filled], total[count > 0] / count[count > 0])
    assert np.all(np.isnan(grid.mean()[~grid.filled]))
    centres = grid.centres()
    assert len(centres) == grid.filled.sum()
    nearest = np.abs(points[:, None] - centres[None, :50]).max(axis=2).min(axis=0)
    assert np.all(nearest <= step / 2 + 1e-12)
    assert_allclose(grid.centres(np.ones(shape, bool))[[0, -1]], [low + 0.125, low + step * np.array(shape) - 0.125])


def test_a_copy_of_voxels_does_not_change_any_more() -> None:
    grid = Voxels(np.zeros(3), 1.0, (2, 2, 2))
    grid.add(np.array([[0.5, 0.5, 0.5]]), np.array([2.0]))
    before = grid.copy()
    grid.add(np.array([[0.5, 0.5, 0.5]]), np.array([4.0]))
    assert (before.count[0, 0, 0], before.mean()[0, 0, 0]) == (1, 2.0)
    assert (grid.count[0, 0, 0], grid.mean()[0, 0, 0]) == (2, 3.0)


@pytest.mark.parametrize("point", [[-0.1, 0.5, 0.5], [0.5, 2.0, 0.5], [0.5, np.nan, 0.5]])
def test_points_outside_the_grid_are_refused_and_nothing_is_counted(point: list[float]) -> None:
    grid = Voxels(np.zeros(3), 1.0, (2, 2, 2))
    with pytest.raises(InputError, match="some lie outside"):
        grid.add(np.array([[0.5, 0.5, 0.5], point]), np.ones(2))
    assert grid.count.sum() == 0


def test_all_that_random_arms_reach_is_in_their_box_of_voxels() -> None:
    rng = np.random.default_rng(9)
    for k in range(120):
        arm = random_arm(rng, int(rng.integers(1, 8)), special=k % 2 == 0)
        grid = voxels_for(arm, int(rng.integers(2, 40)))
        for piece in samples(arm, 400):
            grid.add(piece.points, piece.values)
        assert grid.count.sum() == 400


def test_the_box_is_tight_where_directions_are_known() -> None:
    low, high = reach_box(armlab.load("cartesian_3p"))
    arm = armlab.load("cartesian_3p")
    corners = arm.position(np.stack(np.meshgrid(*arm.limits), axis=-1).reshape(-1, 3))
    assert_allclose([low, high], [corners.min(axis=0), corners.max(axis=0)], atol=1e-12)
    low, high = reach_box(Arm.from_dh([("R", 1, 0, 0.3, 0), ("R", 0.5, 0, 0.1, 0), ("P", 0, 0, 0, 0)]))
    assert_allclose([low, high], [[-1.5, -1.5, 0.4], [1.5, 1.5, 1.4]], atol=1e-12)
    low, high = reach_box(armlab.load("elbow_3r"))
    widths = (high - low).tolist()
    assert widths == pytest.approx([widths[0]] * 3, rel=0.2)


def test_a_planar_arm_fills_one_layer_of_voxels() -> None:
    for resolution in (20, 21):
        grid = voxels_for(armlab.load("planar_3r"), resolution)
        for piece in samples(armlab.load("planar_3r"), 5000):
            grid.add(piece.points, piece.values)
        assert len(np.unique(np.nonzero(grid.count)[2])) == 1


@pytest.mark.parametrize("resolution", [1, 257])
def test_a_resolution_out_of_range_is_refused(resolution: int) -> None:
    with pytest.raises(InputError, match="resolution: expected 2 to 256"):
        voxels_for(armlab.load("planar_2r"), resolution)


def test_memory_does_not_grow_with_the_number_of_samples() -> None:
    sizes = [len(piece.q) for piece in samples(armlab.load("planar_2r"), 400_000)]
    assert max(sizes) == 65_536
    assert all(after == 65_536 for _, after in pairwise(sizes[:-1]))
