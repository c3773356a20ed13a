"""Three meanings of a rotation matrix: the numbers, the pictures, what is typed and what is refused."""

import itertools
import json
import math

import numpy as np
import pytest

from armlab.benches.body.forms.commands import PlaceBody, SetBodyTurn, SetWholeAxis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.meanings.facts import FACTS
from armlab.benches.body.meanings.state import (
    MATRIX,
    Meanings,
    SetVector,
    TurnElementary,
    elementary_of,
    image_of,
)
from armlab.benches.body.meanings.ui.page import SAID, _numbers, _of_the_notes
from armlab.benches.body.meanings.ui.scene import picture_of, steps
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Select
from armlab.session.session import Asked
from armlab.session.state import State, apply
from support.done import done
from support.forms import BareForm


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def shown(key, *commands):
    return opened(Set(Meanings, "shown", key), *commands)


def test_the_same_vector_in_both_frames():
    state = shown("coordinates", SetVector(0, 0.3), SetVector(1, -0.2), SetVector(2, 0.9))
    R = forms_of(state).R
    np.testing.assert_allclose(image_of(state), R @ [0.3, -0.2, 0.9], rtol=0, atol=1e-15)
    # Typed in the base, the others of the base stay.
    after = apply(state, SetVector(1, 0.4, in_base=True))
    expected = image_of(state)
    expected[1] = 0.4
    np.testing.assert_allclose(image_of(after), expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose(after[Meanings].p, R.T @ expected, rtol=0, atol=1e-15)


def ends(segments):
    """Return the last end of a way of strokes, of which each begins where the one before it ends."""
    for (_, end, _), (start, _, _) in itertools.pairwise(segments):
        np.testing.assert_allclose(start, end, rtol=0, atol=1e-15)
    return segments[-1][1]


def test_both_ways_of_steps_lead_to_the_vector():
    state = shown("coordinates")
    picture, image = picture_of(state), image_of(state)
    assert picture.body
    np.testing.assert_allclose(ends(picture.strokes), image, rtol=0, atol=1e-15)
    np.testing.assert_allclose(ends(picture.fine), image, rtol=0, atol=1e-15)
    np.testing.assert_allclose(picture.arrows[0][1], image, rtol=0, atol=1e-15)


def test_a_column_is_an_axis_of_the_body_and_a_row_one_of_the_base():
    R = forms_of(opened()).R
    for k in range(3):
        picture = picture_of(shown("orientation", Select(MATRIX, None, k)))
        np.testing.assert_allclose(picture.arrows[0][1], R[:, k], rtol=0, atol=1e-15)
        np.testing.assert_allclose(ends(picture.strokes), R[:, k], rtol=0, atol=1e-15)
        picture = picture_of(shown("orientation", Select(MATRIX, k, None)))
        np.testing.assert_allclose(picture.arrows[0][1], np.eye(3)[k], rtol=0, atol=1e-15)
        np.testing.assert_allclose(ends(picture.strokes), np.eye(3)[k], rtol=0, atol=1e-15)


def test_an_entry_is_the_cosine_of_the_angle_that_is_drawn():
    """Not the angle, as the text after 3.5 has it."""
    R = forms_of(opened()).R
    for i, j in ((0, 1), (2, 0), (1, 1)):
        picture = picture_of(shown("orientation", Select(MATRIX, i, j)))
        start, end = picture.fine[0][0], ends(picture.fine)
        assert start @ end / (np.linalg.norm(start) * np.linalg.norm(end)) == pytest.approx(R[i, j], abs=1e-12)
        text, _ = picture.labels[1]
        assert math.cos(math.radians(float(text[:-1]))) == pytest.approx(R[i, j], abs=1e-3)
    state = apply(shown("orientation", Select(MATRIX, 0, 1)), Set(Notation, "angle", "rad"))
    assert picture_of(state).labels[1][0].endswith(" rad")
    # Of two equal or opposite axes no arc is drawn.
    assert picture_of(shown("orientation", PlaceBody("none"), Select(MATRIX, 0, 0))).fine == []


def test_an_operator_carries_the_vector_along_the_arc_about_the_axis():
    state = shown("operator", SetWholeAxis((1.0, 2.0, 2.0)), SetBodyTurn(2.0))
    picture, v, image = picture_of(state), np.array(state[Meanings].p), image_of(state)
    assert not picture.body
    assert np.linalg.norm(image) == pytest.approx(np.linalg.norm(v))
    arc = picture.fine[1:-2]
    np.testing.assert_allclose(arc[0][0], v, rtol=0, atol=1e-12)
    np.testing.assert_allclose(ends(arc), image, rtol=0, atol=1e-12)
    still = picture_of(shown("operator", PlaceBody("none")))
    assert [text for text, _ in still.labels] == ["v", "v′ = R v"]


def test_steps_need_three_strokes():
    assert len(steps(np.array([0.1, 0.2, 0.3]), np.eye(3))) == 3


@pytest.mark.parametrize("key", SAID)
def test_every_meaning_has_its_numbers(key):
    text = str(_numbers(BareForm(), shown(key)))
    assert ("Angles between the axes" in text) == (key == "orientation")


@pytest.mark.parametrize("value", [1.5, -1.5])
@pytest.mark.parametrize("index", range(3))
def test_a_component_is_taken_in_both_frames(index, value):
    """The bound is that of the length, which is the same in both, so that no number is named that nobody typed."""
    for in_base in (False, True):
        state = opened(SetVector(index, value, in_base))
        shown = image_of(state) if in_base else state[Meanings].p
        assert shown[index] == pytest.approx(value)


def test_typed_components_are_commands():
    for cell, in_base in (("p 1", False), ("image 2", True)):
        state, form = shown("coordinates"), BareForm()
        form.show(_numbers(form, state))
        form.press(cell, "1/4")
        (asked,) = form.posted
        commands = asked.commands if isinstance(asked, Asked) else (asked,)
        assert commands == (SetVector(int(cell[-1]), 0.25, in_base),)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetVector(3, 0.0), r"component \(counted from 0\): expected 0 to 2, got 3"),
        (SetVector(0, 9.0), r"p: expected a length of at most 2.6, got 9.034"),
        (SetVector(0, 9.0, in_base=True), r"p: expected a length of at most 2.6, got 9\.0"),
        (SetVector(0, float("nan"), in_base=True), "p"),
        (Set(Meanings, "shown", "dance"), "dance"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


def test_it_is_written_down_and_read_back():
    part = opened(SetVector(0, 0.25), Set(Meanings, "shown", "operator"))[Meanings]
    assert Meanings.from_json(json.loads(json.dumps(part.to_json())), catalogue()["planar_2r"]) == part


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("angle", [0.9, -2.0])
def test_an_elementary_rotation_adds_its_angle_in_the_plane_across_its_axis(axis, angle):
    state = opened(Set(Meanings, "shown", "operator"), TurnElementary(axis), SetBodyTurn(angle))
    found = elementary_of(state)
    i, j = ("xyz".index(each) for each in found.plane)
    assert (found.axis, found.theta) == (axis, pytest.approx(angle))
    image = image_of(state)
    turned = found.alpha + found.theta
    assert image[i] == pytest.approx(found.radius * math.cos(turned), abs=1e-12)
    assert image[j] == pytest.approx(found.radius * math.sin(turned), abs=1e-12)
    assert image["xyz".index(axis)] == pytest.approx(found.along)
    assert found.along == state[Meanings].p["xyz".index(axis)]


def test_the_elementary_rotations_of_the_notes(truth):
    names = [name for name in truth if name.startswith("C3.1-R")]
    assert len(names) >= 2
    for name in names:
        case = truth[name]
        state = opened(TurnElementary(name[-1]), SetBodyTurn(case["inputs"]["theta"]))
        np.testing.assert_allclose(forms_of(state).R, case["expected"]["R"], rtol=0, atol=case["tol"])


def test_no_other_axis_is_elementary_and_a_body_that_is_not_turned_gets_an_angle():
    assert elementary_of(opened(SetWholeAxis((1.0, 1.0, 0.0)))) is None
    state = opened(SetBodyTurn(0.0), TurnElementary("y"))
    assert elementary_of(state).theta == pytest.approx(math.radians(50.0))
    facts = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    assert facts["axis"] == "y"
    p = state[Meanings].p
    assert facts["alpha"] == pytest.approx(math.atan2(p[0], p[2]))
    with pytest.raises(InputError, match="w"):
        TurnElementary("w").apply(state)


def test_the_line_of_the_notes_misses_by_what_the_errata_say(truth):
    """ERR-3.15b: alpha = 0.4, theta = 0.9 and a length of 2; here of 1, since the vector is no longer than that."""
    state = opened(TurnElementary("z"), SetBodyTurn(0.9), Set(Meanings, "p", (math.cos(0.4), math.sin(0.4), 0.0)))
    text = str(_of_the_notes(elementary_of(state)))
    residual = truth["ERR-3.15b"]["printed_value_if_wrong"]["printed_residual"] / 2.0
    assert f"it would miss by {residual:.4f}" in text
