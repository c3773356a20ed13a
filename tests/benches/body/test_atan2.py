"""The page of atan2: both functions in every quadrant and on every axis, the picture, drags, facts, and bad input."""

import json
import math

import numpy as np
import pytest

from armlab.benches.body.atan2.angle import CASES, POINTS, angle_of, present
from armlab.benches.body.atan2.facts import FACTS
from armlab.benches.body.atan2.state import MOST, DragPoint, Plane, SetCoordinate
from armlab.benches.body.atan2.ui.page import verdict
from armlab.benches.body.atan2.ui.picture import SIZE, arc, at, picture, place_of
from armlab.benches.body.atan2.ui.scene import arcs_of, arrow_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.ui.form import Marks
from armlab.ui.units import units_of
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def said(x, y):
    return str(verdict(angle_of(x, y), units_of(opened())))


def test_the_angles_of_the_notes(truth):
    case = truth["C3.1-atan2"]
    for (y, x), expected in zip(case["inputs"]["yx"], case["expected"]["theta"], strict=True):
        assert angle_of(x, y).atan2 == pytest.approx(expected, abs=case["tol"])


def test_the_present_case_of_the_definition_gives_the_angle(rng):
    """Each case of 3.15, worked out by hand."""
    for x, y in [*rng.normal(size=(200, 2)), *POINTS]:
        found = angle_of(float(x), float(y))
        quotient = math.atan(y / x) if x else math.nan
        values = (quotient, quotient + math.pi, quotient - math.pi, math.pi / 2, -math.pi / 2)
        assert values[found.case] == pytest.approx(found.atan2, abs=1e-15)
        assert "<" in CASES[found.case][1] or ">" in CASES[found.case][1] or "=" in CASES[found.case][1]
        np.testing.assert_allclose(
            math.hypot(x, y) * np.array([math.cos(found.atan2), math.sin(found.atan2)]), [x, y], rtol=0, atol=1e-15
        )


@pytest.mark.parametrize(
    ("x", "y", "quadrant", "apart"),
    [(1, 1, 1, 0), (-1, 1, 2, -180), (-1, -1, 3, 180), (1, -1, 4, 0), (-1, 0, 0, -180), (2, 0, 0, 0)],
)
def test_atan_is_half_a_turn_off_left_of_the_y_axis(x, y, quadrant, apart):
    found = angle_of(float(x), float(y))
    assert found.quadrant == quadrant
    assert math.degrees(found.apart) == pytest.approx(apart, abs=1e-12)
    assert found.right == (x > 0)


def test_where_there_is_no_quotient_and_no_angle():
    for y in (1.0, -1.0):
        found = angle_of(0.0, y)
        assert (found.atan, found.apart, found.right) == (None, None, False)
        assert found.atan2 == pytest.approx(y * math.pi / 2)
    assert angle_of(0.0, 0.0).atan2 is None
    assert CASES[angle_of(-0.0, -0.0).case][1] == "x = 0, y = 0"
    # Minus zero is zero: no half turn the other way round.
    assert angle_of(-1.0, -0.0).atan2 == math.pi
    assert "The origin has no angle" in said(0.0, 0.0)
    assert "does not exist" in said(0.0, 1.0)
    assert "atan2 = 135.0°, but atan = −45.0°" in said(-1.0, 1.0)
    assert "Both are 45.0°" in said(1.0, 1.0)


def test_a_drag_brings_the_point_to_the_nearest_round_place_inside_the_picture():
    state = opened(DragPoint(0.51, -0.26, 3))
    assert state[Plane].point == (0.5, -0.25)
    assert apply(state, DragPoint(7.0, 0.01, 3))[Plane].point == (MOST, 0.0)
    assert DragPoint(0, 0, 3).stroke == DragPoint(1, 1, 3).stroke != DragPoint(1, 1, 4).stroke
    assert DragPoint(0, 0).stroke is None
    for x, y in ((0.0, 0.0), (1.2, -0.7), (-2.0, 2.0)):
        across, down = (each / SIZE for each in at(x, y))
        np.testing.assert_allclose(place_of(across, down), (x, y), rtol=0, atol=1e-12)


def test_the_picture_has_both_arcs_and_the_other_direction():
    text = str(picture(angle_of(-1.0, 1.0), "here", Marks()))
    assert text.count("at-atan2-name") == text.count('"at-atan-name"') == text.count("at-other") == 1
    assert "at-other" not in str(picture(angle_of(1.0, 1.0), "here", Marks()))
    # Of a quarter the arc ends above the middle, counter-clockwise, which is sweep 0.
    assert str(arc("a", 1.0, math.pi / 2)).endswith(
        f'0 0 0 {SIZE / 2:.1f} {SIZE / 2 - at(1.0, 0.0)[0] + SIZE / 2:.1f}"></path>'
    )
    origin = str(picture(angle_of(0.0, 0.0), "here", Marks()))
    assert "at-atan2" not in origin


def test_the_scene_draws_what_is_defined():
    assert len(arrow_of(angle_of(1.0, 1.0), False).arrows) == 1
    assert arrow_of(angle_of(0.0, 0.0), False).arrows == []
    count = [len(arcs_of(angle_of(x, y)).strokes) for x, y in ((1.0, 1.0), (-1.0, 1.0), (0.0, 1.0), (0.0, 0.0))]
    assert count == [74, 75, 38, 2]
    # The arc of atan2 ends on the way to the point.
    _, end, _ = arcs_of(angle_of(-1.0, 1.0)).strokes[35]
    np.testing.assert_allclose(end / np.linalg.norm(end), [-math.sqrt(0.5), math.sqrt(0.5), 0.0], rtol=0, atol=1e-12)


def test_facts_and_what_is_written_down():
    state = opened(SetCoordinate(0, -1.0), SetCoordinate(1, -1.0))
    value = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    assert value["quadrant"] == present(state).quadrant == 3
    assert math.degrees(value["atan2"]) == pytest.approx(-135.0)
    assert math.degrees(value["atan"]) == pytest.approx(45.0)
    assert (value["right"], value["point"]) == (False, (-1.0, -1.0))
    part = state[Plane]
    assert Plane.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetCoordinate(2, 0.0), r"point \(counted from 0\): expected 0 to 1, got 2"),
        (SetCoordinate(0, 2.5), "point"),
        (SetCoordinate(0, float("nan")), "point: expected finite numbers"),
        (Set(Plane, "point", [1.0]), "point: expected 2 numbers, got 1"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
