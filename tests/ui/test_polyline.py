"""Lines drawn with few points."""

import numpy as np
import pytest

from armlab.ui.scene import _polyline
from armlab.ui.scene._polyline import simplified


def distance_to(points, line):
    """Return the largest distance from points (n, 3) to a line through points (k, 3), from each to every piece."""
    begin, way = line[:-1], np.diff(line, axis=0)
    share = np.sum((points[:, None] - begin) * way, axis=-1) / np.sum(way * way, axis=-1)
    nearest = begin + np.clip(share, 0.0, 1.0)[..., None] * way
    return float(np.linalg.norm(points[:, None] - nearest, axis=-1).min(axis=1).max())


def test_a_straight_line_needs_its_ends_alone():
    points = np.linspace([0.1, 0.2, 0.3], [0.7, -0.4, 0.9], 161)
    assert simplified(points, 1e-9).tolist() == [0, 160]


def test_corners_stay():
    points = np.concatenate([np.linspace([0, 0, 0], [1, 0, 0], 11), np.linspace([1, 0, 0], [1, 1, 0], 11)[1:]])
    assert simplified(points, 1e-6).tolist() == [0, 10, 20]


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_no_point_is_further_than_the_tolerance(rng, tolerance):
    t = np.linspace(0.0, 2 * np.pi, 161)
    a, b = rng.normal(size=(2, 3, 4))
    k = np.arange(1, 5)
    points = np.cos(np.outer(t, k)) @ a.T + np.sin(np.outer(t, k)) @ b.T
    kept = simplified(points, tolerance)
    assert distance_to(points, points[kept]) <= tolerance * (1 + 1e-6)
    assert len(kept) < len(points) or tolerance == 1e-4


def test_a_way_there_and_back_keeps_its_far_end():
    there = np.linspace([0, 0, 0], [1, 0, 0], 21)
    points = np.concatenate([there, there[-2::-1]])
    assert simplified(points, 1e-3).tolist() == [0, 20, 40]


@pytest.mark.parametrize("count", [1, 2, 5])
def test_a_tool_that_stays_is_a_point(count):
    kept = simplified(np.full((count, 3), 0.4), 1e-6)
    assert kept[0] == 0
    assert kept[-1] == count - 1


def test_all_spans_of_a_ragged_line_are_halved_together(rng, monkeypatch):
    """Each by itself would be some 3000 steps."""
    steps, distances = [], _polyline._distances
    monkeypatch.setattr(_polyline, "_distances", lambda *given: steps.append(len(given[0])) or distances(*given))
    points = np.cumsum(rng.normal(size=(3000, 3)), axis=0)
    assert len(simplified(points, 0.1)) > 2500
    assert len(steps) < 100


def test_of_points_that_are_equally_far_the_first_stays(rng):
    points = np.array([[0, 0, 0], [1, 1, 0], [2, 1, 0], [3, 0, 0]], dtype=float)
    assert simplified(points, 0.9).tolist() == [0, 1, 3]


def test_lines_one_behind_the_other_lose_the_points_that_each_would_lose_by_itself(rng):
    lines = [np.cumsum(rng.normal(size=(n, 3)), axis=0) for n in (40, 1, 2, 3, 150, 1)]
    after = np.cumsum([len(line) for line in lines])
    alone = [start + simplified(line, 0.7) for line, start in zip(lines, [0, *after[:-1]], strict=True)]
    together = simplified(np.concatenate(lines), 0.7, [*after[:-1], *(after - 1)])
    assert together.tolist() == np.concatenate(alone).tolist()
    assert len(together) < after[-1]
