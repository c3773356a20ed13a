"""A point in three kinds of coordinates: each typed, the singular places, and what is refused."""

import math

import numpy as np
import pytest

from armlab.benches.frames.coordinates.examples import EXAMPLES, ChoosePointExample
from armlab.benches.frames.coordinates.facts import FACTS
from armlab.benches.frames.coordinates.state import (
    Coordinates,
    DragPoint,
    PlacePoint,
    SetCartesian,
    SetCylindrical,
    SetSpherical,
    where_of,
)
from armlab.benches.frames.coordinates.ui.quadrants import quadrants
from armlab.benches.frames.coordinates.ui.scene import drawn
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from support.done import done
from support.filled import Filled

INK = (0, 0, 0)


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def where(*commands):
    return opened(*commands).derived(where_of)


def test_the_point_of_the_notes(truth):
    case = truth["C3.1-cyl"]
    found = where(PlacePoint(tuple(case["inputs"]["xyz"])))
    for ours, key in ((found.r, "r"), (found.theta, "theta"), (found.h, "h")):
        assert ours == pytest.approx(case["expected"][key], abs=case["tol"])
    # atan finds the opposite direction.
    assert found.by_atan == pytest.approx(found.theta + math.pi)


def test_what_is_typed_in_one_kind_is_kept_by_the_others(rng):
    for x, y, z in rng.normal(size=(10, 3)):
        state = opened(PlacePoint((x, y, z)))
        found = state.derived(where_of)
        wider = apply(state, SetCylindrical("r", 2.0 * found.r)).derived(where_of)
        np.testing.assert_allclose(wider.p, [2 * x, 2 * y, z], rtol=0, atol=1e-12)
        turned = apply(state, SetCylindrical("theta", found.theta + 0.3)).derived(where_of)
        assert (turned.r, turned.h) == (pytest.approx(found.r), pytest.approx(found.h))
        farther = apply(state, SetSpherical("r", 3.0 * found.R)).derived(where_of)
        np.testing.assert_allclose(farther.p, [3 * x, 3 * y, 3 * z], rtol=0, atol=1e-12)
        tipped = apply(state, SetSpherical("phi", 1.0)).derived(where_of)
        assert tipped.phi == pytest.approx(1.0)
        assert (tipped.R, tipped.theta) == (pytest.approx(found.R), pytest.approx(found.theta))


@pytest.mark.parametrize("degrees", [90.0, -90.0, 270.0, 3510.0])
@pytest.mark.parametrize("command", [SetCylindrical, SetSpherical])
def test_a_quarter_turn_that_is_typed_leaves_no_x(command, degrees):
    state = opened(command("theta", math.radians(degrees)))
    found = state.derived(where_of)
    assert found.p[0] == 0.0
    assert found.by_atan is FACTS.facts["by_atan"].now(state).value is None
    assert found.theta == pytest.approx(math.remainder(math.radians(degrees), 2.0 * math.pi), abs=1e-12)
    assert apply(state, SetCylindrical("r", 3.0)).derived(where_of).by_atan is None


def test_where_x_is_zero_the_page_says_that_atan_would_divide_by_it():
    page = Filled("coordinates")
    for text in ("90", "-90", "270"):
        page.fill("cylindrical theta", text)
        assert "– (x = 0)" in page.text
        assert "atan would divide by zero" in page.text


def test_quarter_turns_typed_in_radians_are_those_of_the_fields():
    page = Filled("coordinates")
    page.do(Set(Notation, "angle", "rad"))
    page.fill("cylindrical theta", "1.5708")
    assert "– (x = 0)" in page.text
    page.fill("cylindrical theta", "3.1416")
    assert page.value("cylindrical theta") == "3.1416", "and not −3.1416, beyond the jump"
    page.fill("spherical phi", "1.5708")
    assert page.state.derived(where_of).h == 0.0


def test_at_the_singular_places_the_last_angles_are_kept():
    state = opened(PlacePoint((1.0, 1.0, 0.5)), SetCylindrical("r", 0.0))
    found = state.derived(where_of)
    assert found.on_axis
    assert not found.at_origin
    assert found.theta == pytest.approx(math.pi / 4)
    assert FACTS.facts["theta"].now(state).value is None
    back = apply(state, SetCylindrical("r", 2.0)).derived(where_of)
    np.testing.assert_allclose(back.p, [math.sqrt(2), math.sqrt(2), 0.5], rtol=0, atol=1e-12)
    # Another angle, typed on the axis, tells where the point goes from there.
    elsewhere = apply(apply(state, SetCylindrical("theta", math.pi)), SetCylindrical("r", 1.0)).derived(where_of)
    np.testing.assert_allclose(elsewhere.p, [-1.0, 0.0, 0.5], rtol=0, atol=1e-12)
    origin = apply(state, SetSpherical("r", 0.0))
    assert origin.derived(where_of).at_origin
    assert FACTS.facts["phi"].now(origin).value is None
    again = apply(origin, SetSpherical("phi", math.pi / 2))
    again = apply(again, SetSpherical("r", 1.0)).derived(where_of)
    np.testing.assert_allclose(again.p, [math.sqrt(0.5), math.sqrt(0.5), 0.0], rtol=0, atol=1e-12)


