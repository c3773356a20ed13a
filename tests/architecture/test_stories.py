"""A story of a test runs in a thread of its own: where a browser is open its loop occupies that of the tests."""

import ast

import pytest

from support.sources import TOP, files_with, tree_of

RUNS = r"\basyncio\b"


def runs_itself(tree):
    """Return the lines in which a test runs an event loop in the thread of the tests."""
    calls = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    return [call.lineno for call in calls if ast.unparse(call.func) in ("asyncio.run", "asyncio.Runner")]


def test_no_test_runs_an_event_loop_in_the_thread_of_the_tests():
    files = files_with((TOP / "tests").rglob("test_*.py"), RUNS)
    assert {path.name: lines for path in files if (lines := runs_itself(tree_of(path)))} == {}


@pytest.mark.parametrize("call", ["asyncio.run(main())", "asyncio.Runner().run(main())"])
def test_such_a_test_is_found(call):
    assert runs_itself(ast.parse(f"import asyncio\n\ndef test_it():\n    assert {call}\n")) == [4]
