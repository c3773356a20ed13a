"""The judge of inverse kinematics is judged: it accepts what is right, and refutes errors that are planted."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import IkSolutions, beyond_limits
from support.arms import random_arm, random_q

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks"))

import ik_judge
import ik_slow
from judging.cases import CLASSES, Case, made
from judging.charges import charges
from judging.curves import error_along
from judging.one import by_least_squares, judged
from judging.probe import Probe
from judging.search import distinct, searched

STARTS = 256


def puma() -> Arm:
    return catalogue()["puma560"].arm


def regular_case() -> Case:
    """Return a pose of the PUMA with eight solutions, far from singular."""
    return made(puma(), np.array([0.4, 0.9, -0.6, 0.5, 0.8, -1.1]), "regular")


def answer(arm: Arm, q: np.ndarray, said: str, sentence: str = "planted", families: tuple = ()) -> IkSolutions:
    """Return a list of solutions as a solver would."""
    rows = np.asarray(q, dtype=float).reshape(-1, arm.n)
    beyond = beyond_limits(arm, rows)
    inside = ~beyond.any(axis=1)
    return IkSolutions(arm, rows, ("",) * len(rows), inside, beyond, said, sentence, "planted", "", families)


def kinds(case: Case, found: IkSolutions) -> set[str]:
    return {charge.kind for charge in charges(case, found, STARTS, np.random.default_rng(5))}


@pytest.fixture(scope="module")
def eight() -> IkSolutions:
    case = regular_case()
    found = ik.solve_all(case.arm, case.T)
    assert (len(found), found.completeness) == (8, "complete")
    return found


@pytest.mark.parametrize("seed", range(6))
def test_the_judges_kinematics_are_those_of_the_arm(seed):
    rng = np.random.default_rng(seed)
    arm = replace(random_arm(rng, 6), task=puma().task)
    probe, q = Probe(arm), random_q(arm, rng, 5)
    for row, T in zip(q, arm.fk(q), strict=True):
        # Some twenty products of numbers near 1.
        assert probe.size(row[None], probe.target(T))[0] < 1e-14
    G, h = probe.target(np.asarray(arm.fk(q[0]))), 1e-6
    J, _ = probe.linearised(q[:1].T.copy(), G)
    for i in range(arm.n):
        ends = np.repeat(q[:1], 2, axis=0)
        ends[:, i] += np.array([-h, h]) * probe.scales[i]
        _, e = probe.linearised(ends.T.copy(), G)
        # Central differences of a smooth function: h^2 of curvature, and rounding over h.
        assert_allclose(J[i, :, 0], (e[:, 0] - e[:, 1]) / (2 * h), atol=1e-8)


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "elbow_3r", "scara", "polar_rrp", "puma560", "panda"])
def test_the_judges_error_is_that_of_the_robots_task(key):
    arm = catalogue()[key].arm
    rng = np.random.default_rng(3)
    probe, q, other = Probe(arm), random_q(arm, rng), random_q(arm, rng)
    T = np.asarray(arm.fk(q))
    verdict = ik.judge(arm, T, other)
    place, turn = probe.errors(other[None], probe.target(T))
    assert_allclose([place[0], turn[0]], [verdict.position_error, verdict.rotation_error], atol=1e-8)


def test_a_right_list_is_accepted(eight):
    assert kinds(regular_case(), eight) == set()


@pytest.mark.parametrize("k", range(8))
def test_a_solution_that_was_dropped_is_found_missing(eight, k):
    case = regular_case()
    found = answer(case.arm, np.delete(eight.q, k, axis=0), "complete")
    generator = int(np.argmin(np.abs(Probe(case.arm).apart(eight.q, case.q)).max(axis=1)))
    assert kinds(case, found) == ({"missing", "q missing"} if k == generator else {"missing"})


def test_a_dropped_solution_of_a_list_that_says_at_least_is_no_error(eight):
    case = regular_case()
    assert kinds(case, answer(case.arm, eight.q[:0], "at least")) == {"q not found"}


def test_a_solution_listed_twice_is_refuted(eight):
    case = regular_case()
    for off in (0.0, 1e-9, 1e-4):
        rows = np.vstack([eight.q, eight.q[3] + off])
        assert "twice" in kinds(case, answer(case.arm, rows, "complete")), off


def test_a_solution_listed_twice_a_turn_apart_is_refuted(eight):
    case = regular_case()
    turned = eight.q[3] + 2 * np.pi * np.eye(6)[4]
    assert "twice" in kinds(case, answer(case.arm, np.vstack([eight.q, turned]), "complete"))


def test_none_is_refuted_by_the_joint_values_of_the_pose_and_by_the_search(eight):
    case = regular_case()
    assert kinds(case, answer(case.arm, np.empty((0, 6)), "none")) == {"false none"}
    assert kinds(case, answer(case.arm, np.empty((0, 6)), "complete")) == {"false none"}
    elsewhere = replace(case, q=np.zeros(6))
    assert kinds(elsewhere, answer(case.arm, np.empty((0, 6)), "none")) == {"false none"}


def test_none_is_accepted_where_the_pose_is_out_of_reach():
    case = regular_case()
    T = case.T.copy()
    T[:3, 3] *= 10.0
    assert kinds(replace(case, T=T), answer(case.arm, np.empty((0, 6)), "none")) == set()


def test_a_row_that_does_not_reach_is_refuted(eight):
    case = regular_case()
    rows = eight.q.copy()
    rows[2, 1] += 1e-5
    assert "not reached" in kinds(case, answer(case.arm, rows, "complete"))


def test_infinite_is_refuted_at_a_regular_pose(eight):
    case = regular_case()
    assert kinds(case, answer(case.arm, eight.q, "infinite")) == {"false infinite"}


def test_infinite_is_refuted_where_an_arm_with_joints_to_spare_is_stretched():
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 3, task="xy")
    bent, stretched = np.array([0.3, 0.5, -0.4]), np.array([0.3, 0.0, 0.0])
    assert kinds(made(arm, bent, "bent"), answer(arm, bent, "infinite")) == set()
    assert kinds(made(arm, stretched, "stretched"), answer(arm, stretched, "infinite")) == {"false infinite"}


def straight_wrist() -> Case:
    """Return a pose of the PUMA with a straight wrist, where only q4 + q6 counts."""
    return made(puma(), np.array([0.4, 0.9, -0.6, 0.5, 0.0, -1.1]), "straight wrist")


def test_complete_is_refuted_where_there_is_a_family():
    case = straight_wrist()
    assert kinds(case, answer(case.arm, case.q, "complete")) == {"family missed"}
    assert kinds(case, ik.solve_all(case.arm, case.T)) == set()


def test_infinite_without_the_family_of_the_pose_is_refuted():
    case = straight_wrist()
    turn = np.linspace(0.0, 6.0, 61)[:, None] * np.array([0.0, 0.0, 0.0, 1.0, 0.0, -1.0])
    curve = case.q + turn
    assert kinds(case, answer(case.arm, curve[1:3], "infinite", families=(curve,))) == set()
    others = ik.solve_all(case.arm, case.T)
    flipped = next(row for row in others.q if abs(Probe(case.arm).apart(row, case.q)[0]) > 0.5)
    found = answer(case.arm, flipped, "infinite", families=(flipped + turn,))
    assert kinds(case, found) == {"q missing"}


def test_a_pair_close_together_is_told_apart_and_may_not_be_listed_as_one():
    elbow = catalogue()["elbow_3r"].arm
    # Both sides of a stretched elbow, 2e-4 rad apart.
    case = made(elbow, np.array([0.3, 0.5, 1e-4]), "pair")
    pair = searched(Probe(elbow), Probe(elbow).target(case.T), STARTS, np.random.default_rng(2), case.q)
    pair = np.arctan2(np.sin(pair), np.cos(pair))  # the search may end a whole turn away
    near = pair[np.abs(Probe(elbow).apart(pair, case.q)).max(axis=1) < 1e-2]
    assert len(near) == 2
    assert kinds(case, answer(elbow, pair, "complete")) == set()
    others = np.array([row for row in pair if not (row == near).all(axis=1).any()])
    for one in (near[0], near[1], near.mean(axis=0)):
        assert kinds(case, answer(elbow, np.vstack([others, one]), "complete")) >= {"close one missing"}


def test_a_fold_is_one_solution_however_it_was_rounded():
    arm = catalogue()["planar_2r"].arm
    probe = Probe(arm)
    G = probe.target(np.asarray(arm.fk(np.array([0.7, 0.0]))))
    rows = np.array([[0.7, 0.0], [0.7 - 1e-8, 2e-8], [0.7 + 1e-8, -2e-8]])
    assert len(distinct(probe, rows, G)) == 1


def test_a_fold_is_no_curve_and_a_straight_wrist_is_one():
    probe = Probe(puma())
    case = straight_wrist()
    # A few roundings.
    assert error_along(probe, case.q, probe.target(case.T)) < 4e-15
    elbow = Probe(catalogue()["elbow_3r"].arm)
    q = np.array([0.3, 0.5, 0.0])
    assert error_along(elbow, q, elbow.target(np.asarray(elbow.arm.fk(q)))) == np.inf


def test_wrong_words_on_limits_are_refuted(eight):
    case = regular_case()
    narrow = replace(case.arm, limits=np.stack([case.q - 0.1, case.q + 0.1], axis=1))
    here = replace(case, arm=narrow)
    right = ik.solve_all(narrow, case.T)
    assert kinds(here, right) == set()
    assert kinds(here, replace(right, within_limits=np.zeros(8, dtype=bool))) == {"limits"}
    assert kinds(here, replace(right, within_limits=np.ones(8, dtype=bool))) == {"limits"}


def test_false_words_on_one_solution_are_refuted():
    case = regular_case()
    right = ik.solve(case.arm, case.T, q0=case.q)
    one = judged(case.arm, case.q, right)
    assert (one.solved, one.wrong) == (True, "")
    off = judged(case.arm, case.q, replace(right, q=right.q + 1e-4))
    assert not off.solved
    assert "said to be reached" in off.wrong
    none = judged(case.arm, case.q, replace(right, success=False, proven=True, reason="proven: there is none"))
    assert not none.solved
    assert none.wrong == "said to be proven not to be: proven: there is none"


def test_least_squares_solves_what_can_be_solved():
    case = regular_case()
    assert by_least_squares(case.arm, case.T, np.random.default_rng(0)) is not None
    far = case.T.copy()
    far[0, 3] += 10.0
    assert by_least_squares(case.arm, far, np.random.default_rng(0)) is None


def test_there_are_20_000_cases():
    assert sum(count for _, count in CLASSES.values()) == 20_000


@pytest.mark.parametrize("title", CLASSES)
def test_the_cases_of_a_class_are_the_same_at_every_call(title):
    make, _ = CLASSES[title]
    for one, other in zip(make(np.random.default_rng(1)), make(np.random.default_rng(1)), strict=False):
        assert one.label == other.label
        assert_allclose(one.T, other.T, rtol=0, atol=0)
        break


def test_a_smallest_run_fills_both_tables():
    lines = list(ik_judge.measure(share=0.0))
    _, every, refuted, single = "\n".join(lines).split("\n\n")
    assert len(every.splitlines()) == 2 + len(CLASSES) + 1
    assert len(refuted.splitlines()) > 2
    assert len(single.splitlines()) == 2 + len(catalogue().robots) + 2
    for table in (every, refuted, single):
        assert len({line.count("|") for line in table.splitlines()}) == 1


def test_a_smallest_run_of_the_clock_times_one_case_of_each_class():
    _, every, slowest = "\n".join(ik_slow.measure(share=0.0)).split("\n\n")
    assert len(every.splitlines()) == 2 + len(CLASSES) + 1
    assert len(slowest.splitlines()) >= 2 + ik_slow.SHOWN
    milliseconds = [float(row.split()[1]) for row in slowest.splitlines()[2:]]
    assert milliseconds == sorted(milliseconds, reverse=True)


def test_the_clock_times_the_cases_that_the_judge_judges(monkeypatch):
    """With the judge's own random search between the cases, or without it."""
    title, judged_cases = "structured 6R, moved by 0, 1e-10 to 1e-2", []
    monkeypatch.setattr(ik_judge, "charges", lambda case, *_: judged_cases.append(case) or [])
    ik_judge.judged_class(title, 3 / 3600, 11)
    clocked = list(ik_judge.cases(title, 3 / 3600, 11))
    assert len(clocked) == 3
    for one, other in zip(judged_cases, clocked, strict=True):
        assert_allclose(one.q, other.q, rtol=0, atol=0)
        assert_allclose(one.T, other.T, rtol=0, atol=0)
