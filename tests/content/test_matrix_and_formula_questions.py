"""Answers that are matrices or formulas."""

import html
import math

import numpy as np
import pytest

from armlab.content.question import Field, Grid, Verdict, read_question
from armlab.content.questions.expression import read_formula
from armlab.content.questions.matrix import typed
from armlab.content.reader import Table
from armlab.errors import ContentError


def ask(kind, text):
    table = Table.parse("f.md", f'kind = "{kind}"\ntext = "?"\n{text}')
    return read_question(table, lambda markdown, where: markdown)


M = ask("matrix", "answer = [[1, 2, 3], [4, 5, 6], [7, 8, 10]]\ntolerance = 0.01")
H = math.sqrt(0.5)
ROTATION = ask("matrix", f"answer = [[{H}, {-H}, 0], [{H}, {H}, 0], [0, 0, 1]]\ntolerance = 0.001")
VECTOR = ask("matrix", 'answer = [[0.5], [0.25]]\ntolerance = 0.001\nunit = "m"')


@pytest.mark.parametrize(
    "text",
    [
        "1 2 3; 4 5 6; 7 8 10",
        "1, 2, 3; 4, 5, 6; 7, 8, 10",
        "1, 2, 3; 4 5 6; 7 8, 10",
        "1 2 3\n4 5 6\n7 8 10\n",
        "[1 2 3; 4 5 6; 7 8 10]",
        "[[1, 2, 3], [4, 5, 6],\n [7, 8, 10]]",
        "[[ 1.  2.  3.]\n [ 4.  5.  6.]\n [ 7.  8. 10.]]",
        "[[1, 2,\n 3], [4, 5, 6], [7, 8, 10]]",
        "np.array([[1, 2, 3], [4, 5, 6], [7, 8, 10]])",
        "Matrix([[1, 2, 3], [4, 5, 6], [7, 8, 10]])",
        "1,0 2,0 3,0; 4 5 6; 7,0 8 10,0",
        "1 2 1 + 2; 4 5 2 * 3; 7 8 sqrt(4) * 5",
        "1 4-2 3; 4 5 6; 7 2³ 10¹",
        "1 2 max(3, 1); 4 5 6; 7 8 10",
    ],
)
def test_ways_to_type_a_matrix(text):
    assert M.judge(text) == Verdict(True, "Right.")


@pytest.mark.parametrize(
    "text", ["√2/2 -√2/2 0; √½ 1/√2 0; 0 0 1", "cos(45°) −sin(pi/4) 0; sin(45°) cos(45°) 0; 0, 0, 1"]
)
def test_entries_are_formulas(text):
    assert ROTATION.judge(text).right


@pytest.mark.parametrize("text", ["0.5; 0.25", "0.5 0.25", "0.5, 0.25", "[0.5, 0.25]", "0,5; 0,25", "1/2\n1/4"])
def test_a_vector_may_lie_or_stand(text):
    assert VECTOR.judge(text).right


@pytest.mark.parametrize(
    "text",
    [
        *("60 90 -60", "60 deg 90 deg, -60 deg", "pi/3 rad, 90, -60°", "60deg 90° −pi/3rad", "60; 90; -60"),
        *("90°-30° 180°/2 30° - 90°", "90 deg - 30 deg 45 deg + 45 deg -60 deg", "pi/2-30°, 2*45°, -(60°)"),
    ],
)
def test_angles_in_a_matrix_may_have_their_unit(text):
    assert ask("matrix", 'answer = [[60, 90, -60]]\ntolerance = 0.5\nunit = "deg"').judge(text).right


@pytest.mark.parametrize(
    ("question", "text", "says", "name"),
    [
        (M, "1 4 7; 2 5 8; 3 6 10", "This is the transposed matrix", "transposed"),
        (M, "1 2 -3; 4 5 6; 7 8 10", "One sign is wrong: row 1, column 3.", "sign"),
        (M, "1 2 -3; 4 -5 6; 7 8 10", "2 signs are wrong; the first is in row 1, column 3.", "sign"),
        (M, "-1 -2 -3; -4 -5 -6; -7 -8 -10", "The sizes are right; all signs", "sign"),
        (M, "1 2 3; 7 8 10; 4 5 6", "The rows 2 and 3 are exchanged.", "rows exchanged"),
        (M, "4 5 6; 7 8 10; 1 2 3", "The rows are right, but not in this order.", "rows exchanged"),
        (M, "2 1 3; 5 4 6; 8 7 10", "The columns 1 and 2 are exchanged.", "columns exchanged"),
        (M, "1 2 3; 4 5 6; 7 9 10", "All entries are right but one: row 3, column 2.", "entry"),
        (M, "1 2 3; 0 0 0; 7 8 10", "3 of 9 entries are not right; the first is in row 2, column 1.", "entries"),
        (M, "1 2; 3 4", "This has 2 rows and 2 columns; the question asks for 3 rows and 3 columns.", "shape"),
        (M, "1 2 3; 4 5", "The rows differ in length: they have 3, 2 entries.", "unreadable"),
        (M, "1 2 <x>; 4 5 6; 7 8 10", "Row 1, column 3: ", "unreadable"),
        (M, "1 2 1/0; 4 5 6; 7 8 10", "Row 1, column 3: &#x27;1/0&#x27;: division by zero", "unreadable"),
        (M, "", "Write the rows with ;", "unreadable"),
        (M, ";;[", "Write the rows with ;", "unreadable"),
        (M, "1 " * 2000, "A matrix has at most 2000 characters", "unreadable"),
        (VECTOR, "500 250", "The numbers are right in mm; give them in m.", "unit"),
        (VECTOR, "0.25 0.5", "The rows 1 and 2 are exchanged.", "rows exchanged"),
    ],
)
def test_mistakes_in_a_matrix_are_named(question, text, says, name):
    verdict = question.judge(text)
    assert (verdict.right, verdict.name) == (False, name)
    assert verdict.says.replace("'", "&#x27;").startswith(says.replace("'", "&#x27;"))


