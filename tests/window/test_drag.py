"""A hand that drags the handle of the target, and the arm that follows it."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.content.robots import catalogue
from armlab.session.parts.target import DRAG_TRAVEL, EndDrag
from support.student import arm_nodes, run, settled, student

PUMA = catalogue()["puma560"]
HAND = np.array(PUMA.arm.position(PUMA.home))


def test_a_hand_that_jumps_leads_the_arm_in_steps_until_it_is_there(url, monkeypatch):
    """A quarter turn about the base in one event: joint 1 goes there by no more than a drag may move it at once."""
    ends, end = [], EndDrag.apply
    monkeypatch.setattr(EndDrag, "apply", lambda self, state: [ends.append(self), end(self, state)][1])

    async def main():
        browser = await student(url)
        await settled(browser)
        base, angles = arm_nodes(browser)[0], []

        def note(message, _at):
            if message["type"] == "SetOrientationMessage" and message["name"] == base:
                w, _, _, z = message["wxyz"]
                angles.append(2 * np.arctan2(z, w))

        w, _, _, z = browser.nodes[base]["wxyz"]
        angles.append(2 * np.arctan2(z, w))
        browser.on_message = note
        turned = Rotation.from_euler("z", 90, degrees=True)
        wxyz = np.roll((turned * Rotation.from_quat(np.roll(browser.nodes["/target"]["wxyz"], -1))).as_quat(), 1)
        await browser.drag("start")
        await browser.drag("update", turned.apply(HAND), wxyz)
        await settled(browser)
        steps = np.unwrap(angles)
        assert np.abs(np.diff(steps)).max() <= DRAG_TRAVEL + 1e-6
        assert steps[-1] - steps[0] == pytest.approx(np.pi / 2, abs=1e-3)
        assert not ends, "the hand has not let go"
        await browser.drag("end")
        await settled(browser)
        assert len(ends) == 1
        await browser.close()

    run(main())
