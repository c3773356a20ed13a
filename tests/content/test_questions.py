"""Answers as students type them: numbers, choices, and what all questions share."""

import math
from html import escape

import pytest

from armlab.content.quantities import UNITS, read_quantity
from armlab.content.question import Choices, Field, Verdict, question_types, read_question
from armlab.content.questions._matrix_text import read_matrix
from armlab.content.questions.number import NumberQuestion, WrongNumber
from armlab.content.reader import Table
from armlab.errors import ContentError, InputError
from armlab.ui.asking import UNIT_SIGNS

LENGTH = NumberQuestion("", 0.5, "m", 0.001, (WrongNumber(0.7, "Told."),))
ANGLE = NumberQuestion("", math.pi / 2, "rad", 0.01)
DEGREES = NumberQuestion("", 90.0, "deg", 0.1)
ROOT = NumberQuestion("", math.sqrt(3), "", 0.01)
SMALL = NumberQuestion("", 0.02, "m", 0.01)
SHARE = NumberQuestion("", 5.0, "%", 0.1)
TIME = NumberQuestion("", 5.0, "s", 0.1)


def ask(text, kind="number"):
    table = Table.parse("f.md", f'kind = "{kind}"\ntext = "How much?"\n{text}')
    table.where = "step 1.question"
    return read_question(table, lambda markdown, where: f"<p>{escape(markdown)}</p>")


@pytest.mark.parametrize(
    "text", ["0.5", "0,5", ".5", "50 cm", "500 mm", "500mm", "1/2 m", "0.5010", "5e-1", "5·10⁻¹ m"]
)
def test_right_lengths(text):
    assert LENGTH.judge(text) == Verdict(True, "Right.")


@pytest.mark.parametrize("text", ["pi/2", "π/2", "90 deg", "90°", "1.57", "1.57 rad", "90 degrees", "pi/2 rad"])
def test_right_angles(text):
    assert ANGLE.judge(text).right
    assert DEGREES.judge(text).right is (text not in ("pi/2", "π/2", "1.57"))


BY_TERMS = (
    *("180° - 30°", "180 deg - 30 deg", "180 degrees−30 degrees", "300°/2", "2*(90° - 15°)", "-(-150°)", "abs(-150°)"),
    *("pi - 30°", "90° + pi/3", "90° + pi/3 rad", "4 acos(0.5) - 90°", "5π/3/2 rad"),
    *("deg(pi) - 30°", "180 - 30°", "2*75°", "(180 - 30)°", "1/2*300°", "300/2 deg", "300°/2 deg"),
)


@pytest.mark.parametrize("text", BY_TERMS)
def test_a_unit_of_angles_belongs_to_its_term_where_others_have_their_own(text):
    degrees = NumberQuestion("", 150.0, "deg", 0.1)
    assert degrees.judge(text).right
    assert NumberQuestion("", 5.0 * math.pi / 6.0, "rad", 0.01).judge(text).right is (text != "300°/2 deg")
    assert not NumberQuestion("", -150.0, "deg", 0.1).judge(text).right


@pytest.mark.parametrize(
    ("text", "asked", "expected"),
    [
        ("180°/30°", "", (6.0, None)),
        ("cos(60°)", "deg", (0.5, None)),
        ("90°/2", "deg/s", (math.pi / 4.0, "rad/s")),
        ("0.5*(2 rad)", "deg", (1.0, "rad")),
        ("180° * 0.3", "m", (0.3 * math.pi, None)),
        ("asin(0.5)°", "deg", (math.pi / 6.0, "deg")),
        ("atan2(1, 1)", "deg", (math.pi / 4.0, None)),
    ],
)
def test_what_has_no_unit_at_its_end_is_read_as_what_is_asked(text, asked, expected):
    number, unit = read_quantity(text, asked)
    assert (pytest.approx(number), unit) == expected


