"""The fields of the page of the body, filled without a browser, what they say, and what is drawn."""

import math

import numpy as np
import pytest

from armlab.benches.body.forms.commands import (
    PlaceBody,
    SetBodyAngle,
    SetBodyEntry,
    SetBodyMatrix,
    SetBodyQuaternion,
    SetBodyTurn,
    SetWholeAxis,
    SetWholeQuaternion,
    WriteBody,
)
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.stage import stage_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.count import count_markup
from armlab.benches.body.forms.ui.numbers import angles_markup, axis_markup, matrix_markup, quaternion_markup
from armlab.benches.body.forms.ui.scene import lost_marks, ring_names
from armlab.benches.body.forms.ui.words import turn_names
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.session import Asked
from armlab.session.state import State, apply
from armlab.ui.scene._block import DOTS, block_glb
from armlab.ui.units import typed_numbers, units_of
from support.done import done
from support.forms import BareForm


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def filled(markup, cell, text, *commands):
    """Return the state after a field of a markup was filled."""
    state, form = opened(*commands), BareForm()
    form.show(markup(form, state))
    form.press(cell, text)
    (asked,) = form.posted
    for command in asked.commands if isinstance(asked, Asked) else (asked,):
        state = apply(state, command)
    return state


@pytest.mark.parametrize(
    ("markup", "cell", "text", "command"),
    [
        (angles_markup, "angle 1", "π/2", SetBodyAngle(1, math.pi / 2)),
        (angles_markup, "angle 0", "-30", SetBodyAngle(0, math.radians(-30.0))),
        (angles_markup, "axes", "zxz", WriteBody("zxz")),
        (angles_markup, "about fixed", "", WriteBody(fixed=True)),
        (axis_markup, "turn", "120", SetBodyTurn(math.radians(120.0))),
        (axis_markup, "axis 1", "1, 2, 2", SetWholeAxis((1.0, 2.0, 2.0))),
        (quaternion_markup, "q 0", "sqrt(2)/2", SetBodyQuaternion(0, math.sqrt(2) / 2)),
        (quaternion_markup, "q 2", "[1 2 3 4]", SetWholeQuaternion((1.0, 2.0, 3.0, 4.0))),
        (matrix_markup, "R 01", "-0.5", SetBodyEntry(0, 1, -0.5)),
        (matrix_markup, "R 00", "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]", SetBodyMatrix((0.0, -1, 0, 1, 0, 0, 0, 0, 1))),
        (matrix_markup, "R 22", "0 -1 0; 1 0 0; 0 0 1", SetBodyMatrix((0.0, -1, 0, 1, 0, 0, 0, 0, 1))),
    ],
)
def test_a_filled_field_is_a_command(markup, cell, text, command):
    assert filled(markup, cell, text)[Body] == apply(opened(), command)[Body]


@pytest.mark.parametrize(
    ("markup", "cell", "text", "told"),
    [
        (angles_markup, "angle 0", "abc", "φ: expected a number in degrees, got 'abc'"),
        (axis_markup, "axis 0", "1e9", r"r x: expected at most 1e\+06 either way, got 1e\+09$"),
        (axis_markup, "axis 0", "1 2", "r x: expected a number, or all 3 of an axis, got '1 2'"),
        (quaternion_markup, "q 3", "", "q z: expected a number, or all 4 of a quaternion"),
        (matrix_markup, "R 12", "1 2 3 4", "R row 2, column 3: expected a number, or all 9 of the matrix"),
    ],
)
def test_what_is_no_number_is_refused_at_the_field(markup, cell, text, told):
    with pytest.raises(InputError, match=told):
        filled(markup, cell, text)


def test_single_numbers_may_be_formulas_with_spaces():
    assert typed_numbers("1 / 2", "x", 4, "four") == [0.5]
    assert typed_numbers("1 / 2", "x", 3, "three") == [0.5]


def said(markup, *commands):
    return str(markup(BareForm(), opened(*commands)))


