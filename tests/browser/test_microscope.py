"""The singularity microscope in a real browser: the example of the stretched 2R, its words, its marks in the scene."""

import numpy as np
import pytest

from armlab.kin.rotations import rotation_from_quaternion

pytestmark = pytest.mark.browser
POSE = "name => { const pose = window.__viserMutable.nodePoseData[name]; return [pose.position, pose.wxyz]; }"


def test_the_stretched_2r(visit):
    lab = visit("robot/planar_2r")
    lab.open_tab("Velocity")
    lab.page.locator('button.page[data-cell="microscope"]').click()
    lab.page.locator(".ms-bars").wait_for()
    lab.page.locator('select[data-cell="example"]:visible').select_option("stretched_across")
    lab.page.locator(".ms-table", has_text="J⁻¹ does not exist").wait_for()
    lab.rest()
    assert "Elbow: the arm is stretched" in lab.page.locator(".al .verdict").first.inner_text()
    rows = lab.page.locator(".ms-table tr").all_inner_texts()
    met = {row.split()[0]: row.split()[2] for row in rows[1:] if "exist" not in row}
    assert (met["J#"], met["αJᵀ"]) == ("100.0", "100.0")
    # The dashed line lies along the arm, which stands at 60 degrees.
    _, wxyz = lab.page.evaluate(POSE, lab.node("/microscope_lost_moving"))
    along = rotation_from_quaternion(np.array(wxyz))[:, 2]
    assert abs(along @ [0.5, np.sqrt(0.75), 0.0]) > np.cos(np.radians(1.0))
    wide = lab.page.evaluate(
        """() => [...document.querySelectorAll('.ms-bars, .ms-table, .ms-wish')]
          .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().width > 345).length"""
    )
    assert wide == 0
