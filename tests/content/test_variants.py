"""Variants: the same values for everyone with one number, free of rounding noise."""

import math
from collections import Counter

import pytest

from armlab.content.lesson_fields import Fields
from armlab.content.lesson_values import evaluated, filled, filled_data, written
from armlab.content.variants import Variants
from armlab.errors import ContentError, InputError

TEXT = """
l1 = { from = 0.4, to = 0.9, step = 0.1 }
l2 = { choose = [0.5, 1] }
arm = { choose = ["elbow up", "elbow down"] }
reach = "l1 + l2"
half = "= reach / 2"
"""


def variants(text=TEXT, seed="lesson"):
    return Variants.read(seed, Fields.parse("f.md", text))


def test_number_0_has_the_first_value_of_each():
    assert variants().draw(0) == {"l1": 0.4, "l2": 0.5, "arm": "elbow up", "reach": 0.9, "half": 0.45}


def test_a_grid_holds_decimal_numbers_without_noise():
    assert variants().choices["l1"] == (0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
    assert variants("a = { from = -1, to = 1, step = 0.3 }").choices["a"] == (-1.0, -0.7, -0.4, -0.1, 0.2, 0.5, 0.8)
    assert variants("a = { from = 2, to = 2, step = 1 }").choices["a"] == (2.0,)


def test_the_same_number_gives_the_same_values_and_others_differ():
    drawn = [variants().draw(number) for number in range(1, 200)]
    assert drawn == [variants().draw(number) for number in range(1, 200)]
    assert {values["l1"] for values in drawn} == set(variants().choices["l1"])
    counts = Counter(values["arm"] for values in drawn)
    assert min(counts.values()) > 60
    assert all(math.isclose(values["half"], (values["l1"] + values["l2"]) / 2) for values in drawn)


def test_a_further_name_changes_no_other():
    more = variants("first = { choose = [1, 2, 3] }" + TEXT + "last = { from = 1, to = 9, step = 1 }")
    for number in range(50):
        few, many = variants().draw(number), more.draw(number)
        assert few == {name: many[name] for name in few}


def test_lessons_draw_for_themselves():
    other = variants(seed="another")
    assert any(variants().draw(number) != other.draw(number) for number in range(1, 10))


@pytest.mark.parametrize(
    ("text", "values", "whole"),
    [
        ("a = { choose = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14] }", 14, True),
        ("a = { from = 1, to = 12, step = 1 }\nb = { choose = [1, 2, 1] }", 12, True),
        ("a = { from = 1, to = 99, step = 1 }", 2, True),
        (f"a = {{ choose = {list(range(90))} }}", 42, False),
        ("a = { choose = [1] }", 1, True),
    ],
)
def test_the_variants_to_try_have_all_values_that_matter_and_no_more_than_that_needs(text, values, whole):
    of = variants(text)
    numbers, enough = of.to_try(1, 40)
    seen = {of.draw(number)["a"] for number in numbers}
    assert enough is whole
    assert len(numbers) <= len(seen) + 2
    assert len(seen) >= values
    assert not whole or {of.choices["a"][0], of.choices["a"][-1]} <= seen


def test_what_varies():
    assert variants().varies
    assert not variants("a = { choose = [1] }\nb = 'a + 1'").varies
    assert not Variants.read("x", None).varies
    assert Variants.read("x", None).draw(3) == {}


@pytest.mark.parametrize("number", [-1, 1.5, "1", True, None])
def test_the_number_is_a_whole_one_from_0(number):
    with pytest.raises(InputError, match="variant"):
        variants().draw(number)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a = { from = 1, to = 2 }", "a.step: missing"),
        ("a = { from = 1, to = 2, step = 0 }", "a.step: expected a positive number"),
        ("a = { from = 2, to = 1, step = 1 }", "a.to: expected a number not below from, 2, got 1"),
        ("a = { from = 0, to = 1e9, step = 1e-9 }", "a.step: expected at most 10000 values"),
        ("a = { from = 0, to = 1, step = 1, by = 2 }", "a.by: unknown key"),
        ("a = { choose = [] }", "a.choose: expected 1 to 10000"),
        ("a = { choose = ['x', 1] }", r"a.choose\[2\]: expected a text like the first"),
        ("a = { choose = [1, 'x'] }", r"a.choose\[2\]: expected a number"),
        ("a = { choose = ['''x\ny'''] }", r"a.choose\[1\]: expected a text"),
        ("a = 3", "a: expected { from = 0.4"),
        ("a = 'b + 1'\nb = { choose = [1] }", "a: unknown name 'b'.* There is no name before it"),
        ("d0 = { choose = [1] }\na = 'cost(d0)'", r"a: unknown name 'cost'.*, tan\. Earlier names: d0\.$"),
        ("d0 = { choose = [1] }\na = '2 d0'\nb = 'ad0'", "b: unknown name 'ad0'"),
        ("t = { choose = ['x'] }\na = 't + 1'", "a: unknown name 't'"),
        ("a = '1 +'", "a: "),
        ("pi = { choose = [1] }", "pi: the name means something else"),
        ('"l-1" = { choose = [1] }', "l-1: expected a name of letters"),
        ("\n".join(f"a{i} = '1'" for i in range(51)), "a50: expected at most 50 names"),
    ],
)
def test_mistakes(text, says):
    with pytest.raises(ContentError, match=rf"f\.md: {says}"):
        variants(text)