def test_a_singularity_tells_what_is_determined():
    """A difference at +90 degrees, a sum at -90 (zyx), a sum at 0 and a difference at 180 (zxz)."""
    for axes, middle, what in (("zyx", 90, "φ − ψ"), ("zyx", -90, "φ + ψ"), ("zxz", 0, "φ + ψ"), ("zxz", 180, "φ − ψ")):
        angles = [SetBodyAngle(k, math.radians(angle)) for k, angle in enumerate((40, middle, 15))]
        text = said(angles_markup, WriteBody(axes), *angles)
        value = 25.0 if "−" in what else 55.0
        assert f"Gimbal lock: only {what} = {value}° is determined" in text
        assert 'data-cell="other"' not in text
    assert "Nearly gimbal lock" in said(angles_markup, SetBodyAngle(1, math.radians(88.0)))
    assert "lock" not in said(angles_markup)


def test_the_other_forms_say_what_is_left_open():
    assert "r may be any axis" in said(axis_markup, PlaceBody("none"))
    assert "Half a turn" in said(axis_markup, PlaceBody("half"))
    assert "270.0° about −r" in said(axis_markup, PlaceBody("quarter"))
    assert "|q| = 2.0000" in said(quaternion_markup, SetWholeQuaternion((1.0, 1.0, 1.0, 1.0)))
    assert "Not a rotation: the nearest one is 1.0000 away" in said(
        matrix_markup, PlaceBody("none"), SetBodyEntry(2, 2, 2.0)
    )
    for third, told in ((0.866, "A rotation with rounded entries: the exact one is"), (0.8665, "Not a rotation")):
        assert told in said(matrix_markup, SetBodyMatrix((0.866, -0.5, 0, 0.5, third, 0, 0, 0, 1)))
    assert "The typed matrix M is a rotation." in said(matrix_markup, SetBodyMatrix((0.0, -1, 0, 1, 0, 0, 0, 0, 1)))


@pytest.mark.parametrize(("unit", "largest", "beyond"), [("rad", "6.2832", "6.284"), ("deg", "360", "360.1")])
def test_a_whole_turn_can_be_typed_as_its_field_shows_it_and_is_named_in_its_unit(unit, largest, beyond):
    in_unit = Set(Notation, "angle", unit)
    for text in (largest, f"-{largest}"):
        assert filled(axis_markup, "turn", text, in_unit).derived(forms_of).angle == 2.0 * math.pi
    with pytest.raises(InputError, match=f" to {largest}, got '{beyond}': two whole turns are all there is"):
        filled(axis_markup, "turn", beyond, in_unit)


def test_the_turns_are_named_by_their_axes():
    assert turn_names("zxz", False) == ("z", "x′", "z″")
    state = opened()
    names = ring_names(state[Body], forms_of(state).triples.shown, units_of(state))
    assert names == ["1: φ = 40.0° about z", "2: θ = 30.0° about y′", "3: ψ = 20.0° about x″"]


def test_the_lost_axis_is_drawn_at_a_singularity_only():
    assert lost_marks(forms_of(opened()), np.zeros(3), 1.0, False).arrows == []
    found = forms_of(opened(PlaceBody("lock")))
    (_, tip, _), _ = lost_marks(found, np.zeros(3), 1.0, False).arrows
    # Across z, the first axis and here the third one too, and across the second.
    np.testing.assert_allclose(tip[2], 0.0, atol=1e-12)


def test_the_faces_are_those_of_a_die():
    assert [len(places) for places in DOTS.values()] == list(DOTS)
    assert block_glb()[:4] == b"glTF"


def test_it_stands_above_the_ground_whatever_the_arm(robot):
    centre, radius = stage_of(State.initial(robot))
    assert centre[2] - radius > robot.arm.base[2, 3]


def test_it_is_told_how_many_numbers_each_form_has():
    text = str(count_markup(opened()))
    assert "Six conditions" in text
    assert "manifold of three dimensions" in text
    assert text.count("<td>3</td>") == 5  # free in all four forms, and the numbers of three angles
