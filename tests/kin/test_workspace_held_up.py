"""Whatever a page asks of a section comes in short pieces and looks only where something is reached."""

import itertools
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from armlab.kin.arm import Arm
from armlab.kin.workspace import boundary, wrist_turns
from armlab.kin.workspace.around import all_zero
from armlab.kin.workspace.faces import COMPARED, TOGETHER, finding_faces
from armlab.kin.workspace.sections import section
from armlab.kin.workspace.surface import near_boundary
from armlab.kin.workspace.wrist_turns import ROLLS, TRIED


@pytest.fixture(scope="module")
def found():
    """Return the section of an elbow that reaches over itself and whose joint 1 is limited."""
    rows = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
    return section(Arm.from_dh(rows, limits=[[-1.0, 1.0], [-0.5, 2.8], [-2.3, 0.0]]), 32, 4096, wanted=1.0)


def pieces_of(work):
    """Return how many pieces work has, and its result."""
    count = 0
    while True:
        try:
            next(work)
        except StopIteration as done:
            return count, done.value
        count += 1


def test_faces_are_looked_for_where_something_is_reached_however_large_the_grid_is(found):
    """Two cells beside each other along u among a million: s from -1 to 0 in one, to 1 in the other."""
    grid = replace(found.grid, shape=(1000 * found.grid.coarser, 1000 * found.grid.coarser))
    arcs = all_zero(1000 * 1000, grid.joint)
    arcs.length[:] = -1.0
    cells = np.array([700, 701]) * 1000 + 900
    arcs.start[cells, 0], arcs.length[cells, 0] = -1.0, [1.0, 2.0]
    arcs.covered[cells] = [1.0, 2.0]
    count, faces = pieces_of(finding_faces(grid, arcs))
    assert count < 10
    side = grid.coarser * grid.step
    corner = np.array(grid.low) + side * np.array([701, 900])
    side_ends = np.stack([corner, corner + np.array([0.0, side])])
    assert_allclose(faces.edges, np.broadcast_to(side_ends, faces.edges.shape), atol=1e-12)
    # From 0 to 1, to half a value of s at which the cells are compared, on each side.
    assert_allclose([faces.s.min(), faces.s.max()], [0.0, 1.0], atol=2.0 * pi / COMPARED)
    assert_allclose(np.diff(faces.s, axis=1).sum(), 1.0, atol=2.0 * pi / COMPARED)


