"""A docstring begins with the thing it is about: a constant with its noun, a sentence never with "what" or "of"."""

import ast
import re

import pytest

from support.sources import PACKAGE, files_with, tree_of

LAYERS = ["kin", "content", "session", "teaching", "ui", "benches", "window", "front", "commands", ""]
"""The folders of the package; the last one is what lies in none of them."""

SENTENCE = re.compile(r"(?:\A|(?<=[.!?])\s+|\n\s*\n\s*|\n\s*-{3,}\n\s*)((?:What|Of|Those that)\b[^\n]*)")
"""The opening of a sentence, as far as it stands on its line, if it is one of those that a reader has to read twice."""

NO_NOUN = re.compile(
    r"(?:After|As|At|Below|By|Bytes|Characters|For|From|How|In|Kept|Less|Metres|More|Of|On|Radians|Said|Seconds|So|Such|"
    r"Times|To|Under|What|When|Where|Which|Whose|With|Within)\b"
)
"""First word of a constant's docstring that leaves a reader to guess which number it is."""


MAY_OPEN_BADLY = r"(?:What|Of|Those that)\b|[\"'][\s\\]*" + NO_NOUN.pattern
"""Pattern of the files that can break the rule."""


def docstrings(tree):
    """Yield line, text, and whether it stands under an assignment, of every docstring in a tree."""
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if not isinstance(body, list):
            continue
        for i, statement in enumerate(body):
            if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
                text = statement.value.value
                if isinstance(text, str):
                    under = i > 0 and isinstance(body[i - 1], (ast.Assign, ast.AnnAssign))
                    yield statement.lineno, text, under


def opens_badly(text, of_constant):
    """Return the opening that breaks a rule, or None."""
    if found := SENTENCE.search(text):
        return found[1]
    return text if of_constant and NO_NOUN.match(text) else None


def problems(folder):
    whole = folder == PACKAGE
    return [
        f"{path.relative_to(PACKAGE)}:{line}: {bad}"
        for path in files_with(sorted(folder.glob("*.py") if whole else folder.rglob("*.py")), MAY_OPEN_BADLY)
        for line, text, under in docstrings(tree_of(path))
        if (bad := opens_badly(text, under)) is not None
    ]


@pytest.mark.parametrize("layer", LAYERS)
def test_docstrings_begin_with_their_subject(layer):
    assert problems(PACKAGE / layer) == []


@pytest.mark.parametrize(
    "planted",
    [
        '"""What a thing is."""',
        'def f():\n    """Return it. Of two the first."""',
        'A = 1\n"""Of the reach: nearer is there."""',
        'A = 1\n"""Radians, below which nothing turns."""',
        'class C:\n    """A class."""\n\n    a = 1\n    """At most."""',
    ],
)
def test_a_docstring_that_begins_with_something_else_is_found(planted):
    assert any(opens_badly(text, under) for _, text, under in docstrings(ast.parse(planted)))
