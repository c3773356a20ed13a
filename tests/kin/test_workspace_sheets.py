"""Maps over planes and half planes of arms, and the way of a planar arm to a place and back."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.half_plane import HalfPlane
from armlab.kin.workspace.planar import lengths_of, planar_workspace, pose_solutions
from armlab.kin.workspace.planar_pose import Place, along_ray, configurations, place_of, stretched
from armlab.kin.workspace.sheet_maps import approach_maps, count_maps, sheet_of
from armlab.kin.workspace.whole_plane import WholePlane
from support.arms import random_pose, random_q


def arm_of(name):
    """Return an arm of the catalogue."""
    return catalogue()[name].arm


def somewhere(rng, links=3):
    """Return a planar arm somewhere in space, some joints turning the other way."""
    tool = np.eye(4)
    tool[:3, 3] = [0.3, -0.2, 0.1]
    twists = [*rng.choice([0.0, np.pi], links - 1), 0.0]
    rows = [("R", float(a), float(twists[i]), 0.1, 0.2) for i, a in enumerate(rng.uniform(0.3, 1.0, links))]
    return Arm.from_dh(rows, base=random_pose(rng), tool=tool, task="xyz")


# -- planes ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "kind"),
    [("puma560", HalfPlane), ("cartesian_3p", HalfPlane), ("planar_2r", WholePlane), ("planar_3r", WholePlane)],
)
def test_coordinates_of_a_surface_lead_there_and_back(name, kind):
    sheet, rng = sheet_of(arm_of(name), 0.4), np.random.default_rng(1)
    assert isinstance(sheet, kind)
    places = rng.uniform(0.1, 1.0, (50, 2))
    np.testing.assert_allclose(sheet.places(sheet.points(places)), places, atol=1e-12)


def test_the_plane_of_an_arm_somewhere_holds_its_tool_point():
    rng = np.random.default_rng(2)
    for _ in range(10):
        arm = somewhere(rng)
        sheet = sheet_of(arm, 0.0)
        p = arm.position(random_q(arm, rng, 50))
        np.testing.assert_allclose(sheet.points(sheet.places(p)), p, atol=1e-9)
        (met,) = sheet.samples(200)
        T = arm.fk(met.q.astype(np.float64))
        np.testing.assert_allclose(met.axes @ sheet.across.T, T[:, :3, 0], atol=1e-5)


@pytest.mark.parametrize("name", ["puma560", "scara", "planar_3r_unequal"])
def test_every_configuration_of_a_map_is_inside_the_limits_and_its_tool_in_its_cell(name):
    arm = arm_of(name)
    sheet = sheet_of(arm, first_joint(arm).split(arm.position(catalogue()[name].home))[2])
    *_, found = approach_maps(sheet, 60_000, 30)
    cells = np.argwhere(np.isfinite(found.values))
    assert len(cells) > 100
    q = found.q[tuple(cells.T)].astype(np.float64)
    assert np.all((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1]))
    p = arm.position(q)
    inside = (sheet.places(p) - found.low) / found.step - cells
    assert np.all((inside > -1e-4) & (inside < 1.0 + 1e-4))
    assert found.cell(p[0]) is not None
    assert found.cell(p[0] + 100.0) is None
    assert found.done == 1.0


@pytest.mark.parametrize(
    "rows",
    [
        [("P", 0, math.pi / 2, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0.1, 0)],
        [("P", 0, math.pi / 2, 0, 0), ("P", 0, -math.pi / 2, 0, 0), ("R", 0, 0, 0.1, 0)],
        [("P", 0, math.pi / 2, 0, 0), ("P", 0, math.pi / 2, 0, math.pi / 2), ("R", 0, 0, 0, 0)],
        [("P", 0, 0, 0, 0), ("R", 0, 0, 0.1, 0)],
        [("R", 0, 0, 0, 0), ("P", 0, 0, 0.1, 0)],
    ],
    ids=["gantry", "gantry the other way", "across the gantry", "slide and spin", "spin and slide"],
)
def test_a_tool_that_turns_in_place_has_all_orientations(rows):
    *_, found = approach_maps(sheet_of(Arm.from_dh(rows), 0.0), 60_000, 12)
    assert np.nanmax(found.values) == 1.0


def test_a_map_grows_and_keeps_what_it_has():
    sheet = sheet_of(arm_of("ur5e"), 0.0)
    maps = list(approach_maps(sheet, 60_000, 20))
    done = [found.done for found in maps]
    assert done == sorted(done)
    filled = [np.isfinite(found.values).sum() for found in maps]
    assert filled == sorted(filled)
    first, last = maps[0], maps[-1]
    there = np.isfinite(first.values)
    assert np.array_equal(last.q[there], first.q[there])
    assert np.all(last.values[there] >= first.values[there])


def test_the_counts_of_a_3r_are_the_closed_form():
    arm = arm_of("planar_3r_unequal")
    sheet, phi = sheet_of(arm, 0.0), 0.6
    R = np.array([[np.cos(phi), -np.sin(phi), 0], [np.sin(phi), np.cos(phi), 0], [0, 0, 1.0]])
    *_, found = count_maps(sheet, R, 24)
    centres = np.stack(np.meshgrid(*map(np.arange, found.values.shape), indexing="ij"), axis=-1) + 0.5
    x, y = np.moveaxis(found.low + centres * found.step, -1, 0)
    wanted = pose_solutions(lengths_of(arm), np.hypot(x, y), phi - np.arctan2(y, x))
    assert np.array_equal(np.nan_to_num(found.values), wanted)
    assert found.proven


def test_the_counts_of_an_arm_in_space_are_those_of_the_solver():
    name = "puma560"
    arm, home = arm_of(name), catalogue()[name].home
    T = arm.fk(home)
    sheet = sheet_of(arm, first_joint(arm).split(T[:3, 3])[2])
    *_, found = count_maps(sheet, T[:3, :3], 10)
    for u, v in np.ndindex(found.values.shape):
        T[:3, 3] = sheet.points(found.low + (np.array([u, v]) + 0.5) * found.step)
        assert np.nan_to_num(found.values[u, v]) == solve_all(arm, T).within_limits.sum()
    assert found.values[found.cell(arm.position(home))] > 0


# -- planar arms -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("links", [2, 3])
def test_a_place_and_its_configurations(links):
    rng = np.random.default_rng(links)
    for _ in range(20):
        arm = somewhere(rng, links)
        q = random_q(arm, rng)
        place = place_of(arm, q)
        joint = first_joint(arm)
        u, _, s = joint.split(arm.position(q))
        assert place.r == pytest.approx(u)
        assert math.remainder(place.theta - s, math.tau) == pytest.approx(0.0, abs=1e-9)
        rows = configurations(arm, place)
        np.testing.assert_allclose(arm.position(rows), arm.position(q)[None].repeat(len(rows), 0), atol=1e-9)
        assert np.abs(np.exp(1j * rows) - np.exp(1j * q)).sum(axis=1).min() < 1e-6
        again = [place_of(arm, row) for row in rows]
        if links == 3:
            np.testing.assert_allclose([math.remainder(one.psi - place.psi, math.tau) for one in again], 0.0, atol=1e-9)


def test_out_of_reach_there_are_no_configurations_and_stretched_there_is_one():
    arm = arm_of("planar_3r")
    assert len(configurations(arm, Place(2.9, 0.3, 1.5))) == 0
    assert len(configurations(arm, Place(3.0, 0.3, 0.0))) == 1


def test_stretched_arms_are_singular_and_where_their_signs_say():
    rng = np.random.default_rng(9)
    for _ in range(5):
        arm = somewhere(rng)
        space = planar_workspace(lengths_of(arm))
        for r, ways in space.singular:
            for signs in ways:
                q = stretched(arm, signs, 0.4)
                place = place_of(arm, q)
                assert place.r == pytest.approx(r, abs=1e-9)
                assert math.remainder(place.theta - 0.4, math.tau) == pytest.approx(0.0, abs=1e-6)
                J = arm.jacobian(q)[:3]
                assert np.linalg.svd(J, compute_uv=False)[1] < 1e-9


@pytest.mark.parametrize("held", [(), (0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)])
def test_with_joints_held_the_tool_goes_all_along_a_ray(held):
    """Over random arms: each configuration found is on the ray, and one is found near each that is known."""
    rng, stays = np.random.default_rng(7), np.isin(np.arange(3), held)
    for _ in range(10):
        arm = somewhere(rng)
        known = random_q(arm, rng)
        place = place_of(arm, known)
        q, r = along_ray(arm, place.theta, np.where(stays, known, np.nan))
        assert np.abs(r - place.r).min() < 0.02 * arm.reach
        for row, distance in list(zip(q, r, strict=True))[:: len(q) // 20 + 1]:
            found = place_of(arm, row)
            assert arm.within_limits(row)
            assert found.r == pytest.approx(distance, abs=1e-9)
            assert abs(found.r * math.sin(found.theta - place.theta)) < 1e-9
            assert found.r * math.cos(found.theta - place.theta) >= 0.0
            np.testing.assert_array_equal(row[stays], known[stays])


def test_limits_may_forbid_to_stand_so():
    full = arm_of("planar_3r")
    tight = Arm.from_dh(full.rows, limits=[[-1.0, 1.0], [-2.0, 2.0], [-1.0, 1.0]], task=full.task)
    with pytest.raises(InputError, match="limits"):
        stretched(tight, (1, -1, 1), 0.0)
    with pytest.raises(InputError, match="planar"):
        place_of(arm_of("puma560"), np.zeros(6))