OPEN = ("180° - 55", "180 deg - 30 - 25", "2*(180° - 55)", "90° + 0.5", "1 rad - 55", "max(180, 90°)", "180 - 30° + pi")


@pytest.mark.parametrize("text", OPEN)
def test_a_number_without_a_unit_beside_an_angle_with_one_is_no_answer(text):
    says = f"In '{text}' one angle has a unit and another has none: write it at each, as in 180° - 30°."
    for unit in ("deg", "rad"):
        assert NumberQuestion("", 125.0, unit, 0.1).judge(text) == Verdict(False, says, "unreadable")
        with pytest.raises(InputError, match=r"Row 1, column 2: In .* one angle has a unit"):
            read_matrix(f"0, {text.replace('max(180, 90°)', '180° - 55')}", (1, 2), unit)


def test_a_number_beside_an_angle_within_a_cosine_is_no_answer():
    assert "another has none" in ROOT.judge("cos(180° - 55)").says
    with pytest.raises(InputError, match=r"Row 1, column 1: In .* another has none"):
        read_matrix("cos(180° - 55)", (1, 1))


@pytest.mark.parametrize(
    ("text", "asked", "expected"),
    [
        ("90° - 1 rad", "deg", (math.pi / 2.0 - 1.0, "rad")),
        ("90° - pi/4 + 0", "deg", (math.pi / 4.0, "rad")),
        ("180°/30° - 2", "", (4.0, None)),
        ("0.3*180° + 0.2", "m", (0.3 * math.pi + 0.2, None)),
        ("rad(180) - 0.5", "rad", (math.pi - 0.5, None)),
    ],
)
def test_units_that_are_not_open_are_read(text, asked, expected):
    number, unit = read_quantity(text, asked)
    assert (pytest.approx(number), unit) == expected


@pytest.mark.parametrize("text", ["5", "5 %", "5%", "5,05 %", "10/2 %", "5 percent", "5％"])
def test_right_shares(text):
    assert SHARE.judge(text).right


@pytest.mark.parametrize(
    ("question", "text", "says", "name"),
    [
        (LENGTH, "-0.5", "The size is right, the sign is not.", "sign"),
        (LENGTH, "500", "The number is right in mm; write its unit, or give it in m.", "unit"),
        (LENGTH, "50", "The number is right in cm; write its unit, or give it in m.", "unit"),
        (LENGTH, "0.7", "Told.", "wrong[1]"),
        (LENGTH, "70 cm", "Told.", "wrong[1]"),
        (LENGTH, "0.52", "This is not the answer yet.", ""),
        (LENGTH, "500 m", "This is not the answer yet.", ""),
        (LENGTH, "1", "This is twice what is asked", "factor 2"),
        (LENGTH, "25 cm", "This is half of what is asked", "factor 2"),
        (LENGTH, "0.5 rad", "This is an angle; the question asks for a length in m.", "quantity"),
        (ANGLE, "90", "The number is right in deg; write its unit, or give it in rad.", "degrees"),
        (ANGLE, "90 rad", "The number is right in deg, but you wrote rad.", "degrees"),
        (DEGREES, "1.5708", "The number is right in rad; write its unit, or give it in deg.", "degrees"),
        (DEGREES, "1.5708 deg", "The number is right in rad, but you wrote deg.", "degrees"),
        (DEGREES, "-270", "The direction is right, but it is a whole turn away.", "turn"),
        (DEGREES, f"{360 * 10**6 + 90}", "This is not the answer yet.", ""),
        (DEGREES, "45", "This is half of what is asked", "factor 2"),
        (ROOT, "2*cos(30)", "sin, cos and tan take radians here", "degrees"),
        (SMALL, "0.035", "This is not the answer yet.", ""),
        (SHARE, "0.05", "As a fraction this is right. In percent it is a hundred times as much.", "unit"),
        (SHARE, "0.05 %", "This is not the answer yet.", ""),
        (SHARE, "5 m", "This is a length; the question asks for a share in %.", "quantity"),
        (ROOT, "173 %", "This is a share; the question asks for a pure number.", "quantity"),
        (LENGTH, "half", "I cannot read 'half': write a number such as 0.5, 1/2 or 50 cm.", "unreadable"),
        (DEGREES, "half", "I cannot read 'half': write a number such as 0.5, pi/2 or 90 deg.", "unreadable"),
        (ROOT, "half", "I cannot read 'half': write a number such as 0.5, 1/2 or sqrt(2).", "unreadable"),
        (TIME, "half", "I cannot read 'half': write a number such as 0.5, 1/2 or 0.5 s.", "unreadable"),
        (LENGTH, "<b>1</b>", "I cannot read '&lt;b&gt;1&lt;/b&gt;': write a number", "unreadable"),
        (LENGTH, "0.5 rad^2", "The unit rad^2 is not known; there are m, cm, mm,", "unreadable"),
        (LENGTH, "", "I cannot read ''", "unreadable"),
        (LENGTH, "1,234.5", "I cannot read '1,234.5'", "unreadable"),
        (LENGTH, "__import__('os')", "I cannot read", "unreadable"),
        (LENGTH, "1/0", "'1/0': division by zero", "unreadable"),
    ],
)
def test_wrong_answers_are_named(question, text, says, name):
    verdict = question.judge(text)
    assert not verdict.right
    assert verdict.says.startswith(says)
    assert verdict.name == name


