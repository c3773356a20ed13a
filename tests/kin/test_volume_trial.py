"""The trial of volumes in ``benchmarks``, small: its judge finds what has a closed form, and its table is right."""

import math
import sys
from pathlib import Path

import pytest

from armlab.kin.arm import Arm
from armlab.kin.workspace.section_size import Size
from armlab.kin.workspace.sections import section

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def trial(monkeypatch):
    """Return the modules of the trial."""
    monkeypatch.setattr(sys, "path", [*sys.path, str(BENCHMARKS)])
    import judged_volume
    import volume

    return volume, judged_volume


def test_the_judge_finds_an_area_with_a_closed_form_from_a_coarse_section(trial):
    """A narrow 2R: each radius at one elbow angle, so r dr times the range of joint 1. The section is made wrong."""
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.6, 0, 0, 0)], limits=[[-0.7, 1.1], [0.0, 2.0]])
    exact = 0.9 * (1.6**2 - (1.0 + 0.36 + 1.2 * math.cos(2.0)))
    judged = trial[1].judged(section(arm, 16, 4096), effort=0.1)
    assert abs(judged.value - exact) <= judged.error <= 0.03 * exact


def test_a_whole_ring_is_judged_by_its_ends(trial):
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.6, 0, 0, 0)])
    judged = trial[1].judged(section(arm, 16, 4096))
    assert judged.value == pytest.approx(math.pi * (1.6**2 - 0.4**2), rel=1e-4)


def test_a_few_arms_pass_through_the_whole_trial(trial):
    volume = trial[0]
    lines = list(volume.table(volume.measured((0, 3), effort=0.02, resolution=16)))
    assert [line.split(" |")[0] for line in lines[2:]] == [
        "| planar 3R (1)",
        "| planar 3R, joint 1 limited (1)",
        "| all (2)",
    ]


@pytest.mark.parametrize(("said", "verdict"), [(1.005, "inside"), (1.015, "unclear"), (0.97, "outside")])
def test_a_verdict_gives_the_doubt_of_the_judge_a_name(trial, said, verdict):
    volume, judged_volume = trial
    assert volume.Trial("3R", Size(said, 0.01, "m³"), judged_volume.Judged(1.0, 0.01)).verdict == verdict


def test_what_stays_unclear_is_asked_a_third_time_with_more_effort(trial, monkeypatch):
    volume, judged_volume = trial
    asked = []

    def judged(found, effort, seed):
        asked.append((effort, seed))
        exact = volume.size(found).value
        return judged_volume.Judged(1.002 * exact, (0.1, 0.02, 1e-4)[len(asked) - 1] * exact)

    monkeypatch.setattr(volume, "judged", judged)
    (found,) = volume.measured([0], effort=0.5, resolution=16)
    assert [effort for effort, _ in asked] == [0.5 * volume.HARDER**k for k in range(3)]
    assert len({seed for _, seed in asked}) == 3
    assert found.verdict == "outside"
