"""Workspaces of planar arms in closed form, against the notes and against brute force."""

import math
from itertools import pairwise

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.workspace.planar import (
    families,
    lengths_of,
    orientations,
    planar_workspace,
    pose_solutions,
    position_solutions,
    tool_angles,
    turns_fully,
)
from armlab.kin.workspace.planar_regions import region_at, regions
from support.arms import random_pose

TURN = np.linspace(0.0, 2.0 * np.pi, 3600, endpoint=False)
EQUAL = (1.0, 1.0, 1.0)


def planar(lengths, task="xy phi"):
    """Return a planar arm with these links."""
    return Arm.from_dh([("R", length, 0, 0, 0) for length in lengths], task=task)


def joint_3_fits(lengths, r):
    """Return for each angle of `TURN` whether the joint before the last link can be where it has to be; (k, 3600)."""
    a, b, c = lengths
    d = np.hypot(np.asarray(r)[:, None] - c * np.cos(TURN), c * np.sin(TURN))
    return (d >= abs(a - b)) & (d <= a + b)


@pytest.mark.parametrize("name", ["C4.2-ws-2R", "C4.2-ws-2R-eq"])
def test_the_2r_of_the_notes(truth, name):
    case = truth[name]
    wanted, space = case["expected"], planar_workspace((case["inputs"]["l1"], case["inputs"]["l2"]))
    found = [space.inner, space.outer, space.area]
    np.testing.assert_allclose(found, [wanted[k] for k in ("r_min", "r_max", "area")], rtol=0, atol=case["tol"])
    assert space.dexterous == tuple(map(tuple, [] if wanted["WS2"] == "empty" else wanted["WS2"]))


def test_the_radii_of_unequal_3r(truth):
    case = truth["C4.3.1-ws-3R-uneq"]
    found = [planar_workspace(lengths) for lengths in case["inputs"]["l"]]
    for key, values in (("r_min", [w.inner for w in found]), ("r_max", [w.outer for w in found])):
        np.testing.assert_allclose(values, case["expected"][key], rtol=0, atol=case["tol"])


def test_ws2_of_any_3r(truth):
    case = truth["C4.3.1-ws2-3R-general"]
    for lengths, wanted in zip(case["inputs"]["l"], case["expected"]["WS2_radial_intervals"], strict=True):
        found = planar_workspace(lengths).dexterous
        assert len(found) == len(wanted)
        np.testing.assert_allclose(
            np.array(found).reshape(-1, 2), np.array(wanted).reshape(-1, 2), rtol=0, atol=case["tol"]
        )


def test_ws2_and_the_orientations_against_thousands_of_angles():
    rng = np.random.default_rng(3)
    for _ in range(60):
        lengths = tuple(rng.uniform(0.1, 1.0, 3))
        space = planar_workspace(lengths)
        r = np.linspace(0.0, 1.1 * space.outer, 301)
        fits = joint_3_fits(lengths, r)
        assert np.array_equal(np.isfinite(tool_angles(lengths, r)[0]), (r >= space.inner) & (r <= space.outer))
        measured = np.nan_to_num(orientations(lengths, r), nan=0.0)
        np.testing.assert_allclose(measured, fits.mean(axis=1) * 2.0 * np.pi, rtol=0, atol=4.5 * 2.0 * np.pi / 3600)
        inside = np.array([space.is_dexterous(value) for value in r])
        assert np.array_equal(inside, fits.all(axis=1))
        assert np.array_equal(inside, measured >= 2.0 * np.pi - 1e-9)


def test_the_ends_of_ws2_are_sharp():
    rng = np.random.default_rng(4)
    for _ in range(200):
        lengths = tuple(rng.uniform(0.1, 1.0, 3))
        for low, high in planar_workspace(lengths).dexterous:
            outside = [low - 1e-6, high + 1e-6] if low > 0.0 else [high + 1e-6]
            assert np.all(orientations(lengths, outside) < 2.0 * np.pi - 1e-6)
            assert np.all(orientations(lengths, [low, 0.5 * (low + high), high]) >= 2.0 * np.pi - 1e-6)


def test_equal_links_have_all_orientations_up_to_l_and_not_in_the_ring_outside():
    r = np.linspace(0.0, 1.0, 50)
    assert np.all(orientations(EQUAL, r) == pytest.approx(2.0 * np.pi, abs=1e-12))
    assert np.all(orientations(EQUAL, np.linspace(1.001, 3.0, 50)) < 2.0 * np.pi)
    assert orientations(EQUAL, 3.0) == pytest.approx(0.0, abs=1e-9)


