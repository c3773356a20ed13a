"""The words of the pages Target and Solutions in other languages: none, all, infinitely many, and why."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from armlab.benches.target.solutions.found import families_of, listed
from armlab.benches.target.solutions.proof import Proof
from armlab.benches.target.solutions.question import Question
from armlab.benches.target.solutions.ui.page import _head
from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.ik.solve import solve
from armlab.kin.ik.verdict import Verdict
from armlab.session.branch_words import crossed, near_singularity
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import Judged
from armlab.ui.format import capitalised
from armlab.ui.html import joined
from armlab.ui.units import Units
from armlab.ui.verdicts import verdict_card, verdict_line
from support.saying import Listener

OTHERS = keys()[1:]
CLOSED = [key for key, robot in catalogue().robots.items() if closed_form_of(robot.arm) is not None]
SIDES = {"shoulder": ("left", "right"), "elbow": ("up", "down"), "wrist": ("flip", "no flip")}


def heard(language):
    listener = Listener(messages(language))
    listener.at("page/solutions")
    return listener


def head_of(arm, T, held=None):
    question = Question(arm, T, held or {})
    solutions = question.solve()
    return joined(_head(listed(question, solutions, families_of(arm, solutions), None)))


def targets_of(arm, home, rng):
    """Yield targets: as the arm has one, at zero, on axis 1, too near, and too far."""
    for q in (home, np.asarray(arm.clip(np.zeros(arm.n))), rng.uniform(*arm.limits.T)):
        for size in (1.0, 0.2, 0.0, 4.0):
            T = np.array(arm.fk(q), dtype=np.float64)
            T[:3, 3] *= size
            yield T


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize("key", CLOSED)
def test_what_is_known_of_all_solutions_is_translated(language, key):
    listener, robot = heard(language), catalogue()[key]
    for T in targets_of(robot.arm, robot.home, np.random.default_rng([5, *key.encode()])):
        listener.hear_markup([head_of(robot.arm, T)])
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize(("key", "pose"), [("manseur_doty", "sixteen"), ("panda", "home"), ("trunk9", "home")])
def test_what_elimination_and_searches_say_is_translated(language, key, pose):
    listener, robot = heard(language), catalogue()[key]
    near = np.array(robot.arm.fk(robot.poses[pose]), dtype=np.float64)
    far = near.copy()
    far[:3, 3] *= 3.0
    listener.hear_markup([head_of(robot.arm, near), head_of(robot.arm, far)])
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", OTHERS)
def test_what_random_starts_show_is_translated(language):
    listener, robot = heard(language), catalogue()["planar_2r"]
    T = np.array(robot.arm.fk(robot.home), dtype=np.float64)
    proof = Proof(Question(robot.arm, T, {}), Question(robot.arm, T, {}).solve(), 4096, 200)
    some = (np.zeros(2),)
    for known in ((0, 1), (0,)):
        for others in ((), some, 3 * some, 64 * some):
            listener.speech.text(replace(proof, known=frozenset(known), others=others).sentence)
    listener.speech.text(replace(proof, reached=0).sentence)
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize("notation", [Notation(), replace(Notation(), angle="rad", length="m")])
def test_verdicts_are_translated_with_all_that_is_short(language, notation):
    listener, units = heard(language), Units(notation)
    for status in ("reached", "limit", "beyond", "closest", "moving"):
        for place, turn in ((0.0, 0.0), (0.1, 0.0), (0.0, 0.2), (0.1, 0.2)):
            for limits in ((0,), (0, 2), (0, 1, 2), (1, 2, 3, 4)):
                found = Verdict(status, place, turn, limits if status == "limit" else ())
                listener.hear_markup([str(verdict_card(found, units)), str(verdict_line(found, units))])
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", OTHERS)
def test_notes_of_a_drag_are_translated(language, rng):
    listener, notes = heard(language), set[str]()
    for words in permutations(SIDES, 2):
        before, now = (tuple(f"{word} {SIDES[word][k]}" for word in words) for k in (0, 1))
        notes |= {crossed(before, now), crossed(now, before)}
    notes |= {crossed(("shoulder front",), ("shoulder back",)), crossed(("slide ahead",), ("slide behind",))}
    notes |= {crossed(("det J above 0",), ("det J below 0",))}
    for robot in catalogue().robots.values():
        notes |= {near_singularity(robot.arm, rng.uniform(*robot.arm.limits.T), 10.0) for _ in range(20)}
    for note in sorted(notes - {""}):
        verdict = Judged("moving", 0.1, 0.0, (), (note,))
        assert capitalised(note) in str(verdict_card(verdict, Units(Notation())))
        listener.hear_markup(
            [str(verdict_card(verdict, Units(Notation()))), str(verdict_line(verdict, Units(Notation())))]
        )
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("language", OTHERS)
def test_a_pose_that_a_search_misses_is_told_in_the_language(language):
    listener, arm = heard(language), catalogue()["planar_2r"].arm
    far = np.array(arm.fk([0.1, 0.2]), dtype=np.float64)
    far[:3, 3] *= 3.0
    listener.speech.text(solve(arm, far, [0.1, 0.2]).reason)
    assert sorted(listener.missing) == []
