"""Thin workspaces: their cells are halved until the error is small, and what is stated holds."""

import sys
from functools import cache
from math import cos, pi
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_grid import grid_for
from armlab.kin.workspace.section_size import MOST_CELLS, WANTED, _between, size
from armlab.kin.workspace.sections import section, sections

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"

CELLS, SAMPLES = 96, 20_000


@cache
def shell(thickness: float) -> Arm:
    """Return an arm that reaches a part of a hollow sphere about the origin, of 1 m and so thick."""
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
    return Arm.from_dh(rows, limits=[[-1.0, 1.0], [0.7, 2.4], [1.0, 1.0 + thickness]])


def volume(thickness: float) -> float:
    """Return its volume: integral of r² sin(theta) over two radians of joint 1, joint 2 and the stroke."""
    return 2.0 * (cos(0.7) - cos(2.4)) * ((1.0 + thickness) ** 3 - 1.0) / 3.0


@cache
def walked(thickness: float) -> tuple[list[tuple[bool, float, bool]], Section]:
    """Return of the sections of a shell whether they are finished, their steps and whether arcs are known; the last."""
    told = []
    for found in sections(shell(thickness), CELLS, SAMPLES):
        told.append((found.finished, found.step, found.arcs is not None))
    return told, found


@pytest.mark.parametrize("thickness", [0.02, 0.005])
def test_a_shell_thinner_than_two_cells_has_the_volume_of_its_closed_form(thickness):
    found = size(walked(thickness)[1])
    assert found.error <= WANTED * found.value
    assert abs(found.value - volume(thickness)) <= found.error


def test_the_cells_of_a_shell_too_thin_for_all_of_them_are_bounded_and_its_error_is_stated():
    found = section(shell(2e-4), 32, SAMPLES)
    said = size(found)
    assert found.filled.size <= MOST_CELLS * 32**2
    assert said.error > WANTED * said.value
    assert abs(said.value - volume(2e-4)) <= said.error


def test_a_smaller_error_may_be_wanted_and_a_larger_one_be_enough():
    steps = [section(shell(0.02), CELLS, SAMPLES, wanted=wanted).step for wanted in (1.0, 0.05)]
    assert steps[0] > steps[1] >= walked(0.02)[1].step
    assert WANTED < 0.05


def test_an_ordinary_arm_keeps_its_cells():
    arm = catalogue()["puma560"].arm
    asked, _ = grid_for(first_joint(arm), 64, np.random.default_rng(0))
    assert section(arm, 64, SAMPLES).step == asked.step


def test_while_the_cells_are_halved_what_there_was_before_is_yielded():
    finished, steps, whole = zip(*walked(0.02)[0], strict=True)
    assert finished == (False,) * (len(finished) - 1) + (True,)
    assert sorted(steps, reverse=True) == list(steps)
    assert whole.index(True) < len(whole) / 2
    assert all(whole[whole.index(True) :])


@pytest.mark.parametrize(("joints", "times"), [(3, 1), (4, 4)])
def test_where_s_comes_in_intervals_as_many_samples_tell_about_a_smaller_cell(joints, times, monkeypatch):
    rows = [("R", 0, pi / 2, 0.4, 0), *[("R", 0.5, 0, 0, 0)] * (joints - 1)]
    arm = Arm.from_dh(rows, limits=[[-1.0, 1.0], *[[-0.5, 1.5]] * (joints - 1)])
    module, asked = sys.modules["armlab.kin.workspace.sections"], []
    at = module._at

    def noted(joint, cells, samples, *more):
        asked.append((cells, samples))
        return at(joint, cells, samples, *more)

    monkeypatch.setattr(module, "_at", noted)
    next(None for _ in sections(arm, 16, 1024, wanted=1e-9) if len(asked) == 2)
    assert asked == [(16, 1024), (32, 1024 * times)]


@pytest.mark.parametrize(("i", "j"), [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_what_grows_evenly_is_told_by_the_cells_on_both_sides(i, j):
    """Beside the ends, and where only one cell on either side is reached, by the one there is."""
    even = np.add.outer(np.arange(1.0, 9.0), 0.5 * np.arange(8.0))
    found = _between(even, i, j, False)
    assert_allclose(found[1:-1, 1:-1], even[1:-1, 1:-1], atol=1e-12)
    assert_array_equal(found[i::2, j::2], even[i::2, j::2])
    even[0:2] = 0.0
    assert_allclose(_between(even, i, j, False)[3:-1, 1:-1], even[3:-1, 1:-1], atol=1e-12)


@pytest.mark.parametrize(
    ("kind", "seed", "reference", "unsure"),
    [
        ("3R, joint 1 limited", 13, 0.08451, 0.00023),
        ("4R, joint 1 limited", 25, 10.3249, 0.0099),
        ("PRR", 103, 0.4966, 0.0014),
        ("RRP", 14, 0.05087, 0.00026),
        ("6R, joint 1 limited", 10, 2.1508, 0.0036),
    ],
)
def test_thin_random_arms_state_at_most_a_hundredth_and_lie_inside_it(kind, seed, reference, unsure, monkeypatch):
    """In no. 25 branches end inside cells; of the 6R arm what is covered falls evenly outward, to half.

    References in m³ from ``judged(section(drawn(kind, seed)), 2.0, 77)``, with two standard deviations.
    """
    monkeypatch.setattr(sys, "path", [*sys.path, str(BENCHMARKS)])
    from random_volumes import drawn

    said = size(section(drawn(kind, seed), 128, 65_536))
    assert said.error <= WANTED * said.value
    assert abs(said.value - reference) <= said.error + unsure
