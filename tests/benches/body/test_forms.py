"""The body without a page: each form in which it is typed, SciPy as judge; singularities, drags, bad input."""

import json
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.benches.body.forms.commands import (
    PLACES,
    FlipQuaternion,
    PlaceBody,
    SetBodyAngle,
    SetBodyAxis,
    SetBodyEntry,
    SetBodyMatrix,
    SetBodyQuaternion,
    SetBodyTurn,
    TakeOtherAngles,
    TurnBody,
    UnitQuaternion,
    WriteBody,
)
from armlab.benches.body.forms.facts import FACTS
from armlab.benches.body.forms.rotation import forms_of, triples_of
from armlab.benches.body.forms.state import Body
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.kin.quaternions import exponential
from armlab.kin.rotations import rotation_from_quaternion, rotation_from_sequence
from armlab.kin.velocity.rates import rate_matrix
from armlab.session.fields import Set
from armlab.session.state import State, apply
from support.done import done

BOTH = [(axes, fixed) for axes in SEQUENCES for fixed in (False, True)]


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def shown(*commands):
    return forms_of(opened(*commands))


def degrees(*angles):
    return [SetBodyAngle(k, math.radians(angle)) for k, angle in enumerate(angles)]


def judge(axes, fixed, angles):
    return Rotation.from_euler(axes.lower() if fixed else axes.upper(), angles, degrees=True).as_matrix()


