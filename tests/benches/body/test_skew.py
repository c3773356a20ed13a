"""Skew matrices and dyads: parts of a matrix, S(v) u, sums of dyads, pictures, facts, fields, what is refused."""

import json

import numpy as np
import pytest

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.skew.facts import FACTS, matrix_of
from armlab.benches.body.skew.state import (
    SHOWN,
    SetSkewEntry,
    SetSkewMatrix,
    SetSkewVector,
    Skew,
    TakeBodyMatrix,
)
from armlab.benches.body.skew.ui.page import PLACES, _parts_of_x, _sum_verdict
from armlab.benches.body.skew.ui.scene import LONGEST, picture_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import skew
from armlab.session.fields import Set
from armlab.session.state import State, apply
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def value(state):
    return {key: fact.now(state).value for key, fact in FACTS.facts.items()}


def test_the_parts_of_a_matrix_by_hand():
    found = value(opened(SetSkewMatrix((1.0, 2.0, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 1.0)), Set(Skew, "x", (1.0, 1.0, 1.0))))
    np.testing.assert_array_equal(np.reshape(found["symmetric"], (3, 3)), [[1, 1, 0], [1, 1, 1], [0, 1, 1]])
    np.testing.assert_array_equal(np.reshape(found["skew"], (3, 3)), [[0, 1, 0], [-1, 0, 1], [0, -1, 0]])
    assert found["vector"] == (-1.0, 0.0, -1.0)
    assert found["form"] == found["form_of_symmetric"] == 7.0
    assert found["form_of_skew"] == 0.0


def test_the_cross_product_is_across_both():
    state = opened(SetSkewVector("v", 0, 1.0), SetSkewVector("v", 1, 0.0), SetSkewVector("v", 2, 0.0))
    state = apply(state, Set(Skew, "u", (0.0, 1.0, 0.0)))
    assert value(state)["cross"] == (0.0, 0.0, 1.0)
    part = opened()[Skew]
    np.testing.assert_allclose(value(opened())["cross"], np.cross(part.v, part.u), rtol=0, atol=1e-15)


def test_the_sum_of_dyads_is_that_of_the_columns():
    state = opened(TakeBodyMatrix())
    np.testing.assert_allclose(matrix_of(state), forms_of(state).R, rtol=0, atol=0)
    found = value(state)
    np.testing.assert_allclose(np.reshape(found["sum"], (3, 3)), np.eye(3), rtol=0, atol=1e-15)
    assert found["orthonormal"]
    assert found["swapped"] < 1e-14
    b = matrix_of(state)
    np.testing.assert_allclose(np.reshape(found["dyad"], (3, 3)), np.outer(b[:, 0], b[:, 1]), rtol=0, atol=1e-15)
    assert "The sum is I" in _sum_verdict(state)
    assert "They are not zero" in _sum_verdict(state)
    assert "They are not zero" not in _sum_verdict(apply(state, Set(Skew, "second", 1)))
    other = opened(SetSkewMatrix(PLACES["Upper"]))
    A = matrix_of(other)
    np.testing.assert_allclose(np.reshape(value(other)["sum"], (3, 3)), A @ A.T, rtol=0, atol=1e-15)
    assert value(other)["swapped"] == pytest.approx(np.abs(A.T @ A - A @ A.T).max())
    assert "The sum is not I" in _sum_verdict(other)


def test_unit_vectors_have_dyads_with_a_single_one():
    state = opened(SetSkewMatrix(PLACES["I"]), Set(Skew, "first", 1), Set(Skew, "second", 3))
    expected = np.zeros((3, 3))
    expected[0, 2] = 1.0
    np.testing.assert_array_equal(np.reshape(value(state)["dyad"], (3, 3)), expected)


def test_dyads_take_a_vector_apart():
    text = str(_parts_of_x(opened(SetSkewMatrix(PLACES["I"]), Set(Skew, "x", (1.0, 2.0, 3.0)))))
    assert "1.000\N{EN SPACE}2.000\N{EN SPACE}3.000" in text


@pytest.mark.parametrize("shown", SHOWN)
def test_the_arrows_show_what_is_computed(shown):
    state = opened(Set(Skew, "shown", shown))
    picture = picture_of(state)
    tips = {name: end for (_, end, _), (name, _) in zip(picture.arrows, picture.names, strict=True)}
    A, part = matrix_of(state), state[Skew]
    if shown == "split":
        np.testing.assert_allclose(tips["A x"], A @ np.array(part.x), rtol=0, atol=1e-15)
        step = tips["A x"] - tips["symmetric"]
        assert step @ np.array(part.x) == pytest.approx(0.0, abs=1e-14)
    elif shown == "cross":
        np.testing.assert_allclose(tips["S(v) u"], skew(part.v) @ np.array(part.u), rtol=0, atol=1e-15)
    else:
        np.testing.assert_allclose(picture.fine[-1][1], A @ A.T @ np.array(part.x), rtol=0, atol=1e-14)
    farthest = max(np.linalg.norm(end) for _, end, _ in picture.arrows)
    assert picture.scaled() * farthest == pytest.approx(LONGEST)


def test_arrows_without_a_length_are_left_out():
    state = opened(Set(Skew, "shown", "cross"), Set(Skew, "u", opened()[Skew].v))
    assert [name for name, _ in picture_of(state).names] == ["v", "u"]
    nothing = apply(apply(state, Set(Skew, "u", (0.0, 0.0, 0.0))), Set(Skew, "v", (0.0, 0.0, 0.0)))
    assert (picture_of(nothing).arrows, picture_of(nothing).scaled()) == ([], LONGEST)


def test_it_is_written_down_and_read_back():
    part = opened(SetSkewEntry(0, 1, 2.5), SetSkewVector("u", 2, -1.0), Set(Skew, "first", 3))[Skew]
    assert part.A[0][1] == 2.5
    assert Skew.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetSkewEntry(3, 0, 1.0), r"row \(counted from 0\): expected 0 to 2, got 3"),
        (SetSkewEntry(0, 0, 1e6), "matrix A: expected numbers from -1000 to 1000"),
        (SetSkewEntry(0, 0, float("nan")), "3 rows of 3 finite numbers"),
        (SetSkewMatrix((1.0, 2.0)), "A: expected 9 numbers, row by row, got 2"),
        (SetSkewVector("w", 0, 1.0), "w"),
        (SetSkewVector("v", 3, 1.0), r"v \(counted from 0\): expected 0 to 2, got 3"),
        (SetSkewVector("x", 0, 1e9), "x"),
        (Set(Skew, "first", 4), "first"),
        (Set(Skew, "shown", "all"), "all"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