@pytest.mark.parametrize("text", ["2cos(30°)", "2cos(rad(30))", "sqrt(3)", "√3", "tan(pi/3)", "max(1, sqrt(3))"])
def test_small_formulas_are_answers(text):
    assert ROOT.judge(text).right


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("2 m/s", 2.0, "m/s"),
        ("3 deg / s", 3.0, "deg/s"),
        ("4 m²", 4.0, "m^2"),
        ("4 cm^2", 4.0, "cm^2"),
        ("4 m2", 4.0, "m^2"),
        ("5 ms", 5.0, "ms"),
        ("−6", -6.0, None),
        ("10¹²", 1e12, None),
        ("10² m", 100.0, "m"),
        ("10² m²", 100.0, "m^2"),
        ("2·10⁻³", 0.002, None),
        ("2×10⁻³ mm", 0.002, "mm"),
        ("3 rad·s⁻¹", 3.0, "rad/s"),
        ("3 m s^-1", 3.0, "m/s"),
        ("7 N m", 7.0, "Nm"),
        ("7 N·m", 7.0, "Nm"),
        ("70 mN m", 70.0, "mNm"),
        ("3000 rpm", 3000.0, "rpm"),
        ("0,5 kW", 0.5, "kW"),
        ("12*2 W", 24.0, "W"),
        ("−1.5A", -1.5, "A"),
        ("24 V", 24.0, "V"),
        ("-0.5 rad/s^2", -0.5, "rad/s^2"),
        ("7.39 rad/s²", 7.39, "rad/s^2"),
        ("90 °/s²", 90.0, "deg/s^2"),
        ("3 m/s/s", 3.0, "m/s^2"),
        ("3 m s⁻²", 3.0, "m/s^2"),
        ("0.5 1/s", 0.5, "1/s"),
        ("pi/2 1/s²", math.pi / 2.0, "1/s^2"),
        ("0.5/s", 0.5, "1/s"),
        ("1/s", 1.0, "1/s"),
        ("0,4 s⁻¹", 0.4, "1/s"),
        ("0.59 m⁻²", 0.59, "1/m^2"),
        ("1/2 m/rad", 0.5, "m/rad"),
        ("-1.2 m²/s", -1.2, "m^2/s"),
        ("10 N s/m", 10.0, "Ns/m"),
        ("7 N", 7.0, "N"),
        ("0,5 %", 0.5, "%"),
        ("atan2(1,1)*4/pi rad", 1.0, "rad"),
    ],
)
def test_quantities(text, value, unit):
    got, found = read_quantity(text)
    assert (got, found) == (pytest.approx(value, rel=1e-15), unit)