def test_it_begins_with_what_stands_in_its_fields():
    found = shown()
    np.testing.assert_allclose(found.R, judge("zyx", False, [40, 30, 20]), rtol=0, atol=1e-14)
    np.testing.assert_allclose(np.degrees(found.triples.shown), [40, 30, 20], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_typed_angles_are_those_of_scipy_and_stay_as_typed(axes, fixed):
    for angles in ((20, 50, -30), (-170, 100, 179), (400, -20, 10), (0, 0, 0), (35, 90, 25), (35, 180, 25)):
        found = shown(WriteBody(axes, fixed), *degrees(*angles))
        np.testing.assert_allclose(found.R, judge(axes, fixed, angles), rtol=0, atol=1e-14)
        np.testing.assert_allclose(np.degrees(found.triples.shown), angles, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_the_other_triple_gives_the_same_rotation(axes, fixed):
    before = shown(WriteBody(axes, fixed), *degrees(20, 50, -30))
    after = shown(WriteBody(axes, fixed), *degrees(20, 50, -30), TakeOtherAngles())
    np.testing.assert_allclose(after.triples.shown, before.triples.other, rtol=0, atol=1e-12)
    np.testing.assert_allclose(after.R, before.R, rtol=0, atol=1e-14)
    again = rotation_from_sequence(axes, after.triples.shown, fixed=fixed)
    np.testing.assert_allclose(again, before.R, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_at_a_singularity_the_sum_or_the_difference_stays(axes, fixed):
    """Whichever is said to be defined: the first and third angle may be changed together and nothing moves."""
    proper = axes[0] == axes[2]
    for middle in (0.0, 180.0) if proper else (90.0, -90.0):
        found = shown(WriteBody(axes, fixed), *degrees(35, middle, 25))
        triples = found.triples
        assert triples.singular
        assert abs(triples.determinant) < 1e-12
        expected = math.radians(35 + triples.combination * 25)
        assert math.remainder(triples.defined - expected, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
        moved = (35 - triples.combination * 40, middle, 25 + 40)
        np.testing.assert_allclose(judge(axes, fixed, moved), found.R, rtol=0, atol=1e-12)
        # Turning on about the lost axis is made by no rates: it is across all three axes of the turns.
        step = 1e-6
        for k in range(3):
            angles = np.radians([35, middle, 25]) + step * np.eye(3)[k]
            omega = Rotation.from_matrix(rotation_from_sequence(axes, angles, fixed=fixed) @ found.R.T).as_rotvec()
            assert abs(omega @ triples.lost) < 1e-4 * step
        with pytest.raises(InputError, match="infinitely many"):
            TakeOtherAngles().apply(opened(WriteBody(axes, fixed), *degrees(35, middle, 25)))


def test_another_sequence_writes_the_same_orientation():
    before = shown()
    for axes, fixed in BOTH:
        found = shown(WriteBody(axes, fixed))
        np.testing.assert_array_equal(found.R, before.R)
        again = rotation_from_sequence(axes, found.triples.shown, fixed=fixed)
        np.testing.assert_allclose(again, before.R, rtol=0, atol=1e-14)


def test_axis_and_angle_are_those_of_scipy():
    typed = [SetBodyAxis(0, 1.0), SetBodyAxis(1, -2.0), SetBodyAxis(2, 2.0)]
    for angle in (0.0, 1e-9, 1e-4, 1.0, math.pi - 1e-9, math.pi, 4.0, -1.0, -4.0):
        found = shown(*typed, SetBodyTurn(angle))
        expected = Rotation.from_rotvec(angle * np.array([1, -2, 2]) / 3).as_matrix()
        np.testing.assert_allclose(found.R, expected, rtol=0, atol=1e-15)
        assert found.angle == pytest.approx(angle, rel=1e-12, abs=1e-9)
        np.testing.assert_allclose(found.axis, np.array([1, -2, 2]) / 3, rtol=0, atol=1e-9)
    state = opened(*typed, SetBodyTurn(0.0), SetBodyTurn(0.5))
    np.testing.assert_allclose(state[Body].axis, [1, -2, 2])  # kept through no rotation, in its length


def test_a_quaternion_of_any_length_is_kept_as_typed():
    state = opened(*(SetBodyQuaternion(k, value) for k, value in enumerate((1.0, 2.0, -3.0, 4.0))))
    assert state[Body].q == (1.0, 2.0, -3.0, 4.0)
    found = forms_of(state)
    np.testing.assert_allclose(found.R, Rotation.from_quat([2, -3, 4, 1]).as_matrix(), rtol=0, atol=1e-15)
    assert found.length == pytest.approx(math.sqrt(30))
    flipped = forms_of(apply(state, FlipQuaternion()))
    np.testing.assert_allclose(flipped.R, found.R, rtol=0, atol=1e-15)
    np.testing.assert_allclose(flipped.q, -found.q, rtol=0, atol=0)
    assert math.hypot(*apply(state, UnitQuaternion())[Body].q) == pytest.approx(1.0)


def test_a_typed_matrix_is_kept_and_the_body_takes_the_nearest_rotation(rng):
    for _ in range(20):
        matrix = rng.normal(size=(3, 3))
        found = shown(SetBodyMatrix(tuple(matrix.ravel().tolist())))
        U, _, V_T = np.linalg.svd(matrix)
        expected = U @ np.diag([1, 1, np.linalg.det(U @ V_T)]) @ V_T
        np.testing.assert_allclose(found.R, expected, rtol=0, atol=1e-12)
        assert found.nearest.distance == pytest.approx(np.linalg.norm(matrix - expected))
    state = opened(PlaceBody("none"), SetBodyEntry(0, 1, 0.2))
    np.testing.assert_array_equal(state[Body].matrix, [[1, 0.2, 0], [0, 1, 0], [0, 0, 1]])
    # The next entry is of the matrix as typed, not of the rotation.
    state = apply(state, SetBodyEntry(1, 0, -0.2))
    np.testing.assert_array_equal(state[Body].matrix, [[1, 0.2, 0], [-0.2, 1, 0], [0, 0, 1]])
    np.testing.assert_allclose(np.degrees(forms_of(state).angle), np.degrees(math.atan(0.2)))
    for command in (SetBodyAngle(0, 0.3), SetBodyTurn(0.1), FlipQuaternion(), PlaceBody("half")):
        after = apply(state, command)
        assert after[Body].matrix is None
        assert forms_of(after).nearest is None


def test_a_drag_is_followed_through_whole_turns():
    """The quaternion comes back with its sign changed after one turn, and the angles do not jump."""
    state = opened(PlaceBody("none"))
    drag = object()
    for angle in np.radians(np.arange(5.0, 361.0, 5.0)):
        q = exponential([0, 0, 0, 0.5 * angle])
        state = apply(state, TurnBody(q if q[0] > 0 else -q, drag))
        np.testing.assert_allclose(forms_of(state).R, rotation_from_quaternion(q), rtol=0, atol=1e-14)
        assert forms_of(state).triples.shown[0] == pytest.approx(angle, abs=1e-12)
    np.testing.assert_allclose(state[Body].q, [-1, 0, 0, 0], rtol=0, atol=1e-12)
    assert TurnBody(q, drag).stroke == TurnBody(-q, drag).stroke


@pytest.mark.parametrize("key", PLACES)
def test_the_places_are_what_they_say(key):
    _, axes, fixed, angles = PLACES[key]
    found = shown(PlaceBody(key))
    np.testing.assert_allclose(found.R, judge(axes, fixed, angles), rtol=0, atol=1e-14)
    assert found.triples.singular == (key in ("lock", "zxz"))


def test_what_lessons_see():
    facts = {name: fact.now(opened(PlaceBody("lock"))).value for name, fact in FACTS.facts.items()}
    assert facts["singular"] is True
    assert facts["defined"] == pytest.approx(math.radians(20.0))
    assert facts["distance"] is None
    assert FACTS.facts["distance"].now(opened(PlaceBody("none"), SetBodyEntry(2, 2, 2.0))).value == pytest.approx(1.0)


def test_it_is_written_down_and_read_back():
    robot = catalogue()["planar_2r"]
    for commands in ((), (SetBodyEntry(0, 0, 0.3), WriteBody("xyx", True)), (Set(Body, "rings", False),)):
        part = opened(*commands)[Body]
        assert Body.from_json(json.loads(json.dumps(part.to_json())), robot) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetBodyAngle(3, 0.0), r"angle \(counted from 0\): expected 0 to 2, got 3"),
        (SetBodyAngle(0, 1e4), "angles"),
        (SetBodyAxis(2, float("nan")), "finite"),
        (SetBodyTurn(7.0), "θ: expected −360° to 360°"),
        (SetBodyTurn(float("nan")), "θ: expected"),
        (SetBodyMatrix((1.0,) * 8), "expected 9 numbers, row by row, got 8"),
        (SetBodyMatrix((0.0,) * 9), "single nearest rotation"),
        (SetBodyMatrix((-1.0, 0, 0, 0, -1.0, 0, 0, 0, -1.0)), "single nearest rotation"),
        (SetBodyMatrix((1e9,) * 9), "matrix: expected numbers up to"),
        (SetBodyEntry(0, 3, 1.0), r"column \(counted from 0\): expected 0 to 2, got 3"),
        (WriteBody("zzx"), "zzx"),
        (PlaceBody("nowhere"), "nowhere"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


def test_zero_is_no_rotation_and_no_axis():
    state = opened(PlaceBody("none"))
    with pytest.raises(InputError, match="q: expected a quaternion that is not zero"):
        SetBodyQuaternion(0, 0.0).apply(state)
    with pytest.raises(InputError, match="r: expected an axis that is not zero"):
        SetBodyAxis(2, 0.0).apply(state)


@pytest.mark.parametrize(
    ("name", "value"),
    [("axes", "zzz"), ("q", [0, 0, 0, 0]), ("axis", [1, 2]), ("matrix", [[1, 2], [3, 4]]), ("matrix", 3)],
)
def test_damaged_files_are_refused(name, value):
    with pytest.raises(InputError):
        Body.from_json({**Body().to_json(), name: value}, catalogue()["planar_2r"])


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_the_inverse_condition_is_that_of_the_matrix_of_the_rates(axes, fixed, rng):
    for angles in rng.uniform(-3.0, 3.0, (10, 3)):
        R = rotation_from_sequence(axes, angles, fixed=fixed)
        triples = triples_of(R, axes, fixed, angles)
        expected = 1.0 / np.linalg.cond(rate_matrix(triples.shown, axes, fixed))
        assert triples.inverse_condition == pytest.approx(expected, rel=1e-6)