def test_faces_lie_between_neighbours_of_which_one_covers_s(found):
    """As the definition says it: each pair of cells and each value of s by itself."""
    rows, columns = (-(-size // found.grid.coarser) for size in found.grid.shape)
    s = -pi + 2.0 * pi / COMPARED * (np.arange(COMPARED) + 0.5)
    expected = 0
    for cell in range(rows * columns):
        for beside in [cell + columns] * (cell < (rows - 1) * columns) + [cell + 1] * ((cell + 1) % columns > 0):
            if found.arcs.covered[cell] > 0.0 and found.arcs.covered[beside] > 0.0:
                here, there = (found.arcs.holds(np.full(COMPARED, k), s) for k in (cell, beside))
                expected += int((here != there).sum())
    count, faces = pieces_of(finding_faces(found.grid, found.arcs))
    known = int((found.arcs.covered > 0.0).sum())
    assert len(faces.s) == expected > 0
    assert count >= 1 + 2 + 2 * (known // TOGETHER)


def test_a_boundary_that_was_prepared_computes_nothing_more_for_a_distance(found, monkeypatch):
    prepared = boundary.Boundary(found.grid, found.outline, found.arcs, found.filled)
    expected = boundary.Boundary(found.grid, found.outline, found.arcs, found.filled).distance(
        np.array([0.5, 0.1, 0.4])
    )
    count, _ = pieces_of(prepared.preparing())
    assert count >= 8
    monkeypatch.setattr(boundary, "finding_faces", None)
    monkeypatch.setattr(boundary, "lonely", None)
    to = prepared.distance(np.array([0.5, 0.1, 0.4]))
    assert to.distance == expected.distance
    assert_array_equal(to.foot, expected.foot)


def test_a_point_is_inside_where_an_odd_number_of_edges_lie_beyond_it(monkeypatch, rng):
    """Two stars with many points, one in the other; each point by itself, and pairs a few at a time."""
    angle = np.linspace(0.0, 2.0 * pi, 41)
    lines = tuple(
        (size * (1.0 + 0.3 * np.cos(10 * angle))) * np.array([np.cos(angle), np.sin(angle)]) for size in (1.0, 0.4)
    )
    lines = tuple(np.concatenate([line.T[:-1], line.T[:1]]) for line in lines)
    points = rng.uniform(-1.4, 1.4, (300, 2))
    points[:20, 1] = lines[0][:20, 1]  # on the height of a corner: one of the two edges there counts
    expected = []
    for u, v in points:
        crossings = 0
        for line in lines:
            for (u0, v0), (u1, v1) in itertools.pairwise(line):
                crossings += (v0 <= v) != (v1 <= v) and u0 + (v - v0) * (u1 - u0) / (v1 - v0) > u
        expected.append(crossings % 2 == 1)
    monkeypatch.setattr(boundary, "SPANNED", 7)
    assert_array_equal(boundary.inside_polygons(points.reshape(30, 10, 2), lines), np.reshape(expected, (30, 10)))
    assert not boundary.inside_polygons(points, ()).any()


def test_only_the_edges_at_the_height_of_a_point_are_looked_at(monkeypatch):
    """A comb of 2000 teeth along v, and points between them: a few edges for each, not all of them."""
    teeth = np.column_stack([np.tile([0.5, 1.0], 2000), np.linspace(0.0, 1.0, 4000)])
    comb = np.concatenate([[[0.0, 0.0]], teeth, [[0.0, 1.0], [0.0, 0.0]]])
    points = np.column_stack([np.full(1000, 0.25), (np.arange(1000) + 0.37) / 1000])
    looked_at, bincount = [], np.bincount
    monkeypatch.setattr(
        np, "bincount", lambda found, **options: looked_at.append(len(found)) or bincount(found, **options)
    )
    assert boundary.inside_polygons(points, (comb,)).all()
    assert len(points) <= sum(looked_at) <= 4 * len(points)


def test_areas_inside_of_lines_have_the_sign_of_their_sense():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], dtype=float)
    assert_array_equal(boundary.enclosed((square, 3.0 * square[::-1], square[:1])), [1.0, -9.0, 0.0])
    assert len(boundary.enclosed(())) == 0


def test_a_table_of_a_wrist_with_its_tool_aside_is_made_in_pieces(monkeypatch):
    """Where the last turn matters 180 values of it are tried; most directions need only a few of them."""
    rows = [("R", 0, pi / 2, 0.5, 0), ("R", 0.43, 0, 0, 0), ("R", 0.02, -pi / 2, 0.15, 0)]
    rows += [("R", 0, pi / 2, 0.43, 0), ("R", 0, -pi / 2, 0, 0), ("R", 0, 0, 0, 0)]
    tool = np.eye(4)
    tool[:3, 3] = 0.1, 0.0, 0.1
    wrist = wrist_turns.wrist_turns(Arm.from_dh(rows, limits=[[-2.0, 2.0]] * 6, tool=tool))
    tried, reaches = [], wrist_turns.WristTurns._reaches
    monkeypatch.setattr(
        wrist_turns.WristTurns, "_reaches", lambda self, t, d: tried.append(len(d)) or reaches(self, t, d)
    )
    count, _ = pieces_of(wrist.preparing())
    assert count >= len(tried) >= ROLLS
    assert max(tried) <= TRIED
    # All directions are tried with the first value.
    first = sum(tried[: next(k for k, size in enumerate(tried) if size < TRIED) + 1])
    assert sum(tried) < 0.3 * ROLLS * first
    assert pieces_of(wrist.preparing()) == (0, None)
    directions = np.random.default_rng(3).standard_normal((200, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    by_one = [any(bool(reaches(wrist, rolled(wrist, r), d[None])[0]) for r in wrist.rolls) for d in directions]
    assert_array_equal(wrist.allows(directions), by_one)


def rolled(wrist, roll):
    """Return the tool of a wrist after a turn of its last joint."""
    return wrist_turns.rotation(wrist.axes[2], roll) @ wrist.tool


def test_a_point_on_the_axis_of_joint_1_is_told_without_a_warning(found):
    assert not near_boundary(found, np.array([[0.0, 0.0, 5.0]]), 0.0)[0]
