"""Three turns about moving and about fixed axes: 24 films that end alike, their numbers, what is refused."""

import itertools
import json
import math

import numpy as np
import pytest

from armlab.benches.body.forms.commands import PlaceBody, SetBodyTurns, WriteBody
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.timing import DURATION, ENDS, REST, STEP, amounts, step_at
from armlab.benches.body.forms.ui.pair import turn_marks
from armlab.benches.body.sequence.clip import CLIP
from armlab.benches.body.sequence.examples import EXAMPLES, ChooseSequenceExample, example_of
from armlab.benches.body.sequence.facts import FACTS
from armlab.benches.body.sequence.film import apart, both, turns_of
from armlab.benches.body.sequence.state import CLIP_KEY, Sequence, ShowTurn, film_time
from armlab.benches.body.sequence.ui.numbers import ends_markup, products_markup
from armlab.benches.body.sequence.ui.scene import shown
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.units import units_of
from support.done import done
from support.sources import TOP

TRUTH = {entry["id"]: entry for entry in json.loads((TOP / "tests/data/truth.json").read_text(encoding="utf-8"))}

FILMS = list(itertools.product(SEQUENCES, (False, True)))
ANGLES = np.array([0.7, -1.1, 2.3])


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


@pytest.mark.parametrize(("axes", "fixed"), FILMS)
def test_all_24_films_end_in_the_same_frame(axes, fixed):
    state = opened(SetBodyTurns(axes, fixed, tuple(ANGLES)), OpenClip(CLIP_KEY), Seek(DURATION))
    moving, about_fixed = turns_of(state)
    assert (moving.fixed, about_fixed.fixed) == (False, True)
    np.testing.assert_allclose(moving.at(film_time(state)), about_fixed.at(film_time(state)), rtol=0, atol=1e-12)
    np.testing.assert_allclose(moving.at(film_time(state)), forms_of(state).R, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("axes", "fixed"), FILMS)
@pytest.mark.parametrize("order", ["reverse", "same"])
def test_every_turn_is_a_rotation_about_its_axis_where_that_is_by_then(axes, fixed, order):
    """The axis is that of the picture, so the film is not made of the product that it shows."""
    for turns in both(axes, fixed, ANGLES, order):
        for k in range(3):
            for part in (0.4, 1.0):
                time = ENDS[k] - STEP + part * STEP
                done = rotation_from_axis_angle(turns.axis(k), turns.angles_at(time)[k])
                np.testing.assert_allclose(turns.at(time), done @ turns.after(k), rtol=0, atol=1e-12)
                # The new turn on the right about moving axes, on the left about fixed ones.
                new, before = turns.turn(k, time), turns.after(k)
                np.testing.assert_allclose(
                    turns.at(time), new @ before if turns.fixed else before @ new, rtol=0, atol=1e-12
                )


