"""What the reading of checks refuses, and that a typical check is not met by chance."""

import numpy as np
import pytest

from armlab.content.check import check_types, read_check, read_state_check
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError


def robot():
    return catalogue()["planar_2r"]


def table(text):
    found = Table.parse("f.md", text)
    found.where = "step 1.check"
    return found


def check(text):
    return read_check(table(text), robot())


def state_check(text):
    return read_state_check(table(text), robot(), lambda markdown, where: markdown)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            'kind = "tool_at"\nposition = [1, 0, 0]\ntolerance_m = 0.41',
            "tolerance_m: 0.41 m is met by chance; .* 0.4 m",
        ),
        (
            'kind = "tool_at"\nposition = [1, 0, 0]\ntolerance_m = 0.1\nphi_deg = 0\ntolerance_deg = 46',
            "tolerance_deg: 46 is met by chance; expected at most 45 degrees",
        ),
        ('kind = "joint_at"\njoint = 1\nvalue_deg = 0\ntolerance_deg = 46', "tolerance_deg: 46 is met by chance"),
        ('kind = "joint_at"\njoint = 1\nvalue_deg = 0\ntolerance_deg = 0', "tolerance_deg: expected a positive number"),
        ('kind = "joints_at"\nq_deg = [0, 0]\ntolerance_deg = 50', "tolerance_deg: 50 is met by chance"),
        ('kind = "joints_at"\nq_deg = [0]\ntolerance_deg = 5', "q_deg: expected 2 numbers in brackets"),
        (
            'kind = "joints_at"\nq_deg = [0, 190]\ntolerance_deg = 5',
            "q_deg: outside the joint limits of Planar 2R: joint 2 is at 190°, outside its limits of -180° to 180°",
        ),
        ('kind = "joints_at"\nq_m = [0, 0]\ntolerance_deg = 5', "q_deg: missing"),
        (
            'kind = "tool_pose"\nposition = [1, 0, 0]\ntolerance_m = 0.1',
            "rpy_deg: missing; expected rpy_deg or rotation",
        ),
        (
            'kind = "tool_pose"\nposition = [1, 0, 0]\ntolerance_m = 0.1\nrpy_deg = [0, 0, 0]',
            "tolerance_deg: missing",
        ),
        (
            'kind = "tool_pose"\nposition = [1, 0, 0]\ntolerance_m = 0.1\ntolerance_deg = 5\n'
            "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]",
            "rotation: expected a rotation matrix",
        ),
        (
            'kind = "tool_pose"\nposition = [3, 0, 0]\ntolerance_m = 0.1\nrpy_deg = [0, 0, 0]\ntolerance_deg = 5',
            "position: it is 1.000 m out of the reach of Planar 2R",
        ),
        ('kind = "target_at"\nposition = [3, 0, 0]\ntolerance_m = 0.1', "position: it is 1.000 m out of the reach"),
        (
            'kind = "target_at"\nposition = [1, 0, 0]\ntolerance_m = 0.1\ntolerance_deg = 1',
            "tolerance_deg: expected rpy_deg or rotation with it",
        ),
        ('kind = "singular"\nwant = "yes"', "want: expected true or false, got 'yes'"),
        ('kind = "singular"\nsigma = 0.5', "sigma: expected at most 0.2, got 0.5"),
        ('kind = "rank"', "value: missing"),
        ('kind = "rank"\nvalue = 3', "value: expected a whole number from 0 to 2, got 3"),
        ('kind = "rank"\nvalue = 1.5', "value: expected a whole number"),
        ('kind = "rank"\nvalue = true', "value: expected a whole number"),
        ('kind = "manipulability_at_most"\nvalue = -1', "value: expected a positive number"),
        ('kind = "branch"', "elbow: missing; expected one of elbow, shoulder, wrist"),
        ('kind = "branch"\nelbow = "high"', "elbow: unknown value 'high'"),
        (
            'kind = "branch"\nshoulder = "left"',
            "shoulder: Planar 2R has no such branch; 'left' is for an arm like the PUMA",
        ),
        ('kind = "branch"\nwrist = "positive"', "wrist: Planar 2R has no such branch"),
        ('kind = "table_is"', r"rows: expected 1 to 12 tables \[\[rows\]\], got 0"),
        ('kind = "table_is"\n[[rows]]\na = 1', r"rows\[1\].type: missing"),
        ('kind = "table_is"\n[[rows]]\ntype = "R"\nalpha = 1', r"rows\[1\].alpha: .*write alpha_deg"),
        ('kind = "table_is"\nconvention = "craig"\n[[rows]]\ntype = "R"', "convention: unknown value 'craig'"),
        ('kind = "on_line"\npoint = [1, 0, 0]\ntolerance_m = 0.1', "direction: missing"),
        (
            'kind = "on_line"\npoint = [1, 0, 0]\ndirection = [0, 0, 0]\ntolerance_m = 0.1',
            "direction: expected a direction that is not zero",
        ),
        (
            'kind = "on_line"\npoint = [3, 0, 0]\ndirection = [0, 1, 0]\ntolerance_m = 0.1',
            "point: the line is 1.000 m out of the reach",
        ),
        (
            'kind = "on_line"\nshape = "plane"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\ntolerance_m = 0.1',
            "shape: the tool of Planar 2R is there in 100% of all poses; nothing is to be done",
        ),
        (
            'kind = "on_line"\nshape = "circle"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0\ntolerance_m = 0.1',
            "radius: expected a positive number",
        ),
        ('kind = "within_seconds"\nat_most_s = 0', "at_most_s: expected a positive number"),
        ('kind = "looked_at"', "panel: missing; expected one of switch, panel, film"),
        ('kind = "looked_at"\nfilm = 3', "film: expected a text"),
        ('kind = "all_of"', r"checks: expected at least two tables \[\[checks\]\], got 0"),
        ('kind = "all_of"\n[[checks]]\nkind = "singular"', "checks: expected at least two"),
        (
            'kind = "all_of"\n[[checks]]\nkind = "singular"\n[[checks]]\nkind = "rank"\nvalue = 9',
            r"checks\[2\].value: expected a whole number",
        ),
        (
            'kind = "all_of"\n[[checks]]\nkind = "singular"\n[[checks]]\nkind = "all_of"',
            r"checks\[2\].kind: 'all_of' cannot stand in itself",
        ),
        (
            'kind = "all_of"\n[[checks]]\nkind = "within_seconds"\nat_most_s = 1\n[[checks]]\nkind = "within_seconds"\n'
            "at_most_s = 1",
            "checks: expected one that asks more than time",
        ),
        ('kind = "singular"\ncolour = 1', "colour: unknown key"),
        ('kind = "singluar"', "kind: unknown value 'singluar'; did you mean 'singular'"),
    ],
)
def test_broken_checks_name_file_and_key(text, says):
    with pytest.raises(ContentError, match=rf"f\.md: step 1\.check\.{says}"):
        check(text)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('kind = "within_seconds"\nat_most_s = 9', "kind: 'within_seconds' is met by doing next to nothing"),
        ('kind = "singular"\n[[wrong]]\nkind = "singular"', r"wrong\[1\].says: missing"),
        ('kind = "singular"\n[[wrong]]\nsays = "x"', r"wrong\[1\].kind: missing"),
        ('kind = "singular"\n[[wrong]]\nsays = "x"\nkind = "rank"\nvalue = 9', r"wrong\[1\].value: expected"),
        (
            'kind = "singular"\n[[wrong]]\nsays = "x"\nkind = "rank"\nvalue = 2\nq_deg = [0, 999]',
            r"wrong\[1\].q_deg: outside the joint limits",
        ),
        (
            'kind = "singular"\n[[wrong]]\nsays = "x"\nkind = "rank"\nvalue = 2\nq_deg = [0, 9]\nq_m = [0, 9]',
            r"wrong\[1\].q_m: unknown key",
        ),
    ],
)
def test_broken_checks_of_a_step(text, says):
    with pytest.raises(ContentError, match=rf"f\.md: step 1\.check\.{says}"):
        state_check(text)


