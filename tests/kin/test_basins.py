"""Maps of basins of attraction: what a film begun at a pixel does, the map shows."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import Basins, basins
from armlab.kin.ik.iterate.basins import FAILED, NOT_YET
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.transforms import transform

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
THREE_R = catalogue()["planar_3r"].arm
ELBOW = catalogue()["elbow_3r"].arm
TARGET = transform(position=[0.9, 0.7, 0.0])

MOST = 40

REGULAR = 0.02
"""Smallest over largest singular value: an iteration that comes below magnifies rounding, which then decides."""


def whole(*arguments, **options) -> Basins:
    """Return the finished map."""
    *_, last = basins(*arguments, **options)
    return last


def start_of(found, row, column, joints=(1, 2)):
    q = found.rest.copy()
    q[joints[0] - 1], q[joints[1] - 1] = found.across[column], found.up[row]
    return q


def apart(arm, q, solution):
    """Return the largest difference of two configurations, whole turns not counted."""
    turned = np.abs(np.exp(1j * np.asarray(q)) - np.exp(1j * np.asarray(solution)))
    return float(np.max(np.where(arm.revolute, turned, np.abs(q - solution))))


CASES = [
    (TWO_R, TARGET, {}),
    (ELBOW, ELBOW.fk(catalogue()["elbow_3r"].home), {"joints": (2, 3), "rest": [0.4, 0.0, 0.0]}),
    (THREE_R, THREE_R.fk([0.5, 0.9, -0.4]), {"joints": (3, 1), "rest": [0.0, 1.2, 0.0]}),
    (THREE_R, TARGET, {"task": ik.task_vector(THREE_R, "xy", joints={3: 0.6}), "rest": [0.0, 0.0, 1.0]}),
    (THREE_R, TARGET, {"task": "xy", "locked": [False, False, True], "rest": [0.0, 0.0, 0.7]}),
    (ELBOW, ELBOW.fk([0.2, 0.4, 0.5]), {"limits": "clamp", "joints": (2, 3), "rest": [0.1, 0.0, 0.0]}),
]


SPREAD = [divmod(7 * k % 16, 4) for k in range(16)]
"""The pixels of a 4 x 4 map, neighbours far from each other."""


@pytest.mark.parametrize("method", list(ik.iteration_methods()))
@pytest.mark.parametrize("case", range(len(CASES)))
def test_a_film_begun_at_a_pixel_ends_in_the_solution_of_the_map(case, method):
    arm, target, options = CASES[case]
    found = whole(arm, target, method, (4, 4), most=MOST, **options)
    assert found.rows == 4
    joints = options.get("joints", (1, 2))
    shared = {key: options[key] for key in ("task", "limits", "locked") if key in options}
    compared = 0
    for row, column in SPREAD:
        if compared == 3:
            break
        start = start_of(found, row, column, joints)
        trace = ik.iterate(arm, target, start, method, most=MOST, **{"limits": "none", **shared})
        # A matrix that Broyden corrects many times may come near to a singular one unseen.
        wild = method == "broyden" and trace.iterations > 12
        if wild or np.min(trace.sigma_min / trace.sigma_max) < REGULAR:
            continue
        compared += 1
        index = found.index[row, column]
        assert trace.success == (index != FAILED), (row, column, trace.reason)
        # An error that is just at the tolerance may be on either side of it.
        assert abs(trace.iterations - found.iterations[row, column]) <= 1
        if index != FAILED:
            assert apart(arm, trace.q[-1], found.solutions[index]) < 2e-3
    assert compared >= 3


def test_the_solutions_of_the_map_are_those_of_the_closed_form_and_keep_their_numbers():
    known = solve_all(TWO_R, TARGET).q
    found = whole(TWO_R, TARGET, "dls_error", (24, 24), solutions=known)
    np.testing.assert_array_equal(found.solutions, known)
    assert set(np.unique(found.index)) == {0, 1}
    # Without: the same basins, numbered as they are met.
    other = whole(TWO_R, TARGET, "dls_error", (24, 24))
    order = [int(np.argmin([apart(TWO_R, q, one) for one in known])) for q in other.solutions]
    np.testing.assert_array_equal(np.array(order)[other.index], found.index)


def test_it_is_white_where_the_method_fails():
    # Out of reach nothing converges.
    far = whole(TWO_R, transform(position=[3.0, 0.0, 0.0]), "newton", (8, 8), most=20)
    assert (far.index == FAILED).all()
    assert len(far.solutions) == 0
    # The middle row of an odd grid is the stretched arm, where Newton has no step at all.
    near = whole(TWO_R, TARGET, "newton", (9, 9))
    assert near.up[4] == pytest.approx(0.0, abs=1e-12)
    assert (near.index[4] == FAILED).all()
    assert (near.iterations[4] == 0).all()
    assert (near.index[[2, 6]] != FAILED).any()


def test_fewer_joints_than_components_fail_everywhere_without_a_step_where_the_method_needs_as_many():
    arm = catalogue()["planar_2r"].arm
    found = whole(arm, arm.fk([0.4, 0.8]), "newton", (4, 4), task="xy phi")
    assert (found.index == FAILED).all()
    assert found.rows == 4
    tall = whole(arm, arm.fk([0.4, 0.8]), "gauss_newton", (4, 4), task="xy phi")
    assert (tall.index != FAILED).any()


def test_mirrored_arms_have_mirrored_maps():
    """With the target on the x axis a change of sign of both angles mirrors everything."""
    target = transform(position=[1.2, 0.0, 0.0])
    found = whole(TWO_R, target, "newton", (16, 16), solutions=solve_all(TWO_R, target).q)
    assert {0, 1} <= set(np.unique(found.index))
    turned = found.index[::-1, ::-1]
    swapped = np.where(turned == FAILED, FAILED, 1 - turned)
    # Starts beside the edge of a basin are decided by rounding: all but a few agree.
    assert np.mean(swapped == found.index) > 0.97


def test_turning_the_target_about_the_base_moves_the_map_along_joint_1():
    columns = 12
    step = 2 * math.pi / columns
    first = whole(TWO_R, TARGET, "dls_constant", (12, columns))
    turned = transform([[math.cos(step), -math.sin(step), 0], [math.sin(step), math.cos(step), 0], [0, 0, 1]])
    second = whole(TWO_R, turned @ TARGET, "dls_constant", (12, columns))
    assert np.mean((first.index != FAILED) == (np.roll(second.index, -1, axis=1) != FAILED)) > 0.97
    np.testing.assert_allclose(
        np.roll(second.iterations, -1, axis=1)[first.index != FAILED], first.iterations[first.index != FAILED], atol=1
    )


def test_it_comes_in_pieces_row_after_row_and_stops_when_nobody_asks():
    pieces = basins(TWO_R, TARGET, "gradient", (64, 64), most=60)
    seen = [next(pieces) for _ in range(4)]
    assert seen[0].rows < 64
    last = seen[-1]
    assert (last.index[: last.rows] != NOT_YET).all()
    assert (last.index[last.rows :] == NOT_YET).all()
    pieces.close()
    assert list(pieces) == []
    # What was given out does not change afterwards.
    before = [one.index.copy() for one in seen]
    again = list(basins(TWO_R, TARGET, "gradient", (64, 64), most=60))
    for one, copy in zip(seen, before, strict=True):
        np.testing.assert_array_equal(one.index, copy)
    rows = [one.rows for one in again]
    assert rows == sorted(rows)
    assert rows[-1] == 64
    assert len(rows) > len(set(rows))  # it takes breath inside a piece


def test_the_same_call_gives_the_same_map_bit_by_bit():
    one, other = (whole(ELBOW, ELBOW.fk([0.3, 0.5, 0.7]), "newton", (10, 10), joints=(2, 3), seed=4) for _ in range(2))
    for name in ("index", "iterations", "solutions", "across", "up", "rest"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes()
    moved = whole(ELBOW, ELBOW.fk([0.3, 0.5, 0.7]), "newton", (2, 2), joints=(2, 3), seed=5)
    assert not np.array_equal(moved.rest, one.rest)


def test_the_grid_is_a_turn_or_the_limits_that_are_kept():
    scara = catalogue()["scara"].arm
    options = {"joints": (1, 3), "rest": [0.1, 0.5, 0.1, 0.0]}
    free = whole(scara, scara.fk([0.1, 0.5, 0.1, 0.0]), "newton", (2, 4), **options)
    np.testing.assert_allclose(free.across, np.radians([-135, -45, 45, 135]), atol=1e-12)
    kept = whole(scara, scara.fk([0.1, 0.5, 0.1, 0.0]), "newton", (2, 4), limits="clamp", **options)
    low, high = scara.limits[0]
    np.testing.assert_allclose(kept.across, low + (high - low) * np.array([1, 3, 5, 7]) / 8, atol=1e-12)
    low, high = scara.limits[2]
    np.testing.assert_allclose(kept.up, low + (high - low) * np.array([1, 3]) / 4, atol=1e-12)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"method": "newtom"}, "method: unknown name 'newtom'; did you mean 'newton'"),
        ({"grid": (0, 4)}, "grid: expected a whole number, at least 1, got 0"),
        ({"grid": (4,)}, "grid: expected two numbers, rows and columns"),
        ({"grid": (2000, 2000)}, "at most 1000000 starts, got 2000 x 2000"),
        ({"joints": (1, 1)}, "joints: expected two different joints"),
        ({"joints": (1, 3)}, "joints: expected two joints of 1 to 2"),
        ({"joints": (0, 1)}, "joints: expected a whole number, at least 1, got 0"),
        ({"rest": [1.0]}, "rest: expected 2 finite numbers"),
        ({"rest": [1.0, math.nan]}, "rest: expected 2 finite numbers"),
        ({"most": 0}, "most: expected a whole number, at least 1"),
        ({"limits": "maybe"}, "limits: unknown name 'maybe'"),
        ({"tolerance": (0.0, 1.0)}, "tolerance: expected two positive numbers"),
        ({"parameters": {"alpha": 1.0}}, "parameters of newton: unknown name 'alpha'"),
        ({"solutions": [[1.0]]}, r"solutions: expected finite numbers of shape \(k, 2\)"),
        ({"solutions": [[1.0, math.inf]]}, r"solutions: expected finite numbers of shape \(k, 2\)"),
        ({"locked": [True]}, "locked: expected 2 times True or False"),
        ({"locked": [True, False]}, "joints: expected two joints that are not locked"),
        ({"locked": [True, True]}, "joints: expected two joints that are not locked"),
    ],
)
def test_bad_input_is_refused_at_once_in_words(options, said):
    with pytest.raises(InputError, match=said):
        basins(TWO_R, TARGET, **options)


def test_a_redundant_arm_is_refused_with_what_to_do():
    said = "got 2 and 3: a redundant arm has infinitely many solutions; lock joints or take one as a task component"
    with pytest.raises(InputError, match=said):
        basins(THREE_R, TARGET, task="xy")
    with pytest.raises(InputError, match="target"):
        basins(TWO_R, np.eye(3))