def test_printed_region_of_the_notes_holds_points_with_all_orientations(truth):
    """ERR-4.40: half a link from the axis is in the region that is said not to have all orientations."""
    assert truth["ERR-4.40"]["expected"]["corrected_residual"] == 0.0
    region = region_at(EQUAL, 0.5)
    assert region.kind == "dexterous"
    assert joint_3_fits(EQUAL, [0.5]).all()
    assert region_at(EQUAL, 2.0).kind == "partial"


def test_three_singular_configurations_at_r_equal_l():
    arm = planar(EQUAL, "xy")
    (r, ways), (outer, _) = planar_workspace(EQUAL).singular
    assert (r, outer, len(ways)) == (1.0, 3.0, 3)
    for signs in ways:
        absolute = np.where(np.array(signs) > 0, 0.0, np.pi)
        q = np.diff(absolute, prepend=0.0)
        np.testing.assert_allclose(arm.position(q), [1.0, 0.0, 0.0], atol=1e-15)
        assert arm.manipulability(q) < 1e-15
    # Among all solutions for this position no others are singular.
    psi = np.linspace(-np.pi, np.pi, 20_001)
    found = every_solution(EQUAL, 1.0, psi)
    flat = np.abs(found[arm.manipulability(found) < 1e-3])
    assert len(flat) > 0
    assert all(min(np.linalg.norm(turned(row - way)) for way in as_joints(ways)) < 0.01 for row in flat * np.sign(flat))


def as_joints(ways):
    """Return the joint values of stretched and folded arms along x."""
    return [np.diff(np.where(np.array(signs) > 0, 0.0, np.pi), prepend=0.0) for signs in ways]


def turned(angles):
    """Return angles, or pairs of opposite signs, brought nearest to zero."""
    return np.abs(np.angle(np.exp(1j * np.asarray(angles))))


def every_solution(lengths, r, psi):
    """Return both elbows for the tool on the x axis with the last link at each angle, (k, 3)."""
    a, b, c = lengths
    w = r - c * np.exp(1j * psi)
    w = w[np.abs(w) > 1e-9]
    cosine = (np.abs(w) ** 2 - a * a - b * b) / (2 * a * b)
    kept = np.abs(cosine) <= 1.0
    w, q2 = w[kept], np.arccos(cosine[kept])
    rows = []
    for sign in (1.0, -1.0):
        q1 = np.angle(w / (a + b * np.exp(1j * sign * q2)))
        rows.append(np.stack([q1, sign * q2, np.angle((r - w) * np.exp(-1j * (q1 + sign * q2)))], axis=-1))
    return np.concatenate(rows)


@pytest.mark.parametrize("lengths", [(1.0, 0.5), (1.0, 1.0), (0.4, 0.7)])
def test_counts_of_the_2r_are_those_of_the_solver(lengths):
    arm = planar(lengths, "xy")
    space = planar_workspace(lengths)
    for r in [
        0.0,
        0.5 * space.inner,
        space.inner,
        0.6 * space.inner + 0.4 * space.outer,
        space.outer,
        1.1 * space.outer,
    ]:
        found = solve_all(arm, at(r, 0.7))
        count = math.inf if found.completeness == "infinite" else len(found)
        assert position_solutions(lengths, r) == count


@pytest.mark.parametrize("lengths", [EQUAL, (1.0, 0.8, 0.5), (0.5, 0.4, 2.0), (1.0, 1.0, 0.5)])
def test_counts_of_position_and_angle_are_those_of_the_solver(lengths):
    arm = planar(lengths)
    rng = np.random.default_rng(5)
    for r, psi in [*rng.uniform((0.0, -np.pi), (sum(lengths), np.pi), (60, 2)), (lengths[2], 0.0)]:
        theta = rng.uniform(-np.pi, np.pi)
        found = solve_all(arm, at(r, theta, theta + psi))
        count = math.inf if found.completeness == "infinite" else len(found)
        assert pose_solutions(lengths, r, psi) == count


def at(r, theta, phi=0.0):
    """Return a pose in the plane."""
    T = np.eye(4)
    T[:2, :2] = [[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]]
    T[:2, 3] = r * np.cos(theta), r * np.sin(theta)
    return T


