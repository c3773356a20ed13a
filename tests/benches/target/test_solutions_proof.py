"""The search from thousands of random starts."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.target.solutions import job_proof as proof_job
from armlab.benches.target.solutions.proof import MOST, STARTS, Proof
from armlab.benches.target.solutions.state import (
    Prove,
    Solutions,
)
from armlab.errors import InputError
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import apply
from support.searched import OPEN, opened, rows, searched

# -- the proof ---------------------------------------------------------------------------------------------------


def proved(state, pieces=None):
    wanted = proof_job.wanted(state, frozenset())
    for k, piece in enumerate(proof_job.JOB.run(wanted.inputs)):
        state = proof_job.delivered(state, wanted.inputs, piece)
        if k + 1 == pieces:
            break
    return state


@pytest.mark.parametrize("key", ["planar_2r", "elbow_3r", "ur10e", "puma560"])
def test_thousands_of_starts_find_the_same_solutions(key):
    state = apply(searched(opened(key)), Prove(True))
    state = proved(state)
    proof = state[Solutions].proof
    assert proof.done
    assert proof.starts == STARTS >= 4000
    assert proof.others == ()
    assert proof.known == frozenset(range(len(rows(state))))
    assert f"the same {len(rows(state))} solution" in proof.sentence
    assert proof_job.wanted(state, OPEN) is None


def test_what_the_list_lacks_is_found():
    state = searched(opened("elbow_3r"))
    found = state[Solutions].found
    part = found.solutions
    lacking = type(part)(**{**vars(part), "q": part.q[:2], "names": part.names[:2]})
    state = apply(state, Prove(True))
    proof = type(state[Solutions].proof)(found.question, lacking)
    *_, last = proof_job.JOB.run(proof)
    assert len(last.others) == 2
    assert "2 others not in the list" in last.sentence


@pytest.mark.parametrize(
    ("others", "says"),
    [
        (0, "no other than those in the list."),
        (1, "1 other found that is not in the list, as expected where there are infinitely many."),
        (2, "2 others found that are not in the list, as expected where there are infinitely many."),
        (MOST, f"more than {MOST} others found that are not in the list, as expected"),
    ],
)
def test_what_is_found_among_infinitely_many_is_counted(others, says):
    found = searched(opened("elbow_3r"))[Solutions].found
    infinite = replace(found.solutions, completeness="infinite", families=())
    proof = Proof(found.question, infinite, 64, 3, frozenset({0}), (np.zeros(3),) * others)
    assert f"64 starts, 3 reached the target: {says}" in proof.sentence


def test_a_proof_is_given_up_when_the_target_moves_or_it_is_cancelled():
    state = proved(apply(searched(opened("puma560")), Prove(True)), 2)
    assert 0 < state[Solutions].proof.starts < STARTS
    assert proof_job.wanted(apply(state, MoveJoint(0, 0.4)), OPEN) is None
    assert proof_job.wanted(apply(state, ChooseRobot("scara")), OPEN) is None
    assert apply(state, Prove(False))[Solutions].proof is None
    with pytest.raises(InputError, match="still being computed"):
        apply(opened("puma560"), Prove(True))


def test_families_are_proved_inside_the_limits():
    state = proved(apply(searched(opened("panda")), Prove(True)), 6)
    proof = state[Solutions].proof
    assert proof.of_families
    assert "inside the limits" in proof.sentence
    assert all(state[Joints].arm.within_limits(q) for q in proof.others)