def test_a_turn_of_more_than_a_whole_one_is_the_same_point():
    found = where(SetCylindrical("theta", math.radians(370.0)))
    assert math.degrees(found.theta) == pytest.approx(10.0)


def test_a_dragged_point_is_where_the_hand_is():
    np.testing.assert_array_equal(opened(DragPoint(np.array([0.1, 0.2, 0.3]), 1))[Coordinates].p, (0.1, 0.2, 0.3))


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_the_point_moves(key):
    state = opened(SetCartesian(0, 3.0), ChoosePointExample(key))
    assert state[Coordinates].example == key
    assert apply(state, Set(Coordinates, "shown", "spherical"))[Coordinates].example == key
    assert apply(state, SetCartesian(1, 0.77))[Coordinates].example == ""


def ends(segments):
    return [(start.tolist(), end.tolist()) for start, end, _ in segments]


def test_lengths_are_drawn_from_the_origin_to_the_point():
    found = where(PlacePoint((3.0, 4.0, 2.0)))
    lines, _, names = drawn("cylindrical", found, 0.5, INK)
    assert ([0.0, 0.0, 0.0], [3.0, 4.0, 0.0]) in [(s, np.round(e, 12).tolist()) for s, e in ends(lines)]
    assert all(name is not None for name in names)
    lines, _, _ = drawn("spherical", found, 0.5, INK)
    assert ([0.0, 0.0, 0.0], [3.0, 4.0, 2.0]) in ends(lines)


def test_what_is_not_defined_is_not_drawn():
    on_axis = drawn("cylindrical", where(PlacePoint((0.0, 0.0, 1.0))), 0.5, INK)
    assert len(on_axis[0]) == 1
    assert on_axis[2][:2] == (None, None)
    at_origin = drawn("spherical", where(PlacePoint((0.0, 0.0, 0.0))), 0.5, INK)
    assert at_origin == ([], [], (None, None, None))


def test_the_quadrants_show_the_direction_of_atan_only_where_it_is_wrong():
    assert "fr-wrong" in str(quadrants(-1.0, -2.0, -2.03, 1.1, "label"))
    assert "fr-wrong" not in str(quadrants(1.0, 2.0, 1.1, 1.1, "label"))
    assert 'aria-label="label"' in str(quadrants(0.0, 2.0, math.pi / 2, None, "label"))


def test_facts_are_those_of_the_point():
    value = {key: fact.now(opened(PlacePoint((0.0, -3.0, 4.0)))).value for key, fact in FACTS.facts.items()}
    assert value["point"] == (0.0, -3.0, 4.0)
    assert (value["from_axis"], value["h"], value["from_origin"]) == (3.0, 4.0, 5.0)
    assert value["theta"] == pytest.approx(-math.pi / 2)
    assert value["phi"] == pytest.approx(math.atan2(3, 4))
    assert value["by_atan"] is None


def test_half_a_turn_can_be_typed_as_its_field_shows_it_and_what_is_more_is_told_in_its_unit():
    page = Filled("coordinates")
    page.do(Set(Notation, "angle", "rad"))
    page.fill("spherical phi", "3.1416")
    assert page.state[Coordinates].p[2] == pytest.approx(-math.sqrt(5.25))
    assert "φ: " not in page.text
    page.fill("spherical phi", "3.142")
    assert "φ: expected a number in rad from 0 to 3.1416, got '3.142'; beyond a pole it is θ that differs" in page.text


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetCartesian(3, 1.0), "axis: expected 0 to 2 for x, y and z, got 3"),
        (SetCartesian(0, 1e9), "p"),
        (SetCylindrical("r", -1.0), "r: expected a distance, 0 or more"),
        (SetCylindrical("phi", 1.0), "coordinate: unknown name 'phi'"),
        (SetSpherical("r", -1.0), "r: expected a distance"),
        (SetSpherical("phi", -0.1), "φ: expected 0° to 180°"),
        (SetSpherical("phi", 3.2), "φ: expected 0° to 180°"),
        (SetSpherical("h", 1.0), "coordinate: unknown name 'h'"),
        (PlacePoint((1.0, 2.0)), "p"),
        (PlacePoint((1.0, math.nan, 0.0)), "p"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