@pytest.mark.parametrize("unit", [unit for unit in UNITS if unit])
def test_a_unit_is_read_by_its_name_and_by_its_sign(unit):
    for written in (unit, UNIT_SIGNS.get(unit, unit)):
        assert read_quantity(f"2 {written}") == (2.0, unit)
        assert read_matrix(f"2 {written}, -3 {written}", (1, 2), unit).tolist() == [[2.0, -3.0]]


def test_units_of_a_row_without_commas():
    assert read_matrix("2 m/s² -3 m/s^2", (1, 2), "m/s^2").tolist() == [[2.0, -3.0]]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("90 Deg", (90.0, "deg")),
        ("2 Rad", (2.0, "rad")),
        ("90 DEGREES", (90.0, "deg")),
        ("90 Deg/s", (90.0, "deg/s")),
        ("Deg(pi/2) - 30", (60.0, None)),
    ],
)
def test_a_unit_of_angles_may_have_large_letters(text, expected):
    number, unit = read_quantity(text, "m")
    assert (pytest.approx(number), unit) == expected


def test_powers_in_a_matrix_may_be_raised():
    assert read_matrix("3·10⁻² 2²; 4×10⁻²⁰ 10²⁰", (2, 2)).tolist() == [[0.03, 4.0], [4e-20, 1e20]]
    assert read_matrix("2 m s⁻², -3·10⁻² m/s²", (1, 2), "m/s^2").tolist() == [[2.0, -0.03]]


def test_an_acceleration_is_no_other_quantity():
    question = NumberQuestion("", 0.5, "rad/s^2", 0.001)
    assert question.judge("0.5").right
    assert question.judge("0.5 rad/s²").right
    assert question.judge("0.5 m").says == "This is a length; the question asks for an angular acceleration in rad/s^2."


def test_a_quantity_that_cannot_be_read():
    with pytest.raises(InputError, match="I cannot read 'm'"):
        read_quantity("m")


NUMBER = 'answer = 2\ntolerance = 0.1\nunit = "m"\n'


def test_a_number_question_of_a_file():
    question = ask(NUMBER + 'hide = ["arm", "arm"]\n[[wrong]]\nanswer = 1\nsays = "a < b"')
    assert (question.html, question.form, question.hide) == ("<p>How much?</p>", Field("m"), ("arm",))
    assert question.judge(question.right_answer).right
    assert question.wrong == (("1 m", "<p>a &lt; b</p>"),)
    assert question.judge(question.wrong[0].typed) == Verdict(False, "<p>a &lt; b</p>", "wrong[1]")


def test_all_kinds_are_found():
    assert list(question_types()) == ["number", "choice", "matrix", "expression", "matrix_formula", "erratum"]


OPTIONS = 'options = ["one", "two", "three"]\n'


def test_one_choice():
    question = ask(OPTIONS + 'answer = 2\n[[wrong]]\nanswer = 3\nsays = "too many"', "choice")
    assert question.form == Choices(("<p>one</p>", "<p>two</p>", "<p>three</p>"), False)
    assert question.right_answer == "2"
    assert question.judge(" 2 ").right
    assert question.judge("3") == Verdict(False, "<p>too many</p>", "wrong[1]")
    assert question.judge("1") == Verdict(False, "This is not the answer yet.")
    assert question.judge("1,2").says == "Choose one option only."
    for text in ("0", "4", "", "two", "2.0", "-1", "²", "9" * 5000):
        assert question.judge(text).name == "unreadable"


def test_the_right_option_may_follow_from_the_variant():
    assert ask(OPTIONS + "answer = 2.0", "choice").judge("2").right
    assert ask(OPTIONS + "answer = [1.0, 3]", "choice").judge("1,3").right


