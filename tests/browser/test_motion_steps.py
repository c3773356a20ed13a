"""The five planning steps in a real page: chosen one by one, with samples typed, and drawn one on the other."""

import re

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import SampleBy
from armlab.benches.motion.steps.worked import steps
from armlab.content.robots import catalogue
from armlab.session.state import State, apply

pytestmark = pytest.mark.browser

DRAWN = {2: {"path"}, 3: {"path", "samples"}, 4: {"path", "yes", "arms"}, 5: {"path", "yes", "arms", "result", "gap"}}


def shown(lab):
    """Return the nodes of the steps that are seen."""
    names = [name for name in lab.nodes() if "/motion_steps/" in name]
    seen = lab.page.evaluate("names => names.filter(n => window.__viserMutable.nodeRefFromName[n].visible)", names)
    return {name.rsplit("/", 1)[1] for name in seen}


def test_the_steps_are_drawn_one_on_the_other_and_few_samples_show_how_far_the_tool_is_apart(visit):
    lab = visit()
    lab.open_tab("Motion")
    lab.press("space-cartesian")
    lab.press("motion_steps")
    lab.page.get_by_text("poses of the tool to pass through").wait_for()
    lab.press("step 3")
    lab.type_into("samples", "0")
    assert "expected a whole number" in lab.page.locator("p.no[role=alert]").inner_text()
    lab.type_into("samples", "4")
    state = State.initial(catalogue()["puma560"])
    found = steps(with_planned(apply(apply(state, SetMove(1, space="cartesian")), SampleBy(4))))
    for step, drawn in DRAWN.items():
        lab.press(f"step {step}")
        lab.until(lambda drawn=drawn: drawn <= shown(lab))
        assert shown(lab) & set().union(*DRAWN.values()) == drawn
    numbers = lab.page.locator(".kv").last.inner_text().replace("\N{NO-BREAK SPACE}", " ")
    far = re.search(r"largest distance\s+([\d.]+) mm at s = ([\d.]+)", numbers)
    assert far is not None
    k = found.apart.worst
    np.testing.assert_allclose(
        [float(far[1]), float(far[2])], [1e3 * found.apart.distance[k], found.apart.s[k]], atol=0.06
    )
    lab.page.locator(".uplot canvas").first.wait_for()
    assert lab.errors == []