def test_the_example_of_the_notes():
    case = TRUTH["C3.3-fixed-vs-moving"]
    moving, fixed = both(case["inputs"]["axes"].lower(), False, np.array(case["inputs"]["angles"]), "same")
    np.testing.assert_allclose(moving.after(3), case["expected"]["R_moving"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(fixed.after(3), case["expected"]["R_fixed"], rtol=0, atol=case["tol"])


def test_the_matrix_of_the_notes_for_roll_pitch_yaw():
    case = TRUTH["C3.3-rpy-xyz"]
    angles = tuple(case["inputs"][name] for name in ("psi", "theta", "phi"))
    for turns in turns_of(opened(SetBodyTurns("xyz", True, angles))):
        np.testing.assert_allclose(turns.after(3), case["expected"]["R"], rtol=0, atol=1e-12)


@pytest.mark.parametrize("key", [key for key in TRUTH if key.startswith("CA-")])
def test_the_products_of_the_appendix(key):
    inputs, case = TRUTH[key]["inputs"], TRUTH[key]["expected"]
    axes = inputs["seq"].lower()
    angles = [inputs[name] for name in ("alpha", "beta", "gamma") if name in inputs]
    # A product of two is that of three of which the last is not made yet.
    third = next(letter for letter in "xyz" if letter != axes[-1])
    moving, _ = both((axes + third)[:3], False, np.array([*angles, 0.0][:3]), "reverse")
    np.testing.assert_allclose(moving.after(len(angles)), case["R"], rtol=0, atol=1e-12)


def test_the_steps_follow_each_other_with_a_rest():
    assert step_at(0.0) == 0
    for k, end in enumerate(ENDS):
        done = amounts(end)
        assert step_at(end) == k
        np.testing.assert_array_equal(done, [1.0] * (k + 1) + [0.0] * (2 - k))
        np.testing.assert_array_equal(amounts(end + 0.5 * REST), done)
    assert CLIP.duration(opened()) == DURATION
    assert CLIP.stops(opened()) == ENDS[:2]


def test_a_turn_is_shown_by_its_number_while_the_film_is_open_or_not():
    assert film_time(opened()) == DURATION
    for made, time in enumerate((0.0, *ENDS)):
        for before in ([], [OpenClip(CLIP_KEY), Play(True)], [OpenClip("film")]):
            state = opened(*before, ShowTurn(made))
            assert film_time(state) == time
            assert not state[Timeline].playing
    with pytest.raises(InputError, match="turns: expected 0 to 3, got 4"):
        ShowTurn(4).apply(opened())


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_changed(key):
    state = opened(ChooseSequenceExample(key))
    assert example_of(state) == key
    np.testing.assert_allclose(np.degrees(state[Body].angles), EXAMPLES[key].degrees)
    other = "same" if EXAMPLES[key].order == "reverse" else "reverse"
    assert example_of(apply(state, Set(Sequence, "order", other))) == ""


def test_quarter_turns_in_the_same_order_end_elsewhere():
    state = opened(ChooseSequenceExample("quarters"))
    moving, fixed = turns_of(state)
    # By hand: x, y, z by quarters leave the moving body with x' up, and the other one with x' down.
    np.testing.assert_allclose(moving.after(3), [[0, 0, 1], [0, -1, 0], [1, 0, 0]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(fixed.after(3), [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], rtol=0, atol=1e-12)
    assert FACTS.facts["apart"].now(state).value == pytest.approx(math.pi)
    assert "The bodies end 180.0° apart" in str(ends_markup(state))


def test_the_page_says_how_the_products_are_made():
    state = opened(SetBodyTurns("zyx", False, (math.radians(40.0), math.radians(30.0), math.radians(20.0))))
    assert "The bodies end alike" in str(ends_markup(state))
    text = str(products_markup(apply(state, ShowTurn(2))))
    assert "post-multiplied" in text
    assert "pre-multiplied" in text
    assert "θ = 30.0° about y′" in text
    assert "φ = 40.0° about z<" in text
    assert "apart at present" in str(ends_markup(apply(state, ShowTurn(2))))
    assert "stand alike here" in str(ends_markup(apply(state, ShowTurn(0))))


def test_the_picture_has_the_axis_and_the_arc_of_the_present_turn():
    state = opened(PlaceBody("quarter"), WriteBody("zxz"), ShowTurn(1))
    for turns in turns_of(state):
        body = shown(turns, film_time(state), units_of(state))
        (start, end, colour), *_ = (marks := turn_marks(body, np.ones(3), 2.0)).arrows
        np.testing.assert_allclose((end - start) / np.linalg.norm(end - start), body.axis, atol=1e-12)
        assert colour == body.colour
        assert len(marks.strokes) == 36
    assert shown(turns_of(state)[0], ENDS[0], units_of(state)).about == "z: 90.0°"


def test_both_ways_have_a_difference_of_their_ends():
    facts, state = FACTS.facts, opened()
    assert facts["difference"].now(state).value < 1e-12
    assert apart(np.eye(3), np.diag([-1.0, -1.0, 1.0])) == pytest.approx(math.pi)
    np.testing.assert_allclose(facts["moving_3"].now(state).value, facts["fixed_3"].now(state).value, atol=1e-12)
    assert not np.allclose(facts["moving_2"].now(state).value, facts["fixed_2"].now(state).value)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetBodyTurns("xxy", False, (0.0, 0.0, 0.0)), "xxy"),
        (SetBodyTurns("xyz", False, (0.0, 0.0)), "angles: expected 3 numbers, got 2"),
        (SetBodyTurns("xyz", False, (0.0, float("inf"), 0.0)), "angles: expected finite numbers"),
        (Set(Sequence, "order", "random"), "random"),
        (ChooseSequenceExample("none"), "none"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
