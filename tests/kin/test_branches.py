"""Names of solutions: the words of the lessons, the same for every way to write an arm, and never twice."""

import math
import re

import numpy as np
import pytest

from armlab.content.checks._branches import Branches
from armlab.content.checks.branch import FEATURES
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.ik.branches import branch_names, features
from armlab.kin.ik.solve_all import solve_all
from support.arms import random_pose, random_q

H = math.pi / 2
WORDS = {"positive": "no flip", "negative": "flip"}

NAMED = {
    "planar_2r": 2,
    "planar_3r": 2,
    "elbow_3r": 4,
    "polar_rrp": 4,
    "cylindrical_rpp": 2,
    "scara": 2,
    "puma560": 8,
    "irb120": 8,
    "tx60": 8,
    "stanford": 8,
    "unimate": 8,
    "ur10": 8,
    "ur10_notes": 8,
    "ur5e": 8,
}


@pytest.mark.parametrize("key", list(NAMED))
def test_a_full_set_of_solutions_has_every_combination_of_words_once(key, rng):
    arm = catalogue()[key].arm
    full = 0
    for _ in range(12):
        found = solve_all(arm, arm.fk(random_q(arm, rng)))
        assert len(set(found.names)) == len(found)
        # A UR may have one shoulder's elbow out of reach, or reach both with the other side as well.
        if len(found) == NAMED[key] and not any("(" in name for name in found.names):
            full += 1
            parts = [name.split(", ") for name in found.names]
            assert all(len({part[i] for part in parts}) == 2 for i in range(len(parts[0])))
            assert 2 ** len(parts[0]) == NAMED[key]
    assert full > 0


@pytest.mark.parametrize(
    "key", ["planar_2r", "planar_3r", "elbow_3r", "puma560", "irb120", "irb140", "kr6r900", "tx60"]
)
def test_the_words_are_those_of_the_lesson_check(key, rng):
    arm = catalogue()[key].arm
    lesson = Branches(arm)
    known = [feature for feature in FEATURES if feature.has(lesson)]
    assert known
    for _ in range(4):
        found = solve_all(arm, arm.fk(random_q(arm, rng)))
        for q, name in zip(found.q, found.names, strict=True):
            for feature in known:
                side = feature.tell(lesson, q)
                if side == "neither":
                    continue
                word = feature.words[0 if side == "first" else 1]
                said = re.search(rf"{feature.field} ([a-z ]+)", name)
                assert said is not None
                if said[1] in feature.words or feature.field == "wrist":
                    assert said[1] == WORDS.get(word, word)


def test_elbow_up_is_a_negative_second_angle():
    arm = catalogue()["planar_2r"].arm
    assert branch_names(arm, np.array([[0.3, -0.5], [0.3, 0.5]])) == ("elbow up", "elbow down")


@pytest.mark.parametrize("key", ["planar_2r", "elbow_3r", "polar_rrp", "puma560", "ur10", "scara"])
def test_base_and_convention_do_not_change_names(key, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng, 6)
    elsewhere = Arm.from_dh(arm.rows, arm.convention, base=random_pose(rng), tool=arm.tool, task=arm.task)
    other = converted(arm, "modified" if arm.convention == "standard" else "standard")
    assert branch_names(elsewhere, q) == branch_names(arm, q)
    assert branch_names(other, q) == branch_names(arm, q)


def test_borders_have_words_of_their_own():
    arm = catalogue()["planar_2r"].arm
    assert branch_names(arm, np.array([[0.3, 0.0]])) == ("elbow straight",)
    assert branch_names(arm, np.array([[0.3, math.pi]])) == ("elbow folded",)
    for l1, l2 in ((0.5, 1.0), (1.0, 0.5)):
        unequal = Arm.from_dh([("R", l1, 0.0, 0.0, 0.0), ("R", l2, 0.0, 0.0, 0.0)])
        borders = branch_names(unequal, np.array([[0.3, 0.0], [0.3, math.pi], [0.3, -math.pi]]))
        assert [name.split(" (")[0] for name in borders] == ["elbow straight", "elbow folded", "elbow folded"]
    puma = catalogue()["puma560"].arm
    q = np.array([0.3, 0.5, -0.9, 0.4, 0.0, -0.6])
    assert "wrist straight" in branch_names(puma, q[None])[0]


def test_what_has_the_same_words_is_numbered():
    arm = catalogue()["puma560"].arm
    q = np.array([0.3, 0.5, -0.9, 0.4, 0.7, -0.6])
    names = branch_names(arm, q + np.array([[0.0], [0.01]]) * [0, 0, 0, 1, 0, 0])
    assert names[0].endswith(" (1)")
    assert names[1].endswith(" (2)")
    assert names[0][:-4] == names[1][:-4]


def test_other_arms_have_numbers(rng):
    arm = catalogue()["manseur_doty"].arm
    assert features(arm) == ()
    found = solve_all(arm, arm.fk(random_q(arm, rng)))
    assert found.names == tuple(f"solution {k + 1}" for k in range(len(found)))


def test_no_solutions_have_no_names():
    assert branch_names(catalogue()["puma560"].arm, np.empty((0, 6))) == ()


def test_an_arm_without_lengths_has_names_all_the_same():
    arm = Arm.from_dh([("R", 0.0, H, 0.0, 0.0), ("R", 0.0, -H, 0.0, 0.0), ("R", 0.0, 0.0, 0.0, 0.0)])
    names = branch_names(arm, np.array([[0.1, 0.5, 0.2], [0.1, -0.5, 0.2], [0.1, 0.0, 0.2]]))
    assert names == ("wrist no flip", "wrist flip", "wrist straight")
