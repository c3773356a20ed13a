"""What a cell of the page Plan asks for: a joint the arm has not, as after a change of arm, is refused in words."""

import pytest

from armlab.benches.motion.plan.limits import LimitJoint
from armlab.benches.motion.plan.points import SetWaypointJoint, SetWaypointPose
from armlab.benches.motion.plan.ui.limits import limit_command
from armlab.benches.motion.plan.ui.points import point_command
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.state import State

STATE = State.initial(catalogue()["planar_2r"])


@pytest.mark.parametrize(("asked", "cell"), [(point_command, "q"), (limit_command, "vmax"), (limit_command, "amax")])
@pytest.mark.parametrize("joint", [2, 9])
def test_a_joint_that_the_arm_has_not_is_refused(asked, cell, joint):
    with pytest.raises(InputError, match=f"joint: expected 1 to 2, got {joint + 1}"):
        asked(STATE, f"{cell} {joint}", "10")


@pytest.mark.parametrize("component", ["zz", "", "xy", "10"])
def test_a_component_that_a_pose_has_not_is_refused(component):
    with pytest.raises(InputError, match="component: unknown name"):
        point_command(STATE, f"pose {component}", "10")


def test_cells_that_there_are_make_commands():
    (joint,) = point_command(STATE, "q 1", "10")
    assert isinstance(joint, SetWaypointJoint)
    assert joint.joint == 1
    (pose,) = point_command(STATE, "pose x", "400")
    assert isinstance(pose, SetWaypointPose)
    (limit,) = limit_command(STATE, "amax 0", "10")
    assert isinstance(limit, LimitJoint)
    assert (limit.joint, limit.of) == (0, "acceleration")
