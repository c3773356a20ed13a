"""Products in symbols: the matrix of formulas, typed entries and misprinted ones, copies, facts, bad input."""

import json
import math
import re

import numpy as np
import pytest

from armlab.benches.body.forms.commands import SetBodyTurns
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.products.copies import copies
from armlab.benches.body.products.entry import compared, written_out
from armlab.benches.body.products.examples import EXAMPLES, ChooseProductExample, example_of
from armlab.benches.body.products.facts import FACTS, matrix_of
from armlab.benches.body.products.state import (
    ChooseProduct,
    Products,
    SelectEntry,
    SetProductAngle,
    TakeBodyAngles,
    TypeEntry,
)
from armlab.benches.body.products.ui.page import _verdict
from armlab.benches.body.products.ui.scene import axes_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotation_products import PRODUCTS, product_entries
from armlab.kin.rotations import rotation_from_sequence
from armlab.session.fields import Set
from armlab.session.state import State, apply
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def value(state):
    return {key: fact.now(state).value for key, fact in FACTS.facts.items()}


MISPRINTED = {"zxz_21": "ERR-3.82", "rpy_12": "ERR-3.103a", "rpy_23": "ERR-3.103b"}


@pytest.mark.parametrize("key", MISPRINTED)
def test_a_misprinted_entry_is_off_by_what_the_errata_say_and_the_right_one_is_not(key, truth):
    printed = EXAMPLES[key].part
    # The angles of the errata in the order of the product: phi, theta, psi, and for ZYX the reverse of psi, theta, phi.
    angles = (0.3, 0.8, -0.5) if key == "zxz_21" else (-0.5, 0.8, 0.3)
    names = dict(zip(("α", "β", "γ"), angles, strict=True))
    state = opened(ChooseProductExample(key), Set(Products, "angles", angles))
    entry = matrix_of(state)[printed.row - 1, printed.column - 1]
    text = printed.typed
    for name, angle in names.items():
        text = text.replace(name, repr(angle))
    wrong = eval(text.replace(") sin", ")*sin").replace(") cos", ")*cos"), {"sin": math.sin, "cos": math.cos})
    residual = truth[MISPRINTED[key]]["printed_value_if_wrong"]["printed_residual"]
    assert abs(wrong - entry) == pytest.approx(residual, rel=1e-3)
    found = value(state)
    assert not found["typed_right"]
    assert found["typed_off"] > 0.3
    right = value(apply(state, TypeEntry(found["formula"])))
    assert right["typed_right"]
    assert right["typed_off"] < 1e-12


@pytest.mark.parametrize("axes", PRODUCTS)
def test_every_entry_agrees_with_itself_in_short_forms_and_not_with_another_one(axes):
    entries = product_entries(axes, "text")
    for i in range(3):
        for j in range(3):
            text = entries[i][j]
            for name, letter in (("alpha", "a"), ("beta", "b"), ("gamma", "g")):
                text = text.replace(f"cos({name})", f"c{letter}").replace(f"sin({name})", f"s{letter}")
            assert compared(axes, i + 1, j + 1, text).agrees
            other = entries[(i + 1) % 3][j]
            if other != entries[i][j]:
                assert not compared(axes, i + 1, j + 1, other).agrees


def test_short_forms_are_written_out():
    assert written_out("sa cg + c_alpha*sβ - cgamma^2") == "sin(alpha) cos(gamma) + cos(alpha)*sin(beta) - cos(gamma)^2"
    assert written_out("cos(α) sab") == "cos(α) sab"