def test_all_kinds_are_found():
    assert set(check_types()) == {
        "fact",
        "tool_at",
        "tool_pose",
        "target_at",
        "joint_at",
        "joints_at",
        "joints_found",
        "from_limits",
        "manipulability_at_least",
        "manipulability_at_most",
        "singular",
        "rank",
        "on_line",
        "table_is",
        "branch",
        "motion_runs",
        "motion_played",
        "move_is",
        "all_of",
        "within_seconds",
        "looked_at",
    }


@pytest.mark.parametrize(
    ("text", "most"),
    [
        ('kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.05', 0.01),
        ('kind = "joints_at"\nq_deg = [30, 60]\ntolerance_deg = 3', 0.01),
        ('kind = "joint_at"\njoint = 2\nvalue_deg = 60\ntolerance_deg = 3', 0.03),
        ('kind = "singular"', 0.05),
        ('kind = "rank"\nvalue = 1', 0.05),
        ('kind = "on_line"\npoint = [1, 0, 0]\ndirection = [0, 1, 0]\ntolerance_m = 0.02', 0.03),
        ('kind = "joints_at"\nq_deg = [0, 0]\ntolerance_deg = 10', 0.01),
    ],
)
def test_random_states_rarely_pass(text, most, rng):
    asked, arm = check(text), robot().arm
    hits = [asked.is_met(Observation.of(arm, q)) for q in rng.uniform(*arm.limits.T, (2000, 2))]
    assert np.mean(hits) <= most