def test_no_verdict_gives_an_entry():
    for text in ("1 2 3; 4 5 6; 7 9 10", "0 0 0; 0 0 0; 0 0 0", "1 2 3; 4 5 6; 7 8 -10"):
        assert "10" not in M.judge(text).says


def test_random_matrices_are_read_as_they_are_written(rng):
    for _ in range(100):
        rows, columns = rng.integers(1, 6, 2)
        matrix = rng.normal(size=(rows, columns))
        question = ask("matrix", f"answer = {matrix.tolist()}\ntolerance = 1e-9")
        assert question.form == Grid(rows, columns, "")
        written = [typed(matrix), str(matrix.tolist()), np.array2string(matrix, precision=17, floatmode="unique")]
        assert all(question.judge(text).right for text in (*written, question.right_answer))
        i, k = rng.integers(rows), rng.integers(columns)
        matrix[i, k] += 0.5
        assert not question.judge(typed(matrix)).right


def test_wrong_matrices_of_the_lesson():
    text = '[[wrong]]\nanswer = [[1, 0], [0, 1]]\nsays = "no turn"\n[[wrong]]\nanswer = [[1], [2]]\nsays = "a vector"'
    question = ask("matrix", f"answer = [[0, -1], [1, 0]]\ntolerance = 0.01\n{text}")
    assert question.judge("0 1; -1 0").name == "transposed"
    for i, wrong in enumerate(question.wrong, start=1):
        assert question.judge(wrong.typed) == Verdict(False, wrong.says, f"wrong[{i}]")


TWO_R = ask(
    "expression",
    'answer = "l1*cos(q1) + l2*cos(q1+q2)"\nvariables = ["q1", "q2", "l1", "l2"]\nhide = ["values"]\n'
    '[[wrong]]\nanswer = "l1 c1 + l2 c2"\nsays = "the sum"',
)


@pytest.mark.parametrize(
    "text",
    [
        "l1*cos(q1) + l2*cos(q1+q2)",
        "l1 c1 + l2 c12",
        "l1c1+l2c12",
        "l₁c₁ + l₂c₁₂",
        "l_1 cos(q_1)+l_2cos(q_1+q_2)",
        "l1 cos(θ1) + l2 cos(θ₁ + ϑ₂)",
        "l1 cos(theta1) + l2 cos(theta_1 + theta_2)",
        "c1 (l1 + l2 c2) - l2 s1 s2",
        "l1*c1 + l2*(cos(q1)*cos(q2) − sin(q1)*sin(q2))",
        "l1 sin(q1 + pi/2) + l2 sin(q1+q2+90°)",
        "sqrt(l1^2) c1 + l2 c12",
    ],
)
def test_ways_to_write_a_formula(text):
    assert TWO_R.judge(text) == Verdict(True, "Right.")


@pytest.mark.parametrize(
    ("text", "says", "name"),
    [
        ("-l1 c1 - l2 c12", "All signs are the other way round.", "sign"),
        ("l1 s1 + l2 s12", "Sine and cosine are exchanged.", "sine and cosine"),
        ("-l1 s1 - l2 s12", "Sine and cosine are exchanged, and the sign is wrong.", "sine and cosine"),
        ("l1 c1 + l2 c2", "the sum", "wrong[1]"),
        ("l1 c1", "The answer has to depend on l2, q2 as well.", "missing"),
        ("l1 c1 - l2 c12", "This is not the answer yet.", ""),
        ("l1 abs(c1) + l2 c12", "This is not the answer yet.", ""),
        ("1.00001*(l1 c1 + l2 c12)", "This is not the answer yet.", ""),
        ("l1 c1 + l2 c12 + 0.0001", "This is not the answer yet.", ""),
        ("l1 c1 + l2 c21", "Unknown name 'c21'", "unreadable"),
        ("l1 c1 + l2 c13", "Unknown name 'c13'", "unreadable"),
        ("l3", "Unknown name 'l3'", "unreadable"),
        ("1/(q1-q1)", "'1/(q1-q1)': division by zero", "unreadable"),
        ("<i>", "Expected numbers, names", "unreadable"),
        ("", "Expected a formula or a number, got nothing", "unreadable"),
        ("().__class__", "'(' cannot|')' cannot|Expected", "unreadable"),
    ],
)
def test_mistakes_in_a_formula_are_named(text, says, name):
    verdict = TWO_R.judge(text)
    assert (verdict.right, verdict.name) == (False, name)
    assert any(verdict.says.startswith(start) for start in says.split("|"))
    assert "<i>" not in verdict.says