def test_an_expression_without_a_value_is_named():
    with pytest.raises(InputError, match=r"variants\.b has no value: .*division by zero"):
        variants("a = { choose = [0] }\nb = '1 / a'").draw(0)


# --- Values in texts and tables

VALUES = {"l1": 0.5, "n": -2.0, "arm": "elbow up"}


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("no braces", "no braces"),
        ("{{=l1}} m", "0.5 m"),
        ("{{= l1*3 : .2f }}", "1.50"),
        ("{{=n}}", "−2"),
        ("{{=n : d}}", "−2"),
        ("{{=0*n:.1f}}", "0.0"),
        ("{{=arm}}, {{=l1}}", "elbow up, 0.5"),
        (r"$\frac{{{=l1}}}{2}$", r"$\frac{0.5}{2}$"),
        ("{{=0.1 + 0.2}}", "0.3"),
        ("{{=2 l1 n}}", "−2"),
        ("{{=2l1 cos(0)}}", "1"),
        ("{{=2pi : .1f}}", "6.3"),
        ("{{=1000000}}", "1000000"),
        ("{{=l1 : +.1f}}", "+0.5"),
        (r"{{-60}\text{°}}", r"{{-60}\text{°}}"),
        ("{{q1}}", "{{q1}}"),
    ],
)
def test_texts_are_filled(text, result):
    assert filled(text, VALUES) == result


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("{{=l3}}", "unknown name 'l3'"),
        ("{{=nl1}}", "unknown name 'nl1'"),
        ("{{=nn + 1}}", "unknown name 'nn'"),
        ("{{=l1cos(n)}}", "unknown name 'l1cos'"),
        ("{{=l1", "expected {{=expression}} in one line"),
        ("{{=l1}", "expected {{=expression}} in one line"),
        ("{{=}}", "expected a formula"),
        ("{{=l1 : 9q}}", "expected a form such as .2f"),
        ("{{=l1 : 99999999f}}", "expected a form such as .2f"),
        ("{{=arm : .2f}}", "'elbow up' is a text and takes no form"),
        ("{{=arm + 1}}", "arm is a text"),
        ("{{=1/0}}", "division by zero"),
    ],
)
def test_mistakes_in_texts(text, says):
    with pytest.raises(InputError, match=says):
        filled(text, VALUES)


def test_a_minus_sign_for_those_who_type():
    assert written(-0.5, ".1f", "-") == "-0.5"
    data = filled_data({"answer": "{{=n}} x", "says": "{{=n}} x"}, VALUES, "f.md", "")
    assert data == {"answer": "-2 x", "says": "−2 x"}


def test_tables_are_filled():
    given = {"a": "= l1 * 2", "b": ["= n", "as {{=arm}}"], "c": {"d": "=arm", "e": 1, "f": True}}
    result = filled_data(given, VALUES, "f.md", "")
    assert result == {"a": 1.0, "b": [-2.0, "as elbow up"], "c": {"d": "elbow up", "e": 1, "f": True}}


def test_the_place_in_a_table_is_named():
    with pytest.raises(ContentError, match=r"f\.md: step 1\.question\.wrong\[2\]\.answer: unknown name 'x'"):
        filled_data({"wrong": [{}, {"answer": "= x"}]}, VALUES, "f.md", "step 1.question")


def test_a_name_alone_keeps_what_it_is():
    assert evaluated(" arm ", VALUES) == "elbow up"
    assert evaluated("2 l1", VALUES) == 1.0
