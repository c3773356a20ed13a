"""An independent implementation agrees: the Robotics Toolbox, on every standard table."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from support.arms import random_q

STANDARD = [key for key, robot in catalogue().robots.items() if robot.arm.convention == "standard"]


def peer_of(arm):
    """Return the same arm in the Robotics Toolbox."""
    import roboticstoolbox as rtb

    links = []
    for row in arm.rows:
        if row.revolute:
            links.append(rtb.RevoluteDH(d=row.d, a=row.a, alpha=row.alpha, offset=row.theta))
        else:
            links.append(rtb.PrismaticDH(theta=row.theta, a=row.a, alpha=row.alpha, offset=row.d))
    return rtb.DHRobot(links, base=arm.base, tool=arm.tool)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("key", STANDARD)
def test_the_robotics_toolbox_agrees(key, rng):
    arm = catalogue()[key].arm
    peer = peer_of(arm)
    for q in random_q(arm, rng, 10):
        np.testing.assert_allclose(arm.fk(q), peer.fkine(q).A, rtol=0, atol=1e-9)
        np.testing.assert_allclose(arm.jacobian(q), peer.jacob0(q), rtol=0, atol=1e-9)


@pytest.mark.filterwarnings("ignore")
def test_the_modified_table_agrees_too(rng):
    import roboticstoolbox as rtb

    arm = catalogue()["panda"].arm
    links = [rtb.RevoluteMDH(d=row.d, a=row.a, alpha=row.alpha, offset=row.theta) for row in arm.rows]
    peer = rtb.DHRobot(links, base=arm.base, tool=arm.tool)
    for q in random_q(arm, rng, 10):
        np.testing.assert_allclose(arm.fk(q), peer.fkine(q).A, rtol=0, atol=1e-9)
