"""The page of identities: those of the appendix, wrong ones, sides, kinds, seeds, plots, facts, and bad input."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.help.identities.examples import EXAMPLES, RIGHT, WRONG, ChooseIdentity, example_of, groups
from armlab.benches.help.identities.facts import FACTS
from armlab.benches.help.identities.latex import latex_of
from armlab.benches.help.identities.state import (
    Identities,
    OtherPoints,
    SetIdentity,
    SetKind,
    SetSide,
    comparison_of,
    kinds_of,
)
from armlab.benches.help.identities.sweep import sweep_of
from armlab.benches.help.identities.ui.page import _equation
from armlab.benches.help.identities.ui.verdict import _agreed, _left_out, value_text, verdict_markup
from armlab.content.expressions import FUNCTIONS, MORE_FUNCTIONS, parse
from armlab.content.identity import read_formula
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.teaching.parts.lesson import check_line
from armlab.teaching.play import Player
from armlab.ui.html import joined
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def said(state):
    return str(joined(verdict_markup(state)))


def value(state):
    return {key: fact.now(state).value for key, fact in FACTS.facts.items()}


@pytest.mark.parametrize("key", EXAMPLES)
def test_each_identity_is_what_it_is_said_to_be_at_points_of_several_seeds(key):
    example = EXAMPLES[key]
    state = opened(ChooseIdentity(key))
    assert example_of(state) == key
    assert example_of(apply(state, SetSide("right", "17"))) == ""
    for seed in (1, 2, 5):
        assert comparison_of(apply(state, Set(Identities, "seed", seed))).agrees == example.holds


def test_all_identities_of_the_appendix_are_there():
    """The notes have 27 lines of them, several with more than one equation."""
    assert len(RIGHT) == 62
    assert {each.holds for each in RIGHT} == {True}
    assert all(each.says for each in WRONG)
    assert sum(map(len, groups().values())) == len(EXAMPLES)


def test_the_appendix_at_the_numbers_of_the_clearing():
    """CLR-A2: x = 0.7 and y = -1.3, with real numbers, by the parser of lessons."""
    names = {"x": 0.7, "y": -1.3, "k": 2.0}
    real = [each for each in RIGHT if not re.search(r"\bi\b|[zn]|e\^", f"{each.left} {each.right}".replace("sin", "s"))]
    assert len(real) >= 27
    for each in real:
        one, other = (
            parse(side, names, (*FUNCTIONS, *MORE_FUNCTIONS)).value(names) for side in (each.left, each.right)
        )
        assert one == pytest.approx(other, abs=1e-13), each.title


def test_a_wrong_argument_of_a_complex_number_is_half_a_turn_off(truth):
    state = opened(ChooseIdentity("argument"))
    found = comparison_of(state)
    assert found.difference.max() == pytest.approx(
        truth["ERR-A.arg"]["printed_value_if_wrong"]["printed_residual"], abs=1e-5
    )
    right = found.points[:, found.names.index("x")].real > 0.0
    np.testing.assert_array_equal(found.close, right)
    assert "They differ by up to 3.1416" in said(state)
    assert "They agree at 28 of 50 points" in said(state)


def test_the_verdict_says_what_was_found():
    assert "They agree at 50 points to 10⁻⁹" in said(opened())
    assert "One is the other with the opposite sign" in said(opened(SetIdentity("x", "-x")))
    assert "They agree at none of 50 points" in said(opened(SetIdentity("x", "x + 1")))
    assert "Nothing to compare" in said(opened(SetIdentity("1/0", "1")))
    assert "more points a part of them has no value" in said(opened(SetIdentity("1/n", "n/n^2")))
    few = said(opened(SetIdentity("asin(x)/re(n)^0 + 1/(n - n + im(e^(i k)))", "x")))
    assert "They differ" in few
    assert [value_text(each) for each in (1.5 + 0j, -1 - 2j, 2j, -2j, 3 + 1e-16j)] == [
        "1.5",
        "−1 − 2 i",
        "2 i",
        "−2 i",
        "3",
    ]


@pytest.mark.parametrize(
    ("left", "right", "sign"),
    [
        ("x + x", "2 x", "&#x0003D;"),
        ("x", "x + 1", "&#x02260;"),
        ("1/(10^5 - 10^5) + x", "1/(10^5 - 10^5) + x", "&#x0003F;"),
        ("exp(1000 x^2)", "exp(1000 x^2)", "&#x0003F;"),
    ],
)
def test_the_equation_says_equal_or_not_only_where_it_was_found(left, right, sign):
    signs = re.findall(r"<mo>(&#x(?:0003D|02260|0003F);)</mo>", str(_equation(opened(SetIdentity(left, right)))))
    assert signs[-1] == sign


def test_one_point_is_said_to_be_one():
    found = comparison_of(opened(SetIdentity("x", "x")))
    one = replace(found, left=found.left[:1], drawn=2)
    assert "At 1 more point a part of them" in _left_out(one)
    few = comparison_of(opened(SetIdentity("exp(1000 x^2)", "exp(1000 x^2)")))
    assert _agreed(1) == "They agree at the only point that there is"
    assert _agreed(len(few.left)) in said(opened(SetIdentity("exp(1000 x^2)", "exp(1000 x^2)")))


def test_sides_are_typed_one_by_one_and_kinds_follow_the_variables():
    state = opened(SetSide("left", "z + n"), SetSide("right", "n + z"))
    assert kinds_of(state) == {"n": "whole", "z": "complex"}
    state = apply(state, SetKind("n", "positive"))
    assert state[Identities].kinds == (("n", "positive"),)
    assert kinds_of(state) == {"n": "positive", "z": "complex"}
    assert apply(state, SetKind("n", "whole"))[Identities].kinds == ()
    assert apply(state, SetIdentity("x", "x"))[Identities].kinds == ()
    before = comparison_of(state).points
    assert np.abs(comparison_of(apply(state, OtherPoints())).points - before).max() > 0.01
    assert apply(apply(state, Set(Identities, "seed", 9999)), OtherPoints())[Identities].seed == 1


def test_both_sides_are_drawn_over_the_first_variable_that_is_a_line():
    found = sweep_of(opened(SetIdentity("sin(x) + n", "cos(x)")))
    assert (found.name, found.complex) == ("x", False)
    n = comparison_of(opened(SetIdentity("sin(x) + n", "cos(x)")))
    place = n.points[n.worst]
    np.testing.assert_allclose(found.left.real, np.sin(found.x) + place[0].real, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.right.real, np.cos(found.x), rtol=0, atol=1e-12)
    assert found.at == pytest.approx(place[1].real)
    assert sweep_of(opened(SetIdentity("e^(i x)", "1"))).complex
    poles = sweep_of(opened(SetIdentity("tan(x)", "1")))
    assert np.nanmax(np.abs(poles.left.real)) <= 20.0
    assert np.isnan(poles.left.real).any()
    assert sweep_of(opened(SetIdentity("z", "conj(z)"))) is None
    assert sweep_of(opened(SetIdentity("1", "1"))) is None


def test_facts_tell_an_identity_from_the_same_text_on_both_sides():
    assert value(opened(SetIdentity("sin(2x)", "2 sin(x) cos(x)")))["holds"]
    same = value(opened(SetIdentity("sin(2x)", "sin( 2x )")))
    assert (same["agrees"], same["holds"]) == (True, False)
    wrong = value(opened(ChooseIdentity("linear")))
    assert (wrong["agrees"], wrong["holds"], wrong["points"]) == (False, False, 50)
    assert wrong["largest"] > 0.5
    assert wrong["left"] == "sin(x + y)"
    assert value(opened(SetIdentity("1/0", "1")))["largest"] is None


@pytest.mark.parametrize(
    ("text", "expanded", "functions"),
    [
        ("sin(x) cos(y) + cos(x) sin(y)", True, "cos cos sin sin"),
        ("r (cos(-a) cos(t) - sin(a) sin(t))", True, "cos cos sin sin"),
        ("sin(x + y) + 0", False, "sin"),
        ("sin(x (1 + y/x))", False, "sin"),
        ("im(e^(i (x + y)))", False, "im"),
        ("2 cos(x/2)^2 - 1", True, "cos"),
        ("(x + 1)^2", False, ""),
    ],
)
def test_facts_tell_an_expanded_side_and_its_functions(text, expanded, functions):
    found = value(opened(SetIdentity("abs(sin(x/2))", text)))
    assert (found["expanded"], found["left_functions"], found["right_functions"]) == (expanded, "abs sin", functions)


@pytest.mark.parametrize(
    ("key", "number", "side", "dodges", "ways"),
    [
        (
            "same_formula",
            1,
            "right",
            ("sin(y + x)", "sin(x + y) + 0"),
            ("sin(y) cos(x) + sin(x) cos(y)", "sin(x)*cos(y) - cos(x)*sin(-y)"),
        ),
        ("same_formula", 2, "left", ("sqrt(0.5 - cos(x)/2)",), ("abs(sin(-x/2))", "abs(-sin(x/2))")),
        (
            "zxz_angles",
            6,
            "right",
            ("cos(psi) cos(phi) + sin(phi) sin(psi)",),
            ("cos(phi - psi)", "cos(psi - phi)"),
        ),
        ("same_formula", 3, "right", ("cos(x)^3 - 3 cos(x) sin(x)^2", "re(e^(3 i x))"), ("cos(3x)", "cos(x + 2x)")),
        (
            "turn_a_vector",
            2,
            "right",
            ("r cos(theta + alpha)", "r cos(alpha + theta) + 0"),
            ("r (cos(alpha) cos(theta) - sin(alpha) sin(theta))",),
        ),
    ],
)
def test_a_side_that_is_only_typed_in_another_way_does_not_do_a_task(key, number, side, dodges, ways):
    player = Player(lesson(key), planning=False)
    player.go_to(number - 1)

    def met(text):
        assert player.do(SetSide(side, text)) == ""
        state = player.session.state
        assert value(state)["holds"]
        return check_line(state)[0]

    assert [text for text in dodges if met(text)] == []
    assert [text for text in ways if not met(text)] == []


def test_it_is_written_down_and_read_back():
    part = opened(SetIdentity("a", "b"), SetKind("a", "complex"), OtherPoints())[Identities]
    assert Identities.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetSide("left", "sin x"), "left side: expected a bracket after sin"),
        (SetSide("right", "9**9**9"), "right side: a power of"),
        (SetSide("right", "(" * 500), "right side: .*nested too deep|right side: .*breaks off"),
        (SetSide("left", "x" * 10**6), "left side: expected a formula of at most 600 characters, got 1000000"),
        (SetSide("right", "a+b+c+d+f+g"), "right side: expected at most 6 variables"),
        (SetSide("middle", "x"), "middle"),
        (SetKind("q", "real"), "q"),
        (SetKind("x", "imaginary"), "imaginary"),
        (Set(Identities, "seed", 0), "seed"),
        (Set(Identities, "left", 5), "left: not usable"),
        (Set(Identities, "kinds", "ab"), "kinds: not usable"),
    ],
)
def test_what_cannot_be_is_refused_in_words_and_the_old_sides_stay(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("2 sin(x)^2/(1 - y)", r"\frac{2\,\sin^{2}(x)}{1-y}"),
        ("sin(x^2)", r"\sin({x}^{2})"),
        ("(cos(x)^2)^3", r"{(\cos^{2}(x))}^{3}"),
        ("sin(x)^-1", r"{(\sin(x))}^{-1}"),
        ("atan2(y, x)^2", r"{(\mathrm{atan2}(y,x))}^{2}"),
        ("sqrt(x)^2", r"{\sqrt{x}}^{2}"),
        ("-x^2", "-{x}^{2}"),
        ("(a - b) - (c - d)", "a-b-(c-d)"),
        ("a (-b)", r"a\,(-b)"),
        ("(a + b) c", r"(a+b)\,c"),
        ("(x^2)^3", "{({x}^{2})}^{3}"),
        ("e^(i θ)", r"{e}^{i\,\theta}"),
        ("e^ix", r"{e}^{i}\,x"),
        ("2*3", r"2\cdot 3"),
        ("2*3^x", r"2\cdot {3}^{x}"),
        ("2*(1/2)", r"2\cdot \frac{1}{2}"),
        ("x*(1/2)", r"x\,\frac{1}{2}"),
        ("sqrt(x_1)", r"\sqrt{x_{1}}"),
        ("abs(z) conj(z)", r"\left|z\right|\,\overline{z}"),
        ("atan2(y, x)", r"\mathrm{atan2}(y,x)"),
        ("tan(x/2)", r"\tan\left(\frac{x}{2}\right)"),
        ("sin(30°) + (x)°", r"\sin(30°)+(x)°"),
        ("π + 1e-9", r"\pi+1\cdot 10^{-9}"),
    ],
)
def test_a_formula_is_printed_as_it_was_read(text, latex):
    assert latex_of(read_formula(text)) == latex
