"""The files of the package, and what they import."""

import ast
import re
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "app" / "armlab"
TOP = PACKAGE.parents[1]


def tree_of(path):
    """Return the syntax tree of a file.

    It is not kept: Python would look for garbage in the trees of all files, which takes longer than to read them again.
    """
    return ast.parse(path.read_text(encoding="utf-8"))


def files_with(files, pattern):
    """Yield the files in whose text a pattern is found: a rule about a word need not take the others apart."""
    looks = re.compile(pattern).search
    yield from (file for file in files if looks(file.read_text(encoding="utf-8")))


def statements(tree, skipped=lambda statement: False):
    """Yield the statements of a tree and their clauses, at any depth, without what is skipped and all inside it."""
    waiting = [tree]
    while waiting:
        nodes = [node for node in ast.iter_child_nodes(waiting.pop()) if not isinstance(node, ast.expr)]
        inside = [node for node in nodes if not skipped(node)]
        waiting += inside
        yield from inside


def imports_of(path, types=False):
    """Return the dotted names a file imports, also inside functions; those it needs for types alone when asked."""
    return _both_imports(path)[types]


@cache
def _both_imports(path):
    """Return both answers of `imports_of`: a file is read and taken apart once, though several rules ask for it."""
    tree = tree_of(path)
    return _imported(path, statements(tree, _is_for_types)), _imported(path, statements(tree))


def _imported(path, found_statements):
    found = []
    for node in found_statements:
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            if node.module != "armlab":
                found.append(node.module)
            found += [f"{node.module}.{alias.name}" for alias in node.names]
    return tuple(found)


def _is_for_types(statement):
    return isinstance(statement, ast.If) and getattr(statement.test, "id", "") == "TYPE_CHECKING"
