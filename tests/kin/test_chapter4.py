"""Chapter 4 of the notes, section 4.3: the numbers of its inverse kinematics and of its errata."""

import math
from pathlib import Path

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.general_6r import solve_general
from armlab.kin.ik.solve_all import solve_all
from support.solutions import contains, no_duplicates, same_set, worst_error

HERE = Path(__file__).parent

COVERED = {
    "C1.7-PUMA-ik": "test_closed_forms.py",
    "C1.7-Unimate-ik": "test_closed_forms.py",
    "C1.7-SCARA-ik": "test_closed_forms.py",
    "C4.2-ws-2R": "test_chapter4.py",
    "C4.3-UR10-notes": "test_closed_forms.py",
    "C4.3-UR10-manufacturer": "test_closed_forms.py",
    "C4.3-IK16-MD": "test_chapter4.py",
    "C4.3-tan-half-degenerate": "test_closed_trig.py",
    "C4.3.1-ws-3R-uneq": "test_chapter4.py",
    "C4.3.1-ws2-3R-general": "test_chapter4.py",
    "C4.3.3-2R-ik-boundary": "test_closed_forms.py",
    "C4.3.3-2R-ik-out": "test_closed_forms.py",
}
"""Beginnings of identifiers of the inverse kinematics, and the file whose tests use them."""

UR10_DEGREES = [
    [-120.0, -120.0, 30.0, 0.0, 90.0, -180.0],
    [-120.0, -114.2534599296, 42.26369007, 161.9897698596, -90.0, 0.0],
    [-120.0, -91.0655471107, -30.0, 31.0655471107, 90.0, -180.0],
    [-120.0, -73.5267334084, -42.26369007, -154.2095765215, -90.0, 0.0],
    [-21.3706735978, -106.4732665916, 42.26369007, -25.7904234785, 90.0, 81.3706735978],
    [-21.3706735978, -88.9344528893, 30.0, 148.9344528893, -90.0, -98.6293264022],
    [-21.3706735978, -65.7465400704, -42.26369007, 18.0102301404, 90.0, 81.3706735978],
    [-21.3706735978, -60.0, -30.0, -180.0, -90.0, -98.6293264022],
]
"""Notes 4.22-4.23 with the digits the print leaves out; found by closed form, by descents and by another library."""


def planar(lengths, task):
    return Arm.from_dh([("R", length, 0.0, 0.0, 0.0) for length in lengths], task=task)


def pose_at(x, phi=0.0):
    T = np.eye(4)
    T[:2, :2] = [[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]]
    T[0, 3] = x
    return T


def test_every_number_of_the_inverse_kinematics_is_used(truth):
    for name in truth:
        if name.startswith(("C4.2", "C4.3")) or (name.startswith("C1.7") and name.endswith("-ik")):
            assert any(name.startswith(beginning) for beginning in COVERED), name
    for beginning, file in COVERED.items():
        text = (HERE / file).read_text(encoding="utf-8")
        assert f'"{beginning}' in text, (beginning, file)


@pytest.mark.parametrize("name", ["C4.3-IK16-MD", "C4.3-IK16-MD-1rad"])
def test_sixteen_solutions(truth, name):
    """The arm of Manseur and Doty, and the one with a radian for a degree."""
    case = truth[name]
    arm = Arm.from_dh([tuple(row) for row in case["inputs"]["dh"]], task="pose")
    T = np.array(case["inputs"]["T"])
    expected = case["expected"]
    wanted = np.array(expected["q"]) if "q" in expected else np.radians(expected["q_deg"])
    for found in (solve_all(arm, T), solve_general(arm, T)):
        assert len(found) == expected["n"] == 16
        assert found.completeness == "complete"
        assert same_set(arm, found.q, wanted, 1e-6)
        assert worst_error(arm, found.q, T) < 1e-9
        assert no_duplicates(arm, found.q)


def test_the_catalogues_manseur_doty_has_all_sixteen(truth):
    case = truth["C4.3-IK16-MD"]
    arm = catalogue()["manseur_doty"].arm
    found = solve_all(arm, arm.fk(case["expected"]["q"][0]))
    assert len(found) == 16
    assert same_set(arm, found.q, np.array(case["expected"]["q"]), 1e-6)


def test_the_ur10_of_the_notes_has_exactly_eight():
    arm = catalogue()["ur10_notes"].arm
    expected = np.radians(UR10_DEGREES)
    found = solve_all(arm, arm.fk(expected[0]))
    assert len(found) == 8
    assert found.completeness == "complete"
    assert same_set(arm, found.q, expected, 1e-8)
    assert len(set(found.names)) == 8