def test_several_choices():
    text = 'answer = [1, 3]\n[[wrong]]\nanswer = 2\nsays = "not two"\n[[wrong]]\nanswer = [1, 2]\nsays = "exactly"'
    question = ask(OPTIONS + text, "choice")
    assert question.form.several
    assert question.right_answer == "1,3"
    assert [question.judge(text).right for text in ("1,3", "3 1", "1;3", "1, 3,")] == [True] * 4
    assert question.judge("1").name == "missing"
    assert question.judge("1,2").name == "wrong[2]"
    assert question.judge("2").name == "wrong[1]"
    for wrong in question.wrong:
        assert question.judge(wrong.typed).says == wrong.says
    bare = ask(OPTIONS + "answer = [1]", "choice")
    assert bare.judge("1,2").name == "too many"
    assert bare.judge("2").name == "other"


@pytest.mark.parametrize(
    ("kind", "text", "says"),
    [
        ("number", "answer = 2\ntolerance = 0", "tolerance: expected a positive number"),
        ("number", 'answer = 2\ntolerance = 1\nunit = "km"', "unit: unknown value 'km'"),
        ("number", "tolerance = 1", "answer: missing"),
        ("number", NUMBER + "colour = 1", "colour: unknown key"),
        ("number", NUMBER + 'hide = "arm"', "hide: expected a list of 'arm' or 'values', got 'arm'"),
        ("number", NUMBER + 'hide = ["leg"]', "hide: expected a list"),
        ("number", NUMBER + "hide = [[]]", "hide: expected a list"),
        ("number", NUMBER + '[[wrong]]\nanswer = 2.1\nsays = "x"', r"wrong\[1\].answer: 2.1 is too close"),
        ("number", NUMBER + "[[wrong]]\nanswer = 5", r"wrong\[1\].says: missing"),
        ("nummer", NUMBER, "kind: unknown value 'nummer'; did you mean 'number'"),
        ("choice", "answer = 1", "options: missing"),
        ("choice", 'options = ["a"]\nanswer = 1', "options: expected 2 to 12 different options, got 1"),
        ("choice", 'options = ["a", "a"]\nanswer = 1', "options: expected 2 to 12 different"),
        ("choice", 'options = ["a", 2]\nanswer = 1', "options: expected a list of texts"),
        ("choice", OPTIONS + "answer = 4", "answer: expected options from 1 to 3, got 4"),
        ("choice", OPTIONS + "answer = []", "answer: expected options from 1 to 3"),
        ("choice", OPTIONS + "answer = true", "answer: expected options from 1 to 3"),
        (
            "choice",
            OPTIONS + 'answer = 1\n[[wrong]]\nanswer = 1\nsays = "x"',
            r"wrong\[1\].answer: 1 is the right answer",
        ),
        ("choice", OPTIONS + 'answer = 1\n[[wrong]]\nanswer = [2, 3]\nsays = "x"', "expected one option, got 2,3"),
        ("choice", OPTIONS + 'answer = [1]\n[[wrong]]\nanswer = 1\nsays = "x"', "1 is the right answer; give a list"),
    ],
)
def test_broken_questions_name_file_and_key(kind, text, says):
    with pytest.raises(ContentError, match=rf"f\.md: step 1\.question\.{says}|f\.md: .*{says}"):
        ask(text, kind)


def test_options_stand_in_another_order_in_other_variants():
    form = Choices(("a", "b", "c", "d"), False)
    assert form.order(0, "Step") == (1, 2, 3, 4)
    orders = {form.order(k, "Step") for k in range(1, 30)}
    assert len(orders) > 10
    assert all(sorted(order) == [1, 2, 3, 4] for order in orders)
    assert form.order(7, "Step") == form.order(7, "Step") != form.order(7, "Other")
    assert {Choices(("1", "2"), False, True).order(k, "Step") for k in range(9)} == {(1, 2)}
