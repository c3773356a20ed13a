"""Sections and their sizes are found in short pieces of work, so that nobody who waits for another is held up."""

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.pull import pieces
from armlab.kin.workspace.rows import Rows
from armlab.kin.workspace.section_size import reach, reaching, size, sizing
from armlab.kin.workspace.sections import section


@pytest.fixture(scope="module")
def found():
    """Return the section of an elbow whose joint 1 is limited."""
    rows = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
    return section(Arm.from_dh(rows, limits=[[-1.0, 1.0], [-0.5, 1.5], [-2.3, 0.0]]), 32, 4096)


def result_of(work):
    """Return how many pieces work has, and its result."""
    count = 0
    while True:
        try:
            next(work)
        except StopIteration as done:
            return count, done.value
        count += 1


def test_a_size_is_found_in_pieces_none_of_which_goes_through_all_of_it(found):
    """Each choice of places that are left out is a piece by itself: four for the outline, four for joint 1."""
    count, value = result_of(sizing(found))
    assert count >= 2 * 4 + 2 * 4
    assert value == size(found)


def test_each_extreme_of_the_reach_is_a_piece(found):
    count, value = result_of(reaching(found))
    assert count >= 5
    assert value == reach(found)


def test_rows_that_are_there_stay_where_they_are_when_more_are_written():
    rows = Rows((3,), 4, -1.0)
    rows[np.arange(4)] = np.arange(12.0).reshape(4, 3)
    before = rows.blocks[0]
    rows[np.array([9])] = np.array([[7.0, 8.0, 9.0]])
    assert rows.blocks[0] is before
    assert_array_equal(rows[np.array([[1, 9], [2, 5]])], [[[3, 4, 5], [7, 8, 9]], [[6, 7, 8], [-1, -1, -1]]])
    assert_array_equal(rows.at(np.array([9, 0]), np.array([2, 1])), [9, 1])


def test_of_two_values_for_one_row_the_last_stays_as_in_an_array():
    rows = Rows((1,), 2)
    rows[np.array([5, 0, 5])] = np.array([[1.0], [2.0], [3.0]])
    assert_array_equal(rows.first(6)[:, 0], [2, 0, 0, 0, 0, 3])


def test_of_an_arm_with_twice_as_many_joints_half_as_many_configurations_are_pulled_together():
    six, twelve = (first_joint(Arm.from_dh([("R", 0.1, pi / 2, 0.1, 0)] * n)) for n in (6, 12))
    assert [piece.stop - piece.start for piece in pieces(six, 2048, 1024)] == [1024, 1024]
    assert [piece.stop - piece.start for piece in pieces(twelve, 2048, 1024)] == [512] * 4


def test_contours_go_round_every_part_and_every_hole_with_the_region_on_the_left():
    """A ring of 5 x 5 centres with a hole of one, and a single centre: crossings half way."""
    inside = np.zeros((10, 12), dtype=bool)
    inside[2:7, 2:7] = True
    inside[4, 4] = inside[4, 9] = False
    inside[8, 9] = True
    outline = Outline(np.arange(10.0), np.arange(12.0), inside, np.full((9, 12), 0.5), np.full((10, 11), 0.5))
    areas = [0.5 * float(u[:-1] @ v[1:] - u[1:] @ v[:-1]) for u, v in (line.T for line in outline.contours)]
    # A half square is cut off at each corner of the 5 x 5; round one centre goes a diamond.
    assert areas == [25 - 4 / 8, -0.5, 0.5]
    assert all((line[0] == line[-1]).all() for line in outline.contours)
