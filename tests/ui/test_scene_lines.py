"""Lines of overlays that are stretched, not made again: they end where they should all the same."""

from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.ui.scene import projections
from armlab.ui.scene.trace import Trace


@pytest.fixture
def box(monkeypatch):
    """Return the projections of an arm of size 1, whose lines keep by what they were stretched."""
    monkeypatch.setattr(projections, "seen", lambda line, on: setattr(line, "on", on))
    monkeypatch.setattr(projections, "move", lambda line, at: setattr(line, "at", at))
    monkeypatch.setattr(projections, "stretch", lambda line, factors: setattr(line, "factors", factors))
    found = object.__new__(projections._Box)
    found._size, found._made, found._drops = 1.0, {}, {"r": SimpleNamespace(points=None)}
    return found


@pytest.mark.parametrize(
    "ways",
    [[(2.0, 0.0), (1.0, 1.732)], [(1.99, 0.02), (2.0, 0.0)], [(0.0, 2.0), (2.0, 0.0)], [(-2.0, 0.0), (0.0, -2.0)]],
)
def test_a_dashed_line_ends_at_its_point_whatever_direction_it_had_before(box, ways):
    for x, y in ways:
        box._drop("r", (x, y), (0.0, 0.0, 0.0))
        line = box._drops["r"]
        ends = np.asarray(line.points).reshape(-1, 3) * line.factors
        np.testing.assert_allclose(ends[np.argmax(np.linalg.norm(ends, axis=1))], (x, y, 0.0), atol=1e-12)


def test_a_trace_is_kept_while_nobody_sees_it_and_goes_on_with_another_stroke():
    drawn = {}

    def add(name, segments, *_, **__):
        drawn[name] = np.array(segments)
        return SimpleNamespace(name=name, remove=lambda: drawn.pop(name))

    arm = catalogue()["planar_2r"].arm
    figure = SimpleNamespace(anatomy=SimpleNamespace(arm=arm))
    scene = SimpleNamespace(add_line_segments=add)
    trace = Trace(SimpleNamespace(drawn=SimpleNamespace(figure=figure), size=1.0, scene=scene, path=lambda name: name))
    for q in (0.0, 0.1, 0.2):
        trace.add(np.array([q, 0.5]))
    before = {name: segments.copy() for name, segments in drawn.items()}
    trace.lift()
    for q in (1.0, 1.1):
        trace.add(np.array([q, 0.5]))
    assert len(drawn) == 2
    assert all((drawn[name] == segments).all() for name, segments in before.items())
    longest = max(np.linalg.norm(np.diff(segments, axis=1), axis=2).max() for segments in drawn.values())
    assert longest < 0.5, "no stroke leads to where the arm went meanwhile"
    trace.clear()
    assert drawn == {}
