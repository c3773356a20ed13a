"""Each kind of check: met, not met, what it says, what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.check import Words, read_check, read_state_check
from armlab.content.checks._singular import singular_values
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError
from armlab.kin.arm import Arm
from armlab.kin.convert import converted
from armlab.kin.dh import Row
from armlab.kin.rotations import rotation_about, rotation_from_sequence
from armlab.kin.transforms import transform


def robot(key="planar_2r"):
    return catalogue()[key]


def table(text):
    found = Table.parse("f.md", text)
    found.where = "step 1.check"
    return found


def check(text, key="planar_2r"):
    return read_check(table(text), robot(key))


def seen(q_deg, key="planar_2r", **more):
    return Observation.of(robot(key).arm, np.radians(q_deg), **more)


def posed(R, p, key="puma560"):
    """An observation whose tool is anywhere."""
    return replace(Observation.of(robot(key).arm, robot(key).home), tool_pose=np.array(transform(R, p)))


# --- Configurations


def test_a_whole_configuration():
    asked = check('kind = "joints_at"\nq_deg = [30, 60]\ntolerance_deg = 3')
    assert asked.is_met(seen([32.9, 57.1]))
    assert asked.says(seen([30, 60])) == "All joints are where they should be."
    cases = {
        (33.1, 60): "Joint 1 is at 33.1° and should be at 30.0°.",
        (0, 0): "Joint 1 is at 0.0° and should be at 30.0°. 1 more joint is not there yet.",
        (30, -60): "Joint 2 is at −60.0° and should be at 60.0°. The sign is wrong",
        (-30, -60): "All joint values have the right size and the wrong sign.",
        (60, 30): "The values of joints 1 and 2 are exchanged.",
        (90, -60): "The tool is in the right place, but in another configuration of the arm: this is another branch.",
        (30, math.radians(60)): "Joint 2 is at 1.0° and should be at 60.0°. That is the number of radians",
    }
    for q, says in cases.items():
        assert not asked.is_met(seen(q))
        assert asked.says(seen(q)).startswith(says)


def test_angles_of_a_configuration_count_up_to_whole_turns():
    asked = check('kind = "joints_at"\nq_deg = [180, 0, 0, 0, 0, 0]\ntolerance_deg = 2', "ur5e")
    assert asked.is_met(seen([-179, 359, 0, -360, 1, 0], "ur5e"))
    assert not asked.is_met(seen([-177, 359, 0, -360, 1, 0], "ur5e"))


def test_a_configuration_of_turning_and_sliding_joints():
    text = 'kind = "joints_at"\nq_deg_m = [10, 20, 0.1, 30]\ntolerance_deg = 1\n'
    asked = check(f"{text}tolerance_m = 0.01", "scara")
    q = np.array([*np.radians([10, 20]), 0.1, math.radians(30)])
    arm = robot("scara").arm
    assert asked.is_met(Observation.of(arm, np.add(q, [0, 0, 0.009, 0])))
    assert not asked.is_met(Observation.of(arm, np.add(q, [0, 0, 0.011, 0])))
    assert "Joint 3 is at 0.150 m" in asked.says(Observation.of(arm, np.add(q, [0, 0, 0.05, 0])))
    with pytest.raises(ContentError, match=r"f\.md: step 1\.check\.tolerance_m: missing"):
        check(text, "scara")
    with pytest.raises(ContentError, match="q_deg_m: outside the joint limits"):
        check(f"{text.replace('0.1', '1')}tolerance_m = 0.01", "scara")
    assert asked.says(seen([1, 2])) == "The arm has 2 joints; it should have 4."


# --- Poses

POSE = 'kind = "tool_pose"\nposition = [0.4, 0.1, 0.9]\ntolerance_m = 0.02\ntolerance_deg = 5\n'
P = [0.4, 0.1, 0.9]


@pytest.mark.parametrize(
    ("R", "says"),
    [
        (rotation_about("z", -math.pi / 2), "the rotation is the transposed one"),
        (rotation_about("x", math.pi / 2), "it is rotated about x instead of z."),
        (rotation_about("y", -math.pi / 2), "it is rotated about y instead of z."),
        (rotation_about("z", 1.2), "its x axis points 21.2° away from where it should."),
        (rotation_about("z", math.pi / 2) @ rotation_about("x", math.pi), "its axes y and z point the wrong way"),
        (rotation_about("z", math.pi / 2) @ rotation_about("y", math.pi), "its axes x and z point the wrong way"),
    ],
)
def test_the_orientation_of_the_tool_names_mistakes(R, says):
    asked = check(f"{POSE}rpy_deg = [0, 0, 90]", "puma560")
    assert asked.is_met(posed(rotation_about("z", math.radians(94)), [0.4, 0.1, 0.915]))
    assert not asked.is_met(posed(R, P))
    assert asked.says(posed(R, P)).startswith(f"The position is right, the orientation is not: {says}")


def test_the_position_of_a_pose_counts_too():
    asked = check(f"{POSE}rotation = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]", "puma560")
    right, turned = rotation_about("z", math.pi / 2), rotation_about("z", 1.0)
    assert asked.says(posed(right, P)) == "The tool is where it should be."
    off = asked.says(posed(right, [0.4, 0.1, 0.7]))
    assert off == (
        "The tool is 0.200 m away from (0.400, 0.100, 0.900) m: z is 0.700 m and should be 0.900 m. "
        "The orientation is right."
    )
    assert "x and y are exchanged. The orientation is not right either: its" in asked.says(
        posed(turned, [0.1, 0.4, 0.9])
    )
    assert "z has the wrong sign" in asked.says(posed(right, [0.4, 0.1, -0.9]))


def test_roll_pitch_and_yaw_in_the_reverse_order():
    asked = check(f"{POSE}rpy_deg = [30, 40, 50]", "puma560")
    assert asked.is_met(posed(rotation_from_sequence("xyz", np.radians([30, 40, 50]), fixed=True), P))
    assert "in the reverse order" in asked.says(posed(rotation_from_sequence("xyz", np.radians([30, 40, 50])), P))


def test_the_pose_of_real_arms(rng):
    arm = robot("puma560").arm
    q = np.radians([20, 60, -150, 10, -40, 30])
    T = arm.fk(q)
    text = f'kind = "tool_pose"\nposition = {T[:3, 3].tolist()}\nrotation = {T[:3, :3].tolist()}\n'
    asked = check(f"{text}tolerance_m = 0.05\ntolerance_deg = 20", "puma560")
    assert asked.is_met(Observation.of(arm, q))
    hits = [asked.is_met(Observation.of(arm, each)) for each in rng.uniform(*arm.limits.T, (500, 6))]
    assert sum(hits) == 0


def test_the_handle_of_the_target():
    asked = check('kind = "target_at"\nposition = [1, 1, 0]\ntolerance_m = 0.05')
    assert asked.says(seen([0, 0])) == "There is no target yet: drag the handle."
    assert not asked.is_met(seen([0, 90]))
    assert asked.is_met(seen([0, 0], target=transform(position=[1.04, 1, 0])))
    assert "The target is 0.100 m away" in asked.says(seen([0, 90], target=transform(position=[1.1, 1, 0])))
    turned = check(
        'kind = "target_at"\nposition = [1, 1, 0]\ntolerance_m = 0.05\nrpy_deg = [0, 0, 90]\ntolerance_deg = 5'
    )
    assert not turned.is_met(seen([0, 0], target=transform(position=[1, 1, 0])))
    assert turned.is_met(seen([0, 0], target=transform(rotation_about("z", math.pi / 2), [1, 1, 0])))


# --- Singularities


def test_singular_and_not():
    yes, no = check('kind = "singular"'), check('kind = "singular"\nwant = false\nsigma = 0.1')
    assert yes.is_met(seen([33, 1]))
    assert yes.is_met(seen([33, 179]))
    assert not yes.is_met(seen([33, 5]))
    assert no.is_met(seen([33, 90]))
    assert not no.is_met(seen([33, 5]))
    assert "should be below 0.02 (lengths" in yes.says(seen([0, 90]))
    assert no.says(seen([0, 0])).startswith("The arm is singular here: the smallest singular value is 0.000")
    # Unit links, reach 2 m, length scale 1 m: at q = (0, 90°) J = [[-1, -1], [1, 0]].
    expected = np.linalg.svd([[-1.0, -1.0], [1.0, 0.0]], compute_uv=False)
    np.testing.assert_allclose(singular_values(robot().arm, np.radians([0, 90])), expected, rtol=0, atol=1e-12)
    assert f"{expected[-1]:.3f}" in yes.says(seen([0, 90]))


def test_singular_values_have_no_unit(robot, rng):
    """The same arm in other units has the same ones."""
    arm = robot.arm
    grown = [Row(row.kind, 10 * row.a, row.alpha, 10 * row.d, row.theta) for row in arm.rows]
    scale = np.where(arm.revolute, 1.0, 10.0)
    base, tool = arm.base.copy(), arm.tool.copy()
    base[:3, 3] *= 10
    tool[:3, 3] *= 10
    other = Arm.from_dh(grown, arm.convention, base, tool, arm.limits * scale[:, None], task=arm.task)
    for q in rng.uniform(*arm.limits.T, (5, arm.n)):
        np.testing.assert_allclose(singular_values(other, q * scale), singular_values(arm, q), rtol=0, atol=1e-9)


def test_the_rank():
    one, two = check('kind = "rank"\nvalue = 1'), check('kind = "rank"\nvalue = 2')
    assert one.is_met(seen([20, 0]))
    assert not one.is_met(seen([20, 50]))
    assert two.is_met(seen([20, 50]))
    assert "is 2 and should be 1: one more singular value must become zero" in one.says(seen([20, 50]))
    assert check('kind = "rank"\nvalue = 1.0') == one  # as a variant gives it
    assert two.says(seen([20, 0])) == "The rank of the task Jacobian is 1 and should be 2."
    # A wrist with axes 4 and 6 in one line and a stretched elbow: two ranks lost.
    arm = check('kind = "rank"\nvalue = 5', "puma560")
    assert arm.is_met(seen([20, 40, -120, 30, 0, 10], "puma560"))


def test_a_small_manipulability():
    asked = check('kind = "manipulability_at_most"\nvalue = 0.5')
    assert asked.is_met(seen([10, 29.9]))
    assert not asked.is_met(seen([10, 30.1]))
    assert asked.says(seen([10, 90])) == "The manipulability is 1.000 and should be at most 0.500."


# --- Lines


def test_a_line_a_circle_and_a_plane():
    on_line = check('kind = "on_line"\npoint = [1, 5, 0]\ndirection = [0, 2, 0]\ntolerance_m = 0.02')
    assert on_line.is_met(seen([0, 90]))
    assert on_line.is_met(seen([60, 240]))
    assert on_line.says(seen([0, 0])) == "The tool is 1.000 m away from the line: its x has to be smaller."
    circle = check(
        'kind = "on_line"\nshape = "circle"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\ntolerance_m = 0.02'
    )
    assert circle.is_met(seen([77, 120]))
    assert circle.is_met(seen([-77, -120]))
    assert not circle.is_met(seen([77, 110]))
    assert circle.says(seen([0, 180])).startswith("The tool is 1.000 m away from the circle")
    plane = check('kind = "on_line"\nshape = "plane"\npoint = [0, 1, 0]\nnormal = [0, 1, 0]\ntolerance_m = 0.02')
    assert plane.is_met(seen([90, 90]))
    assert not plane.is_met(seen([30, 90]))


# --- Tables

R3 = """kind = "table_is"
[[rows]]
type = "R"
d = 0.6
alpha_deg = 90
[[rows]]
type = "R"
a = 0.8
theta_deg = 30
[[rows]]
type = "P"
a = 0.5
d = 0.25
"""
ROWS = [Row("R", 0, math.pi / 2, 0.6), Row("R", 0.8, 0, 0, math.pi / 6), Row("P", 0.5, 0, 0.25)]


def of_rows(rows, convention="standard"):
    return Observation.of(Arm.from_dh(rows, convention), np.zeros(len(rows)))


def changed(i, **cells):
    return of_rows([replace(row, **cells) if k == i else row for k, row in enumerate(ROWS, start=1)])


def test_degrees_written_as_radians_are_named_where_they_are_less_than_a_turn():
    asked = check(R3.replace("alpha_deg = 90", "alpha_deg = 3"))
    rows = [replace(ROWS[0], alpha=3.0), *ROWS[1:]]
    assert not asked.is_met(of_rows(rows))
    assert "Row 1, α: this is the value in degrees, not in radians." in asked.says(of_rows(rows))


@pytest.mark.parametrize(
    ("cells", "says"),
    [
        ({"i": 1, "alpha": -math.pi / 2}, "Row 1, α: the sign is wrong."),
        ({"i": 1, "alpha": math.radians(math.pi / 2)}, "Row 1, α: this is the value in radians where degrees"),
        ({"i": 1, "d": 600.0}, "Row 1, d: this is the value in millimetres, not in metres."),
        ({"i": 1, "d": 0.0006}, "Row 1, d: this is a thousandth"),
        ({"i": 1, "a": 0.6, "d": 0.0}, "Row 1, a: a and d have changed places."),
        ({"i": 2, "alpha": math.pi / 6, "theta": 0.0}, "Row 2, α: α and θ have changed places."),
        ({"i": 2, "theta": math.pi / 6 + math.pi}, "Row 2, θ: half a turn off"),
        ({"i": 2, "a": 0.7}, "Row 2, a: 0.700 m is not right."),
        ({"i": 3, "kind": "R"}, "Row 3, joint type: the joint should be prismatic."),
        ({"i": 3, "d": -0.25, "theta": 1.0}, "Row 3, d: the sign is wrong."),
    ],
)
def test_the_first_wrong_cell_of_a_table_is_named(cells, says):
    asked = check(R3)
    assert asked.is_met(of_rows(ROWS))
    assert not asked.is_met(changed(**cells))
    assert asked.says(changed(**cells)).startswith(says)


def test_a_table_is_right_within_its_tolerances():
    asked = check(R3)
    assert asked.says(of_rows(ROWS)) == "The table is right."
    assert asked.is_met(changed(2, a=0.8009, theta=math.pi / 6 + math.radians(0.09)))
    assert asked.is_met(changed(2, theta=math.pi / 6 - math.tau))
    assert not asked.is_met(changed(2, a=0.8011))
    assert not asked.is_met(changed(2, theta=math.pi / 6 + math.radians(0.11)))


def test_a_table_of_the_other_convention():
    asked = check(R3)
    assert asked.says(of_rows(ROWS[:2])) == "The table has 2 rows; it should have 3 rows."
    assert (
        asked.says(of_rows(ROWS, "modified"))
        == "The table is in the modified convention; the standard one is asked for."
    )
    moved = converted(of_rows(ROWS).arm, "modified").rows
    assert asked.says(of_rows(moved)).startswith("The columns a and α are shifted by a row, as in the modified")
    craig = check(R3.replace('"table_is"\n', '"table_is"\nconvention = "modified"\n'))
    assert craig.is_met(of_rows(ROWS, "modified"))
    back = [Row("R", 0.8, 0, 0.6), Row("R", 0.5, 0, 0, math.pi / 6), Row("P", 0, 0, 0.25)]
    assert "shifted by a row, as in the standard" in craig.says(of_rows(back, "modified"))


def test_no_other_robot_has_the_table_of_one(robot):
    rows = "".join(
        f'[[rows]]\ntype = "{row.kind}"\na = {row.a}\nalpha_deg = {math.degrees(row.alpha)}\nd = {row.d}\n'
        f"theta_deg = {math.degrees(row.theta)}\n"
        for row in robot.arm.rows
    )
    asked = read_check(table(f'kind = "table_is"\n{rows}'), robot)
    met = {key for key, other in catalogue().robots.items() if asked.is_met(Observation.of(other.arm, other.home))}
    assert robot.key in met
    assert all(len(catalogue()[key].arm.rows) == robot.arm.n for key in met)
    for key in set(catalogue().robots) - met:
        assert len(asked.says(Observation.of(catalogue()[key].arm, catalogue()[key].home))) > 15


# --- Several checks, time, what was looked at

ALL = """kind = "all_of"
[[checks]]
kind = "tool_at"
position = [1, 1, 0]
tolerance_m = 0.05
[[checks]]
kind = "branch"
elbow = "up"
[[checks]]
kind = "within_seconds"
at_most_s = 60
"""


def test_all_of_several():
    asked = check(ALL)
    assert asked.is_met(seen([90, -90], seconds=59.0))
    assert asked.says(seen([0, 0], seconds=99.0)).startswith("The tool is 1.414 m away")
    assert asked.says(seen([0, 90], seconds=99.0)).startswith("This is elbow down, the mirror branch")
    assert asked.says(seen([90, -90], seconds=61.0)) == (
        "It took 61 s; at most 60 s are allowed. Begin the step again."
    )
    assert "The tool is where it should be." in asked.says(seen([90, -90], seconds=1.0))


def test_what_was_looked_at():
    asked = check('kind = "looked_at"\npanel = "table"\nswitch = "common_normal"\nfilm = "moves"')
    assert (asked.panels, asked.switches) == (("table",), ("common_normal",))
    assert asked.says(seen([0, 0])) == "Open the panel “table”."
    assert asked.says(seen([0, 0], panel="table")) == "Switch on “common normal”."
    opened = {"panel": "table", "switches": frozenset({"common_normal", "x"})}
    assert asked.says(seen([0, 0], **opened)) == "Play the film “moves” to its end."
    assert asked.is_met(seen([0, 0], **opened, films=frozenset({"moves"})))


# --- The check of a step, with the mistakes it expects

WRONG = """kind = "tool_at"
position = [1, 1, 0]
tolerance_m = 0.05
[[wrong]]
says = "Below the *table*."
kind = "tool_at"
position = [1, -1, 0]
tolerance_m = 0.05
q_deg = [0, -90]
[[wrong]]
says = "Stretched."
kind = "joints_at"
q_deg = [0, 0]
tolerance_deg = 2
"""


def state_check(text):
    return read_state_check(table(text), robot(), lambda markdown, where: f"<p>{markdown} {where}</p>")


def test_wrong_states_are_named():
    asked = state_check(WRONG)
    assert asked.judge(seen([0, 90])) == (True, "The tool is where it should be.")
    assert asked.judge(seen([0, -90])) == (False, "<p>Below the *table*. step 1.check.wrong[1].says</p>")
    assert asked.judge(seen([1, 0]))[1].startswith("<p>Stretched.")
    says = asked.judge(seen([45, 45]), Words(length=lambda value: "<1 m"))[1]
    assert says.startswith("The tool is &lt;1 m away")
    for wrong in asked.wrong:
        assert asked.judge(Observation.of(robot().arm, wrong.q)) == (False, wrong.says)
    assert (asked.is_met(seen([0, 90])), asked.is_met(seen([0, -90]))) == (True, False)
    assert asked.says(seen([0, -90])).startswith("The tool is 2.000 m away")
    with pytest.raises(ValueError, match="read-only"):
        asked.wrong[0].q[0] = 1.0


def test_a_wrong_state_that_is_right_as_well_is_right():
    asked = state_check(WRONG.replace("[1, -1, 0]", "[1, 1, 0]"))
    assert asked.judge(seen([0, 90]))[0]