@pytest.mark.parametrize("name", ["C4.2-ws-2R", "C4.2-ws-2R-eq"])
def test_a_2r_reaches_its_ring_and_nothing_else(truth, name):
    case = truth[name]
    arm = planar((case["inputs"]["l1"], case["inputs"]["l2"]), "xy")
    low, high = case["expected"]["r_min"], case["expected"]["r_max"]
    for inside in (low + 1e-4, 0.5 * (low + high), high - 1e-4):
        assert len(solve_all(arm, pose_at(inside))) == 2
    assert solve_all(arm, pose_at(high + 1e-4)).completeness == "none"
    if low > 0.0:
        assert solve_all(arm, pose_at(low - 1e-4)).completeness == "none"
    else:
        assert solve_all(arm, pose_at(0.0)).completeness == "infinite"


def test_a_3r_reaches_its_ring(truth):
    """Notes 4.41-4.43: a self-motion everywhere inside, none outside."""
    case = truth["C4.3.1-ws-3R-uneq"]
    for lengths, low, high in zip(
        case["inputs"]["l"], case["expected"]["r_min"], case["expected"]["r_max"], strict=True
    ):
        arm = planar(lengths, "xy")
        for inside in (low + 1e-2, 0.5 * (low + high), high - 1e-2):
            assert solve_all(arm, pose_at(inside)).completeness == "infinite"
        assert len(solve_all(arm, pose_at(high + 1e-3))) == 0
        if low > 0.0:
            assert len(solve_all(arm, pose_at(low - 1e-3))) == 0


def test_a_3r_turns_its_hand_all_around_in_its_dexterous_rings_only(truth):
    """Generalised 4.40, by asking for 90 angles of the hand at places around each border."""
    case = truth["C4.3.1-ws2-3R-general"]
    for lengths, rings in zip(case["inputs"]["l"], case["expected"]["WS2_radial_intervals"], strict=True):
        arm = planar(lengths, "xy phi")
        borders = {value for ring in rings for value in ring}
        for r in {abs(value + side) for value in borders for side in (-1e-3, 1e-3)} | {0.05}:
            everywhere = all(
                len(solve_all(arm, pose_at(r, phi))) > 0 for phi in np.linspace(-math.pi, math.pi, 90, endpoint=False)
            )
            assert everywhere == any(low <= r <= high for low, high in rings), (lengths, r)


def test_the_stretched_2r_has_one_solution_and_the_folded_infinitely_many():
    arm = planar((1.0, 1.0), "xy")
    assert len(solve_all(arm, pose_at(2.0))) == 1
    folded = solve_all(arm, pose_at(0.0))
    assert folded.completeness == "infinite"
    assert "joint 1" in folded.sentence
    assert np.allclose(np.abs(folded.q[:, 1]), math.pi, atol=1e-7)
    assert worst_error(arm, folded.q, pose_at(0.0)) < 1e-9


def test_the_elbow_of_the_notes_has_four_and_a_free_joint_on_its_axis():
    """4.83-4.105; on axis 1 joint 1 is free, and the elbow still has its two sides."""
    arm = catalogue()["elbow_3r"].arm
    q = np.array([0.4, 0.6, -1.1])
    found = solve_all(arm, arm.fk(q))
    assert len(found) == 4
    assert contains(arm, found.q, q)
    T = np.asarray(arm.fk([0.0, math.pi / 2, 0.0])).copy()
    T[2, 3] -= 0.05
    above = solve_all(arm, T)
    assert above.completeness == "infinite"
    assert "joint 1" in above.sentence
    assert worst_error(arm, above.q, T) < 1e-9


@pytest.mark.parametrize("key", ["puma560", "irb120"])
def test_a_straight_wrist_has_infinitely_many_solutions(key):
    arm = catalogue()[key].arm
    q = np.array([0.3, 0.5, -0.9, 0.4, 0.0, -0.6]) - np.array([row.theta for row in arm.rows]) * [0, 0, 0, 0, 1, 0]
    T = np.asarray(arm.fk(q))
    for found in (solve_all(arm, T), solve_general(arm, T)):
        assert found.completeness == "infinite"
        assert worst_error(arm, found.q, T) < 1e-9
        straight = np.abs(np.sin(found.q[:, 4] + arm.rows[4].theta)) < 1e-6
        assert straight.any()
    assert "q4" in solve_all(arm, T).sentence