def test_the_verdict_says_where_a_formula_is_off():
    state = opened(Set(Products, "axes", "zx"), SelectEntry(1, 2))
    assert "Type one" in str(_verdict(state))
    assert "It agrees" in str(_verdict(apply(state, TypeEntry("-sa cb"))))
    assert "It is off by up to" in str(_verdict(apply(state, TypeEntry("sa cb"))))
    constant = opened(Set(Products, "axes", "zx"), SelectEntry(3, 1), TypeEntry("1"))
    assert ">It is 1, and the entry is 0.<" in str(_verdict(constant))
    imaginary = str(_verdict(opened(Set(Products, "axes", "zxz"), SelectEntry(3, 3), TypeEntry("cos(beta) - 2 i"))))
    assert re.search(r"it is (−?[\d.]+) − 2 i, and the entry is \1\.", imaginary)
    assert "no value at any point" in str(_verdict(apply(state, TypeEntry("1/0"))))
    assert "It agrees" not in str(_verdict(apply(apply(state, TypeEntry("-sa cb")), SelectEntry(2, 2))))


@pytest.mark.parametrize("axes", ["zxz", "xy"])
def test_the_copies_work(axes):
    angles = (0.3, -0.7, 1.1)[: len(axes)]
    expected = rotation_from_sequence(axes, angles)
    names = {}
    exec(copies(axes)["Python"], names)
    np.testing.assert_allclose(names[f"rotation_{axes}"](*angles), expected, rtol=0, atol=1e-15)
    lines = copies(axes)["text"].splitlines()
    assert len(lines) == 9
    assert lines[0].startswith("r11 = ")
    assert copies(axes)["LaTeX"].count("&") == 6
    assert r"\begin{bmatrix}" in copies(axes)["LaTeX"]


@pytest.mark.parametrize("fixed", [False, True])
def test_the_angles_of_the_body_make_its_matrix(fixed):
    state = opened(SetBodyTurns("xyz", fixed, (0.4, -0.6, 1.2)), TakeBodyAngles())
    assert state[Products].axes == ("zyx" if fixed else "xyz")
    np.testing.assert_allclose(matrix_of(state), forms_of(state).R, rtol=0, atol=1e-12)


def test_the_axes_of_the_turns_are_carried_along():
    part = opened(Set(Products, "axes", "zyx"), Set(Products, "angles", (0.5, 0.9, -0.3)))[Products]
    one, two, three = axes_of(part)
    np.testing.assert_array_equal(one, [0, 0, 1])
    np.testing.assert_allclose(two, [-math.sin(0.5), math.cos(0.5), 0], rtol=0, atol=1e-15)
    # The last axis is that column of R.
    np.testing.assert_allclose(three, rotation_from_sequence("zyx", part.angles)[:, 0], rtol=0, atol=1e-15)
    assert len(axes_of(opened(Set(Products, "axes", "xz"))[Products])) == 2


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_an_angle_is_changed(key):
    state = opened(ChooseProductExample(key))
    assert example_of(state) == key
    assert example_of(apply(state, SetProductAngle(0, 0.123))) == ""


def test_it_is_written_down_and_read_back():
    part = opened(TypeEntry("cos(β)"), SetProductAngle(1, 2.0))[Products]
    assert Products.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (TypeEntry("cos(x)"), "formula: expected alpha, beta, gamma and no other variables, got x"),
        (TypeEntry("cos α"), "formula: expected a bracket after cos"),
        (TypeEntry("9^9^9"), "formula: a power of"),
        (TypeEntry("x" * 10**6), "typed"),
        (TypeEntry("(" * 100), "nested too deep|breaks off"),
        (SelectEntry(4, 1), "row"),
        (SetProductAngle(3, 0.0), r"angle \(counted from 0\): expected 0 to 2, got 3"),
        (SetProductAngle(0, 1e9), "angles"),
        (Set(Products, "axes", "zz"), "zz"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


def test_another_product_takes_away_a_formula_that_was_typed():
    state = opened(TypeEntry("cos(γ)"))
    assert apply(state, ChooseProduct("zxz"))[Products].typed == "cos(γ)"
    assert apply(state, ChooseProduct("zx"))[Products].typed == ""
    assert apply(opened(TypeEntry("cos(γ)")), TakeBodyAngles())[Products].typed == ""