def test_families_are_what_the_ranges_of_the_tool_angle_leave():
    """At an end of a range both elbows meet: a range is one curve, and a whole turn without ends is one an elbow."""
    rng = np.random.default_rng(6)
    seen = set()
    for _ in range(300):
        lengths = tuple(rng.uniform(0.3, 1.0, 3))
        space = planar_workspace(lengths)
        r = rng.uniform(space.inner, space.outer)
        low, high = tool_angles(lengths, r)
        ends = int(low > 0.0) + int(high < np.pi)
        assert families(lengths, r) == (1 if ends == 1 else 2)
        seen.add(int(ends))
    assert seen == {0, 1, 2}


def test_regions_cover_the_workspace_without_gaps_and_agree_with_every_point_in_them():
    rng = np.random.default_rng(7)
    for lengths in [
        EQUAL,
        (1.0, 0.8, 0.5),
        (1.0, 1.0, 0.5),
        (0.5, 0.5, 1.0),
        *map(tuple, rng.uniform(0.1, 1, (25, 3))),
    ]:
        space, found = planar_workspace(lengths), regions(lengths)
        rings = [one for one in found if one.low < one.high]
        assert rings[0].low == space.inner
        assert rings[-1].high == pytest.approx(space.outer, abs=1e-12)
        assert all(one.high == other.low for one, other in pairwise(rings))
        for one in rings:
            for r in rng.uniform(one.low, one.high, 20):
                measure = float(orientations(lengths, r))
                assert one.least - 1e-3 <= measure <= one.most + 1e-3
                assert (one.kind == "dexterous") == (measure >= 2 * np.pi - 1e-9) == space.is_dexterous(r)
                assert region_at(lengths, r) is one
        assert region_at(lengths, space.outer).kind == "boundary"
        assert region_at(lengths, space.outer * 1.001) is None


def test_words_of_figure_4_9():
    inside, edge, ring, boundary = regions(EQUAL)
    assert inside.says.startswith("All orientations. Two solutions for position and angle.")
    assert "three of them singular" in edge.solutions
    assert edge.orientations == "All orientations."
    assert "not all" in ring.orientations
    assert math.degrees(ring.most) == pytest.approx(360.0, abs=1e-6)
    assert boundary.orientations == "One orientation."
    assert boundary.solutions == "One solution, singular."


def test_origin_of_the_2r_with_equal_links_is_the_exception():
    """ERR-4.6: in the inside of WS1 there are two orientations, but infinitely many at the origin."""
    origin, inside, boundary = regions((1.0, 1.0))
    assert (origin.kind, inside.kind, boundary.kind) == ("origin", "two", "boundary")
    assert orientations((1.0, 1.0), 0.0) == 2.0 * math.pi
    assert orientations((1.0, 1.0), 1e-3) == 0.0


def test_links_are_read_off_any_planar_arm_anywhere():
    rng = np.random.default_rng(8)
    tool = np.eye(4)
    tool[:3, 3] = [0.3, 0.4, 0.7]
    rows = [("R", -0.8, 0, 0.1, 0.3), ("R", 0.6, np.pi, -0.2, 0), ("R", 0.0, 0, 0, 1.0)]
    assert lengths_of(Arm.from_dh(rows, base=random_pose(rng), tool=tool)) == pytest.approx((0.8, 0.6, 0.5))
    modified = [("R", 0.2, 0.7, 0.1, 0.3), ("R", 0.9, 0, 0, 0)]
    assert lengths_of(Arm.from_dh(modified, "modified", tool=tool)) == pytest.approx((0.9, 0.5))
    assert lengths_of(catalogue()["planar_3r_unequal"].arm) is not None
    assert lengths_of(catalogue()["puma560"].arm) is None
    assert lengths_of(catalogue()["scara"].arm) is None
    assert lengths_of(Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.0, 0, 0, 0)])) is None


def test_limits_that_leave_no_whole_turn_are_noticed():
    rows = [("R", 1.0, 0, 0, 0)] * 2
    assert turns_fully(Arm.from_dh(rows))
    assert not turns_fully(Arm.from_dh(rows, limits=[[-np.pi, np.pi], [-3.0, 3.0]]))


@pytest.mark.parametrize("lengths", [(1.0,), (1.0, 0.0), (1.0, -1.0, 1.0), (1.0, math.nan), (1, 1, 1, 1)])
def test_what_is_no_planar_arm_is_refused(lengths):
    with pytest.raises(InputError, match="two or three"):
        planar_workspace(lengths)


def test_negative_radii_are_refused():
    with pytest.raises(InputError, match="not negative"):
        orientations(EQUAL, [-0.1])
