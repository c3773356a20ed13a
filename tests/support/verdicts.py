"""What the lab says of answers: questions of every kind, and answers that are wrong in every way it can name."""

from __future__ import annotations

from collections.abc import Iterator

from armlab.content.question import Question, read_question
from armlab.content.reader import Table
from armlab.teaching.lesson_commands import still_open
from armlab.teaching.plain_text import plain

NUMBER = 'kind = "number"\ntext = "?"\nanswer = {answer}\nunit = "{unit}"\ntolerance = {tolerance}\n'
CHOICE = 'kind = "choice"\ntext = "?"\noptions = ["a", "b", "c", "d"]\nanswer = {answer}\n'
MATRIX = 'kind = "matrix"\ntext = "?"\nanswer = {answer}\nunit = "{unit}"\ntolerance = 0.001\n'
EXPRESSION = 'kind = "expression"\ntext = "?"\nanswer = "{answer}"\nvariables = ["l1", "q1", "q2"]\n'
FORMULA = """kind = "matrix_formula"
text = "?"
answer = "{answer}"
names = {{ J = [2, 3], v = [2, 1], A = [2, 2], k = [] }}
identities = {{ I = 3 }}
"""

UNREADABLE = (
    *(
        "",
        "?",
        "l1 +",
        "* 2",
        "2 * * 3",
        "sin",
        "sin^2(q1)",
        "sin(1, 2)",
        "atan2(1)",
        "min(1)",
        "(1 + 2",
        "foo",
        "cosq",
        "l9",
        "2 $",
    ),
    *("1/0", "sqrt(-1)", "exp(1000)", "2^2000", "ln(0)", "1" * 700, "(" * 50 + "1" + ")" * 50, "1 + )", "q1 q3"),
)
"""Texts that cannot be read as a formula."""

OF_MATRICES = (
    *("J + v", "J + k", "J v", "v / J", "v / 0", "J^v", "J^2", "A^0.5", "A^99", "(J^T J)^-1", "0^-1", "(-2)^0.5", "T"),
    *("sqrt(J)", "sqrt(-k)", "J^T^T", "J T", "A + foo"),
)
"""Formulas of matrices that have no value, for `FORMULA`."""

ASKED: tuple[tuple[str, tuple[str, ...]], ...] = (
    (
        NUMBER.format(answer=1.0, unit="rad", tolerance=0.01),
        (
            *UNREADABLE,
            "1 m/s^3",
            "1 deg^2",
            "1 m^2",
            "1 cm/s",
            "50 N",
            "1 rpm",
            "3 %",
            "2 V",
            "2 A",
            "5 W",
            "2 s",
            "1 N m",
        ),
    ),
    (
        NUMBER.format(answer=1.0, unit="rad", tolerance=0.01),
        ("1", "-1", "57.3", "1 deg", "2", "0.5", "7.283", "5", "1 m", "1 m/s"),
    ),
    (NUMBER.format(answer=60, unit="deg", tolerance=0.5), ("1.0472", "60 rad", "1 m", "-60", "420", "180° - 55")),
    (NUMBER.format(answer=0.5, unit="", tolerance=0.001), ("foo", "cos(60)", "1 m", "0.25", "1")),
    (NUMBER.format(answer=25, unit="%", tolerance=0.1), ("0.25", "1 m")),
    (NUMBER.format(answer=0.5, unit="m", tolerance=0.001), ("foo", "500", "50", "0.5 rad", "90°", "1")),
    *(
        (NUMBER.format(answer=3, unit=unit, tolerance=0.1), ("foo", "3 m"))
        for unit in (
            *("s", "m/s", "deg/s", "m^2", "N", "Nm", "V", "mA", "kW", "rpm", "rad/s", "m/s^2", "rad/s^2", "1/s"),
            *("1/s^2", "m/rad", "1/m", "1/m^2", "m^2/s", "Ns/m"),
        )
    ),
    (CHOICE.format(answer=2), ("9", "1,2", "1", "2")),
    (CHOICE.format(answer="[2, 4]"), ("2", "1,2,4", "1,2", "x")),
    (
        MATRIX.format(answer="[[1, 2], [3, 4]]", unit=""),
        (
            *("1 3; 2 4", "-1 -2; -3 -4", "2 1; 4 3", "3 4; 1 2", "1 -2; 3 4", "1 -2; 3 -4", "1 2; 3 5", "1 2; 5 6"),
            *("1 2 3; 4 5 6", "1 2", "1; 2", "1", "? 2; 3 4", "1 2; 3", "", "1 m 2; 3 4", "foo 2; 3 4", "1/0 2; 3 4"),
            *("1 " * 1001, "(1,2) 2; 3 4", "sin 2; 3 4", "$ 2; 3 4", "cosq 2; 3 4", "sin^2(1) 2; 3 4", "1 2; 3 4+"),
            *("1 2; 3 (4", "1 2; 3 2^2000", "1 2; 3 sqrt(-1)", "1 2; 3 sin(1,2)", "1 2; 3 min(1)", "1 2; 3 *2"),
            f"1 2; 3 {'(' * 50}1{')' * 50}",
        ),
    ),
    (MATRIX.format(answer="[[1, 2, 3]]", unit="m"), ("100 200 300", "3 1 2", "1rad 2 3", "1 2", "2 1 3")),
    (MATRIX.format(answer="[[1], [2], [3]]", unit="deg"), ("3; 1; 2", "1m; 2; 3", "180° - 55; 2; 3")),
    (
        EXPRESSION.format(answer="l1*cos(q1)"),
        (*UNREADABLE, "-l1*cos(q1)", "l1*sin(q1)", "-l1*sin(q1)", "l1", "cos(q2)", "l1*cos(q1)"),
    ),
    (
        FORMULA.format(answer="J^T (J J^T)^-1"),
        (*UNREADABLE, *OF_MATRICES, "-J^T (J J^T)^-1", "(J J^T)^-1 J", "J", "2", "J^T"),
    ),
    (FORMULA.format(answer="A"), ("A^T", "-A")),
)
"""Questions, each with answers."""


def asked_for(text: str) -> Question:
    """Return the question that a text asks for, with its Markdown as it is."""
    return read_question(Table.parse("test.md", text), lambda markdown, key: markdown)


def questions() -> Iterator[tuple[Question, tuple[str, ...]]]:
    """Yield a question of each kind, with answers."""
    for text, answers in ASKED:
        yield asked_for(text), answers


def verdicts() -> Iterator[str]:
    """Yield what is said of all the answers, as HTML."""
    return (question.judge(answer).says for question, answers in questions() for answer in answers)


def predictions_refused() -> Iterator[str]:
    """Yield what is said of those that are no answers where they were to predict something."""
    found = (question.judge(answer) for question, answers in questions() for answer in answers)
    return (still_open(plain(verdict.says)) for verdict in found if not verdict.counts)
