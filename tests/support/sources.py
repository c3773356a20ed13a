"""The files of the package, and what they import."""

import ast
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "app" / "armlab"
TOP = PACKAGE.parents[1]


@cache
def tree_of(path):
    """Return the syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


def imports_of(path, types=False):
    """Return the dotted names a file imports, also inside functions; or only at its top, then also for types."""
    tree = tree_of(path)
    skipped = [
        block
        for block in ast.walk(tree)
        if (isinstance(block, ast.FunctionDef) and types)
        or (isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING" and not types)
    ]
    left_out = {id(node) for block in skipped for node in ast.walk(block)}
    for node in ast.walk(tree):
        if id(node) in left_out:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            if node.module != "armlab":
                yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
