"""What the page on security promises is tested: each row names tests that are there."""

import ast
import re
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
ROWS = [line for line in (TOP / "docs" / "security.md").read_text().splitlines() if line.startswith("| ")][2:]


def named(row):
    return re.findall(r"`(tests/\S+\.py)::(test_\w+)`", row)


def functions(path):
    tree = ast.parse((TOP / path).read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))}


def test_every_row_names_a_test():
    assert len(ROWS) > 20
    assert [row for row in ROWS if not named(row)] == []


def test_every_test_that_is_named_is_there():
    missing = [f"{path}::{name}" for row in ROWS for path, name in named(row) if name not in functions(path)]
    assert missing == []
