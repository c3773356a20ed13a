"""The trihedron of the way of the tool."""

import numpy as np

from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.frame import trihedron
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.state import planned_now
from armlab.content.robots import catalogue
from armlab.session.state import State, apply


def example(key):
    return planned_now(with_planned(apply(State.initial(catalogue()["puma560"]), TakeExample(key))))


def test_on_an_arc_it_is_that_of_the_circle():
    planned = example("circle")
    circle = planned.legs[0].tool_path.position
    for time in np.linspace(0.0, planned.duration, 9):
        p, t, n, b, curvature = trihedron(planned, float(time))
        np.testing.assert_allclose(curvature, 1.0 / circle.radius, rtol=1e-3)
        inwards = (circle.centre - p) / circle.radius
        np.testing.assert_allclose(n, inwards, atol=2e-3)
        np.testing.assert_allclose(np.cross(t, n), b, atol=1e-9)


def test_on_a_line_there_is_no_normal_and_no_curvature():
    planned = example("corner_stop")
    found = trihedron(planned, 0.4 * planned.legs[0].motion.duration)
    assert found.curvature == 0.0
    assert not found.n.any()
    np.testing.assert_allclose(found.t, [0.0, 1.0, 0.0], atol=1e-6)


def test_where_nothing_can_be_run_there_is_none():
    assert trihedron(example("out_of_reach"), 0.0) is None
