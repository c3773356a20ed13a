"""A layer is built when first wanted, and shown, hidden and removed as a whole."""

from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from armlab.content.robots import catalogue
from armlab.session.parts.display import Show
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.state import State, apply
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer
from armlab.ui.switches import SKELETON, Switch
from armlab.window.layer_drawing import Drawing

FOG = Switch("fog", "Fog", "Made up.")


class Node:
    """A scene node as far as layers use it."""

    def __init__(self, name, visible=True):
        self.name, self.visible = name, visible
        self._impl = SimpleNamespace(removed=False)

    def remove(self):
        self._impl.removed = True


class Scene:
    """Adds nodes, as viser's scene does."""

    def add_frame(self, name, visible=True):
        return Node(name, visible)

    def reset(self):
        return "reset"


@dataclass
class FakeCanvas:
    """The parts of a canvas a layer may use."""

    client: object
    drawn: object = None
    post: object = None
    size: float = 1.0

    def __post_init__(self):
        self.listeners = []

    def on_pose(self, listener):
        self.listeners.append(listener)


@pytest.fixture
def canvas():
    return FakeCanvas(SimpleNamespace(scene=Scene()))


@pytest.fixture
def state():
    return State.initial(catalogue()["planar_2r"])


class Recorder:
    """A made-up layer that notes what happens to it."""

    def __init__(self, **options):
        self.built, self.shown, self.hidden, self.off, self.poses, self.nodes = 0, [], 0, 0, [], []
        self.layer = Layer("recorder", 0, (Joints,), self.build, **options)

    def build(self, canvas, state):
        self.built += 1
        self.nodes = [canvas.scene.add_frame("/a"), canvas.scene.add_frame("/b", visible=False)]
        canvas.on_hide(self.note_hidden)
        canvas.on_off(self.note_off)
        canvas.on_pose(self.poses.append)
        return self.shown.append

    def note_hidden(self):
        self.hidden += 1

    def note_off(self):
        self.off += 1


def test_a_switched_layer_is_built_when_first_on_and_hidden_as_a_whole(canvas, state):
    recorder = Recorder(switch=FOG)
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    assert recorder.built == 0
    on = apply(state, Show("fog", True))
    drawing.show(on, frozenset(), bare=False, hidden=frozenset())
    assert (recorder.built, len(recorder.shown)) == (1, 1)
    canvas.listeners[0]("q")
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    assert [node.visible for node in recorder.nodes] == [False, False]
    assert recorder.hidden == 1
    canvas.listeners[0]("another q")
    assert recorder.poses == ["q"], "a hidden layer hears of no pose"
    drawing.show(on, frozenset(), bare=False, hidden=frozenset())
    assert [node.visible for node in recorder.nodes] == [True, False], "what was hidden by the layer stays hidden"
    assert (recorder.built, len(recorder.shown)) == (1, 2)


def test_a_layer_is_shown_only_when_what_it_watches_differs(canvas, state):
    recorder = Recorder()
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    drawing.show(apply(state, Show("other", True)), frozenset(), bare=False, hidden=frozenset())
    assert len(recorder.shown) == 1
    drawing.show(apply(state, MoveJoint(0, 0.3)), frozenset(), bare=False, hidden=frozenset())
    assert len(recorder.shown) == 2


def test_a_layer_of_a_panel_comes_and_goes_with_it(canvas, state):
    recorder = Recorder(panel="film")
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset({"joints"}), bare=False, hidden=frozenset())
    assert recorder.built == 0
    drawing.show(state, frozenset({"film"}), bare=False, hidden=frozenset())
    assert recorder.nodes[0].visible
    drawing.show(state, frozenset({"joints"}), bare=False, hidden=frozenset())
    assert not recorder.nodes[0].visible


def test_a_layer_in_the_way_of_a_panel_is_hidden(canvas, state):
    recorder = Recorder()
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    drawing.show(state, frozenset(), bare=False, hidden=frozenset({"recorder"}))
    assert not recorder.nodes[0].visible
    drawing.show(state, frozenset(), bare=False, hidden=frozenset({"other"}))
    assert recorder.nodes[0].visible


def test_a_layer_that_is_only_in_the_way_is_not_told_that_it_is_switched_off(canvas, state):
    recorder, on = Recorder(switch=FOG), apply(state, Show("fog", True))
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(on, frozenset(), bare=False, hidden=frozenset())
    drawing.show(on, frozenset(), bare=False, hidden=frozenset({"recorder"}))
    assert (recorder.hidden, recorder.off) == (1, 0)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset({"recorder"}))
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    assert (recorder.hidden, recorder.off) == (1, 1)


def test_the_skeleton_is_there_also_when_a_panel_wants_to_be_seen_through(canvas, state):
    recorder = Recorder(switch=SKELETON)
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    assert recorder.built == 0
    drawing.show(state, frozenset(), bare=True, hidden=frozenset())
    assert recorder.built == 1


def test_a_removed_layer_leaves_no_node(canvas, state):
    recorder = Recorder()
    drawing = Drawing(recorder.layer, canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    recorder.nodes[1].remove()  # by itself
    drawing.canvas.remove()
    assert all(node._impl.removed for node in recorder.nodes)


def test_a_layer_that_fails_is_logged_and_stops_nothing(canvas, state, caplog):
    def build(canvas, state):
        raise ZeroDivisionError

    drawing = Drawing(Layer("broken", 0, (Joints,), build), canvas)
    drawing.show(state, frozenset(), bare=False, hidden=frozenset())
    drawing.show(apply(state, MoveJoint(0, 0.3)), frozenset(), bare=False, hidden=frozenset())
    assert caplog.text.count("layer broken failed") == 1


def test_a_layer_that_follows_the_arm_draws_the_newest_state_at_every_pose(canvas, state):
    canvas.shown, drawn = "shown", []
    layer = LayerCanvas(canvas, None)
    show = layer.follow(state, lambda *what: drawn.append(what))
    canvas.listeners[0]("on the way")
    moved = apply(state, MoveJoint(0, 0.3))
    show(moved)
    canvas.listeners[0]("there")
    assert drawn == [(state, "on the way"), (moved, "shown"), (moved, "there")]
