"""Arms and what is computed with them can be copied, pickled and sent to another process, also after they were used."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.motion import Limits, ToolPath, Trajectory, coordinated, follow, held, law_type, law_types, path_type
from armlab.kin.velocity import determinant, singularities, subspaces
from armlab.kin.workspace import section, size
from support.elsewhere import computed

METHODS = ("fk", "frames", "position", "jacobian", "manipulability")
Q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
WAYPOINTS = [[0.0, 0.0], [1.0, 0.5], [2.0, 0.0]]


@pytest.fixture
def used():
    """An arm whose every formula is compiled, for one configuration and for many in both precisions."""
    arm = catalogue()["puma560"].arm
    for method in METHODS:
        for q in (Q, Q[None], Q[None].astype(np.float32)):
            getattr(arm, method)(q)
    return arm


COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{
        f"pickle {k}": lambda value, k=k: pickle.loads(pickle.dumps(value, k))
        for k in range(pickle.HIGHEST_PROTOCOL + 1)
    },
}


@pytest.mark.parametrize("how", COPIES)
def test_a_used_arm_is_copied_with_everything_that_it_is(used, how):
    twin = COPIES[how](used)
    assert str(twin) == str(used)
    for method in METHODS:
        np.testing.assert_array_equal(getattr(twin, method)(Q), getattr(used, method)(Q))
        np.testing.assert_array_equal(getattr(twin, method)(Q[None]), getattr(used, method)(Q[None]))
    for name in ("base", "tool", "limits", "speed_limits", "acceleration_limits"):
        assert not getattr(twin, name).flags.writeable


def test_a_copied_kernel_computes_the_same(used):
    """A kernel by itself, too: iterations keep some."""
    twin = pickle.loads(pickle.dumps(used._jacobian))
    assert twin.scalar(*Q) == used._jacobian.scalar(*Q)


def results():
    arm, small = catalogue()["puma560"].arm, catalogue()["planar_2r"].arm
    T = arm.fk(Q)
    path = path_type("spline").path(WAYPOINTS)
    yield "solutions", ik.solve_all(arm, T)
    yield "solution", ik.solve(arm, T)
    yield "verdict", ik.judge(arm, T, Q)
    yield "iteration", ik.iterate(arm, T, Q, method="newton")
    seen = section(small, resolution=48, samples=2000)
    size(seen)
    yield "section", seen
    yield "singularities", singularities(arm, np.zeros(6))
    yield "subspaces", subspaces(arm.jacobian(Q))
    yield "determinant", determinant(arm)
    limits = Limits(velocity=1.0, acceleration=2.0, jerk=10.0)
    for law, kind in law_types().items():
        yield f"trajectory, {law}", Trajectory(path, kind.along(path, limits, jumps=True))
    yield "coordinated", coordinated(Q, Q + 1.0, limits=limits, jumps=True)
    start, end = small.position([0.3, 1.0]), small.position([0.5, 1.4])
    yield "followed", follow(small, ToolPath(path_type("line").path([start, end]), held(np.eye(3))), s=20)


def test_results_are_copied_pickled_and_the_same_afterwards():
    for name, result in results():
        for how in (copy.copy, copy.deepcopy, COPIES["pickle 4"]):
            twin = how(result)
            assert type(twin) is type(result), name
            assert numbers(twin) == numbers(result), name


def numbers(value):
    """Return all arrays and numbers that an object holds itself, as text."""
    held_by = vars(value) if hasattr(value, "__dict__") else {}
    kinds = (np.ndarray, float, int, str, bool, type(None))
    return {name: repr(each) for name, each in held_by.items() if isinstance(each, kinds) and not name.startswith("_")}


def test_another_process_computes_the_same(used):
    motion = Trajectory(path_type("spline").path(WAYPOINTS), law_type("quintic").law(duration=2.0))
    motion.at([0.1])
    seen = section(catalogue()["planar_2r"].arm, resolution=48, samples=2000)
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        found = pool.submit(computed, used, Q, motion, seen).result()
    for there, here in zip(found, computed(used, Q, motion, seen), strict=True):
        np.testing.assert_array_equal(there, here)
