"""Answers that are formulas of matrices: what is equal, what is named, and what cannot be worked out."""

import pytest

from armlab.content.question import Field, read_question
from armlab.content.reader import Table
from armlab.errors import ContentError


def ask(text):
    table = Table.parse("f.md", f'kind = "matrix_formula"\ntext = "?"\n{text}')
    return read_question(table, lambda markdown, where: markdown)


INVERSE = ask('names = { J = [2, 3] }\nanswer = "J^T (J J^T)^-1"')
DAMPED = ask('names = { J = [2, 3], lam = [] }\nidentities = { Im = 2, In = 3 }\nanswer = "J^T (lam Im + J J^T)^-1"')
FORM = ask("""
names = { P = [3, 2], v = [2, 1] }
answer = "v^T P^T P v"
[[wrong]]
answer = "2 v^T P^T P v"
says = "Half of it."
""")


def test_the_answer_is_one_line():
    assert INVERSE.form == Field()
    assert INVERSE.right_answer == "J^T (J J^T)^-1"


@pytest.mark.parametrize("text", ["J^T (J J^T)^-1", "Jᵀ(J Jᵀ)⁻¹", "J^T*(J*J^T)^(-1)", "((J J^T)^-1 J)^T"])
def test_ways_to_write_the_same(text):
    assert INVERSE.judge(text).right


@pytest.mark.parametrize("text", ["J^T (lam Im + J J^T)^-1", "(lam In + J^T J)^-1 J^T", "J^T (J J^T + Im lam)^-1"])
def test_both_sides_of_an_identity_are_right(text):
    assert DAMPED.judge(text).right


def test_a_number_may_stand_before_after_and_below():
    assert FORM.judge("2 v^T P^T P v/2").right
    assert FORM.judge("(P v)^T P v").right


def test_another_right_answer_may_have_other_values():
    question = ask('names = { a = [] }\nanswer = "a"\nalso = ["-a"]')
    assert question.judge("-a").right
    assert not question.judge("2 a").right


@pytest.mark.parametrize(
    ("question", "text", "name", "says"),
    [
        (FORM, "2 (P v)^T P v", "wrong[1]", "Half of it."),
        (FORM, "-v^T P^T P v", "sign", "All signs are the other way round."),
        (INVERSE, "(J J^T)^-1 J", "transposed", "This is the transposed matrix."),
        (INVERSE, "J^T", "", "This is not the answer yet."),
        (INVERSE, "J J^T", "shape", "This is a 2 × 2 matrix; the answer is a 3 × 2 matrix."),
        (FORM, "P v", "shape", "This is a 3 × 1 matrix; the answer is a number."),
    ],
)
def test_mistakes_are_named(question, text, name, says):
    verdict = question.judge(text)
    assert not verdict.right
    assert verdict.name == name
    assert verdict.says == says


@pytest.mark.parametrize(
    ("question", "text", "says"),
    [
        (INVERSE, "(J^T J)^-1 J^T", "A 3 × 3 matrix in the formula has no inverse: its rank is 2"),
        (INVERSE, "J J", "The sizes of a product do not fit: 2 × 3 times 2 × 3"),
        (INVERSE, "J + J^T", "A sum needs two of the same size, got 2 × 3 and 3 × 2"),
        (INVERSE, "J^-1", "Only a square matrix has powers and an inverse, got 2 × 3"),
        (INVERSE, "T J", "T transposes and stands behind ^"),
        (INVERSE, "T", "T transposes and stands behind ^"),
        (INVERSE, "1/J", "Matrices cannot be divided by"),
        (INVERSE, "2^J", "Expected a number, -1 or T behind ^, got 2 × 3"),
        (INVERSE, "(J J^T)^0.5", "Expected -1 or a whole number up to 20 behind ^, got 0.5"),
        (INVERSE, "(J J^T)^1e999", "Expected -1 or a whole number up to 20 behind ^, got inf"),
        (INVERSE, "(J J^T)^(1e999-1e999)", "Expected -1 or a whole number up to 20 behind ^, got nan"),
        (INVERSE, "(J J^T)^99", "Expected -1 or a whole number up to 20 behind ^, got 99"),
        (INVERSE, "sqrt(J)", "Expected a number in sqrt, got 2 × 3"),
        (INVERSE, "J/0", "Division by zero"),
        (INVERSE, "J*0^-1", "0^-1 has no value"),
        (INVERSE, "J sqrt(-2)", "Not a real number"),
        (INVERSE, "J (-2)^0.5", "Not a real number"),
        (INVERSE, "J^T K", "Unknown name 'K'"),
        (INVERSE, "sin(J)", "Unknown name 'sin'"),
        (INVERSE, "", "Expected a formula or a number, got nothing"),
        (DAMPED, "J^T (lam In + J J^T)^-1", "A sum needs two of the same size, got 3 × 3 and 2 × 2"),
    ],
)
def test_what_cannot_be_worked_out_is_said(question, text, says):
    verdict = question.judge(text)
    assert verdict.name == "unreadable"
    assert verdict.says.startswith(says)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('answer = "J"', "names: missing"),
        ('names = { J = [2] }\nanswer = "J"', "names.J: expected rows and columns such as [2, 3], or [] for a number"),
        ('names = { J = [2, 9] }\nanswer = "J"', "names.J: expected rows and columns"),
        ('names = { sin = [2, 2] }\nanswer = "sin"', "names: expected names of letters and digits such as J"),
        ('names = {}\nanswer = "1"', "names: expected 1 to 8 names"),
        (
            'names = { J = [2, 3] }\nidentities = { J = 2 }\nanswer = "J"',
            "names: expected 1 to 8 names, each of them once",
        ),
        (
            'names = { J = [2, 3] }\nidentities = { I = 0 }\nanswer = "J"',
            "identities.I: expected a size from 1 to 6, got 0",
        ),
        ('names = { J = [2, 3] }\nanswer = "J J"', "answer: the sizes of a product do not fit"),
        ('names = { J = [2, 3] }\nanswer = "J"\nalso = ["K"]', "also: unknown name 'K'"),
        (
            'names = { J = [2, 3] }\nanswer = "J"\n[[wrong]]\nanswer = "2 J/2"\nsays = "!"',
            "wrong[1].answer: equal to the right answer",
        ),
    ],
)
def test_a_wrong_question_is_refused(text, says):
    with pytest.raises(ContentError) as refused:
        ask(text)
    assert says in str(refused.value)
