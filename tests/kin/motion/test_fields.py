"""Options that depend on each other: which can be used, and in what unit."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.field import Field, seen_fields
from armlab.kin.motion.law_types import law_types
from armlab.kin.motion.path_types import path_type, path_types

KINDS = {**path_types(), **law_types()}


def seen(key, **given):
    return {field.key: field for field in seen_fields(KINDS[key].fields, given)}


@pytest.mark.parametrize(
    ("given", "usable"),
    [
        ({}, {"v_start", "v_end"}),
        ({"ends": "natural"}, {"a_start", "a_end"}),
        ({"ends": "both"}, {"v_start", "v_end", "a_start", "a_end", "virtual"}),
    ],
)
def test_of_a_spline_only_what_its_ends_take_can_be_used(given, usable, rng):
    every = {"v_start", "v_end", "a_start", "a_end", "virtual"}
    assert every & set(seen("spline", **given)) == usable
    knots = rng.normal(size=(4, 2))
    for name in every:
        value = [0.1, 0.9] if name == "virtual" else [0.3, -0.2]
        if name in usable:
            path_type("spline").path(knots, **given, **{name: value})
        else:
            with pytest.raises(InputError, match=f"{name}: cannot be used while"):
                path_type("spline").path(knots, **given, **{name: value})


def test_given_times_leave_nothing_to_share_out():
    assert {"duration", "spacing"} <= set(seen("blends"))
    assert not {"duration", "spacing"} & set(seen("blends", times=(0.0, 1.0)))
    assert not {"start", "end"} & set(seen("polynomial", degree=5))


@pytest.mark.parametrize(
    ("given", "symbol", "unit"),
    [({}, "d_1", "q"), ({"by": "d1"}, "d_1", "q"), ({"by": "d2"}, "d_2", "q"), ({"by": "time"}, "ΔT", "s")],
)
def test_what_a_blend_is_given_by_decides_its_symbol_and_unit(given, symbol, unit):
    amount = seen("overfly", **given)["amount"]
    assert (amount.symbol, amount.unit) == (symbol, unit)


@pytest.mark.parametrize("key", KINDS)
def test_conditions_name_options_and_choices_there_are(key):
    known = {field.key: field for field in KINDS[key].fields}
    for field in known.values():
        named = [(other, value) for other, values in field.only for value in values]
        named += [(other, value) for other, value, _, _ in field.by]
        for other, value in named:
            assert other in known, (key, field.key)
            assert value is None or value in dict(known[other].choices), (key, field.key)


@pytest.mark.parametrize(
    ("field", "value", "says"),
    [
        (
            Field("v", "", "", "number", low=0.0, above=True, unit="q/s"),
            -np.radians(1.0),
            "v: expected a positive number",
        ),
        (Field("v", "", "", "number", low=0.0, unit="q"), -np.radians(1.0), "v: expected no negative number"),
        (Field("v", "", "", "number", low=0.0, above=True, unit="s"), -1.0, "v: expected more than 0 s, got -1 s"),
        (
            Field("gap", "", "", "number", low=0.0, high=0.1, unit="m"),
            0.2,
            "gap: expected at least 0 m and at most 0.1 m, got 0.2 m",
        ),
        (
            Field("base", "", "", "vector", low=-50.0, unit="m"),
            (1.0, -60.0),
            "base: expected at least -50 m, got -60 m",
        ),
        (Field("v", "", "", "number", high=np.pi, unit="rad"), 4.0, "v: expected at most 180°"),
        (Field("v", "", "", "number"), np.array([0.5]), "v: expected one number, got [0.5]"),
        (Field("v", "", "", "number"), [1 / 3, 2.0], "v: expected one number, got [0.333333, 2]"),
        (Field("v", "", "", "flag", False), np.float64(1 / 3), "v: expected True or False, got 0.333333"),
    ],
)
def test_a_refusal_has_short_numbers_and_none_that_were_typed_in_another_unit(field, value, says):
    with pytest.raises(InputError) as refusal:
        field.checked(value)
    assert str(refusal.value) == says


def test_the_remark_of_a_jump_has_a_unit_or_no_number():
    path = path_type("overfly").path([[0, 0], [1, 0], [1, 2]], speed=[0.5, 1.0], by="d1", amount=[0.2])
    jump = np.linalg.norm(np.array([-0.5, 1.0]) / 0.8)
    assert not any(letter.isdigit() for letter in path.remarks[0])
    assert "units of the way" not in path.remarks[0]
    assert f"jumps by up to {round(jump * 1000.0, -1):.0f} mm/s² where" in path.remarks_in("mm", 1e-3)[0]
    assert path_type("line").path([0, 1]).remarks_in("m", 1.0) == ()
