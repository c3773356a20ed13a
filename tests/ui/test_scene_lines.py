"""Lines of overlays that are stretched, not made again: they end where they should all the same."""

from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.ui.scene import projections, trace


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


@pytest.mark.parametrize(
    ("rows", "flat"),
    [
        ([("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0)], True),
        ([("R", 0.4, 0, 0.35, 0), ("R", 0.3, 0, -0.35, 0)], True),
        ([("R", 0.4, 0, 0.35, 0), ("R", 0.3, 0, 0, 0)], False),
        ([("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0), ("P", 0, 0, 0, 0)], False),
    ],
    ids=["in the plane", "back in the plane", "above the plane", "with a slide"],
)
def test_z_is_left_out_only_where_it_stays_zero(rows, flat):
    base = transform(rotation_about("x", 0.5), (1.0, 2.0, 3.0))
    assert projections.is_flat(Arm.from_dh(rows, base=base, task="xy"), 0.7) == flat


class Paper:
    """A canvas of size 1 that keeps the lines drawn on it by name."""

    size = 1.0

    def __init__(self, arm):
        self.lines, self.scene, self.listeners = {}, SimpleNamespace(add_line_segments=self._add), []
        self.drawn = SimpleNamespace(figure=SimpleNamespace(anatomy=SimpleNamespace(arm=arm)))
        self.on_pose, self.on_hide, self.on_off = self.listeners.append, lambda call: None, lambda call: None

    def _add(self, name, segments, *_, **__):
        self.lines[name] = np.array(segments)
        return SimpleNamespace(name=name, remove=lambda: self.lines.pop(name))

    def path(self, name):
        return name

    def pose(self, *q):
        """Show a configuration."""
        self.shown_pose = np.array(q)
        for listener in self.listeners:
            listener(self.shown_pose)


def test_a_trace_begins_where_the_tool_stands():
    arm = catalogue()["planar_2r"].arm
    paper = Paper(arm)
    paper.pose(0.0, 0.0)
    trace.build(paper, None)(None)
    paper.pose(0.3, 0.0)
    (line,) = paper.lines.values()
    np.testing.assert_allclose(line, [[arm.position((0.0, 0.0)), arm.position((0.3, 0.0))]], atol=1e-6)


def test_a_trace_is_kept_while_nobody_sees_it_and_goes_on_with_another_stroke():
    paper = Paper(catalogue()["planar_2r"].arm)
    path, drawn = trace.Trace(paper), paper.lines
    for q in (0.0, 0.1, 0.2):
        path.add(np.array([q, 0.5]))
    before = {name: segments.copy() for name, segments in drawn.items()}
    path.lift()
    for q in (1.0, 1.1):
        path.add(np.array([q, 0.5]))
    assert len(drawn) == 2
    assert all((drawn[name] == segments).all() for name, segments in before.items())
    longest = max(np.linalg.norm(np.diff(segments, axis=1), axis=2).max() for segments in drawn.values())
    assert longest < 0.5, "no stroke leads to where the arm went meanwhile"
    path.clear()
    assert drawn == {}