def test_a_formula_question_of_a_file():
    assert (TWO_R.form, TWO_R.hide) == (Field(), ("values",))
    assert TWO_R.right_answer == "l1*cos(q1) + l2*cos(q1+q2)"
    assert TWO_R.wrong == (("l1 c1 + l2 c2", "the sum"),)
    assert TWO_R.judge(TWO_R.wrong[0].typed).says == "the sum"


def test_a_formula_that_has_no_value_everywhere():
    question = ask("expression", 'answer = "acos((x^2 + y^2 - 2)/2)"\nvariables = ["x", "y"]')
    assert question.judge("pi/2 - asin((x^2 + y^2)/2 - 1)").right
    assert question.judge("-acos((x^2+y^2-2)/2)").name == "sign"


def test_names_of_variables_come_before_short_forms():
    assert read_formula("c1 + s12", ("c1", "q1", "q2")).names == {"c1", "q1", "q2"}
    assert read_formula("θ1", ("q1",)).names == {"q1"}


BARE = 'variables = ["q1"]\n'


@pytest.mark.parametrize(
    ("kind", "text", "says"),
    [
        ("matrix", "answer = [[1, 2], [3]]\ntolerance = 1", "answer: expected rows of equal length, got 2, 1"),
        ("matrix", "answer = [1, 2]\ntolerance = 1", r"answer: expected rows of numbers such as \[\[1, 0\]"),
        ("matrix", "answer = []\ntolerance = 1", "answer: expected rows of numbers"),
        ("matrix", 'answer = [["1"]]\ntolerance = 1', "answer: expected a number"),
        (
            "matrix",
            f"answer = {[[0]] * 7}\ntolerance = 1",
            "answer: expected at most 6 rows and 12 columns, got 7 rows",
        ),
        ("matrix", "answer = [[1]]\ntolerance = -1", "tolerance: expected a positive number"),
        (
            "matrix",
            'answer = [[1]]\ntolerance = 1\n[[wrong]]\nanswer = [[2]]\nsays = "x"',
            r"wrong\[1\].answer: too close",
        ),
        ("matrix", "answer = [[1]]\ntolerance = 1\nsize = 2", "size: unknown key"),
        ("expression", 'answer = "q1 +"\n' + BARE, "answer: the formula breaks off"),
        ("expression", 'answer = "q2"\n' + BARE, "answer: unknown name 'q2'"),
        ("expression", 'answer = "sqrt(-1 - q1^2)"\n' + BARE, "answer: expected a formula that has a value"),
        ("expression", 'answer = "1"\nvariables = []', "variables: expected a list of 1 to 12 names"),
        ("expression", 'answer = "1"\nvariables = ["sin"]', "variables: 'sin' has a meaning of its own"),
        ("expression", 'answer = "1"\nvariables = ["a b"]', "variables: expected names of letters and digits"),
        ("expression", 'answer = "1"\nvariables = ["a", "a"]', "variables: a name comes twice"),
        (
            "expression",
            'answer = "2 q1"\n' + BARE + '[[wrong]]\nanswer = "q1 + q1"\nsays = "x"',
            r"wrong\[1\].answer: equal to the right answer",
        ),
    ],
)
def test_broken_questions_name_file_and_key(kind, text, says):
    with pytest.raises(ContentError, match=rf"f\.md: {says}"):
        ask(kind, text)


@pytest.mark.parametrize("text", ["500mm 25cm", "0.5m 0.25", "0.5; 250mm", "(1/2)m 0.25m"])
def test_an_entry_may_have_a_unit_of_its_own(text):
    assert VECTOR.judge(text).right


@pytest.mark.parametrize(
    ("question", "text", "says"),
    [
        (VECTOR, "500rad 0.25", "Row 1, column 1: this is an angle; write a length in m."),
        (M, "1 2 3; 4 5m 6; 7 8 10", "Row 2, column 2: this is a length; write the number alone."),
        (M, "1 2 3; 4 ? 6; 7 8 10", "Row 2, column 2 is empty."),
        (VECTOR, "0.5 x", "Row 1, column 2: unknown name 'x'"),
    ],
)
def test_an_entry_that_cannot_be_used_says_why(question, text, says):
    verdict = question.judge(text)
    assert (verdict.right, verdict.name) == (False, "unreadable")
    assert html.unescape(verdict.says).startswith(says)
