"""The list of all solutions as a sequence."""

import copy
import pickle

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik.solve_all import solve_all


def found_for(key="puma560"):
    arm = catalogue()[key].arm
    return solve_all(arm, arm.fk(arm.limits.mean(axis=1) + 0.2))


def test_it_is_a_sequence_of_configurations():
    found = found_for()
    assert [q.tolist() for q in found] == found.q.tolist()
    assert found[0].tolist() == found.q[0].tolist()
    assert found[-1].tolist() == found.q[-1].tolist()
    assert found[1:3].tolist() == found.q[1:3].tolist()
    assert found[found.within_limits].tolist() == found.q[found.within_limits].tolist()
    assert len(list(found)) == len(found) == len(found.names)
    with pytest.raises(IndexError):
        found[len(found)]


def test_none_is_empty():
    arm = catalogue()["planar_2r"].arm
    T = np.asarray(arm.fk([0.0, 0.0])).copy()
    T[0, 3] = 9.0
    found = solve_all(arm, T)
    assert list(found) == []
    assert not found


@pytest.mark.parametrize("key", ["puma560", "panda"])
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda found: pickle.loads(pickle.dumps(found))])
def test_it_can_be_copied_and_pickled(key, copied):
    found = found_for(key)
    again = copied(found)
    assert again.q.tobytes() == found.q.tobytes()
    assert again.names == found.names
    assert again.sentence == found.sentence
    assert all(np.array_equal(a, b) for a, b in zip(again.families, found.families, strict=True))
    T = found.arm.fk(found[0])
    assert np.array_equal(again.arm.fk(again[0]), T)
    assert again.equivalents(0).tolist() == found.equivalents(0).tolist()
