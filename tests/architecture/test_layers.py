"""The shape of the house: imports go down only, files stay small, private parts of viser in one place."""

import ast
import re

import pytest

from support.sources import PACKAGE, TOP, imports_of, statements, tree_of

LEVELS = {
    "errors": 0,
    "plugins": 0,
    "registry": 0,
    "page": 0,
    "resources": 0,
    "running_loop": 0,
    "version": 0,
    "kin": 1,
    "content": 2,
    "session": 3,
    "teaching": 4,
    "ui": 5,
    "benches": 6,
    "window": 7,
    "front": 8,
}
"""Modules and folders by layer; those at the top, such as the command line, may use everything."""

ONLY_IN = {
    "viser": ("ui", "benches", "window"),
    "trimesh": (),
    "latex2mathml": ("ui", "content", "benches"),
    "markdown_it": ("content",),
    "mdit_py_plugins": ("content",),
    "aiohttp": ("front",),
    "zstandard": ("front",),
    "scipy": ("kin",),
}
"""Libraries that belong to one layer."""

FORBIDDEN_IN_CORE = {
    "time",
    "datetime",
    "pathlib",
    "os",
    "io",
    "random",
    "logging",
    "matplotlib",
    "threading",
    "asyncio",
}
MOST_LINES = 400


def allowed(own, level, name):
    """Return whether a module of a layer may import a name."""
    root, *rest = name.split(".")
    if root == "armlab":
        # The package itself stands at the top: it offers what the layers hold.
        target = LEVELS.get(rest[0]) if rest else None
        # Benches are found by folder, also by those who stand above them.
        return target is not None and target <= level and (rest[0] != "benches" or own == "benches")
    if own == "kin" and root in FORBIDDEN_IN_CORE:
        return False
    return root not in ONLY_IN or own in ONLY_IN[root]


def violations(package):
    """Return every import that goes up or uses a library of another layer."""
    found = []
    for path in sorted(package.rglob("*.py")):
        relative = path.relative_to(package)
        own = relative.parts[0].removesuffix(".py")
        if own in LEVELS:
            names = [name for name in imports_of(path) if not allowed(own, LEVELS[own], name)]
            found.extend(f"{relative} imports {name}" for name in names)
    return found


def test_imports_go_down_only():
    assert violations(PACKAGE) == []


@pytest.mark.parametrize(
    ("file", "line"),
    [
        ("kin/arm.py", "from armlab.content.robots import catalogue"),
        ("kin/dh.py", "import time"),
        ("kin/dh.py", "import armlab"),
        ("content/robots.py", "from armlab.session.state import State"),
        ("session/state.py", "import viser"),
        ("session/store.py", "from armlab.ui import adapter"),
        ("ui/format.py", "from armlab.front.page import Page"),
        ("front/page.py", "import viser"),
        ("session/state.py", "from armlab.benches.motion.api import Plan"),
        ("window/view.py", "from armlab.benches.motion.plan.state import Plan"),
        ("front/start.py", "from armlab.benches.motion.api import Plan"),
        ("ui/form.py", "from armlab.window.view import View"),
        ("benches/robot/table/ui/page.py", "from armlab.window.search.dialog import SearchDialog"),
        ("benches/robot/table/state.py", "from armlab.front.page import make_page"),
        ("kin/dh.py", "def f():\n    import viser"),
    ],
)
def test_a_planted_violation_is_found(file, line, tmp_path):
    copy = tmp_path / "armlab" / file
    copy.parent.mkdir(parents=True)
    copy.write_text((PACKAGE / file).read_text(encoding="utf-8"), encoding="utf-8")
    with open(copy, "a", encoding="utf-8") as source:
        source.write(f"\n\n{line}\n")
    assert len(violations(tmp_path / "armlab")) >= 1


BY_NAME = {"import_module", "__import__", "find_spec", "spec_from_file_location", "run_module", "run_path"}
"""Functions that take the name of a module as a text."""

FINDS = {
    "plugins.py": "finds by folder what lies in benches",
    "content/citations.py": "walks the modules of kin, whose docstrings it reads",
}
"""Modules up to the benches that import others by their names, and why."""


def hidden_imports(package):
    """Return every place up to the benches that could import a bench by its name, out of sight of the other rules."""
    found = []
    for path in sorted(package.rglob("*.py")):
        file = path.relative_to(package).as_posix()
        own = file.partition("/")[0].removesuffix(".py")
        if LEVELS.get(own, LEVELS["front"]) == LEVELS["front"] or file in FINDS:
            continue
        for node in ast.walk(tree_of(path)):
            if {getattr(node, "id", ""), getattr(node, "attr", ""), getattr(node, "name", "")} & BY_NAME:
                found.append(f"{file}:{node.lineno} imports a module by its name")
            if names_a_bench(node):
                found.append(f"{file}:{node.lineno} names a bench")
    return found


def names_a_bench(node):
    """Return whether a text is the name of a bench, also one that begins with the constant for all of them."""
    if isinstance(node, ast.JoinedStr):
        first, second = (*node.values, None, None)[:2]
        of_all = isinstance(first, ast.FormattedValue) and getattr(first.value, "id", "") == "BENCHES"
        return of_all and re.match(r"\.\w", str(getattr(second, "value", ""))) is not None
    return isinstance(node, ast.Constant) and re.fullmatch(r"armlab\.benches(\.\w+)*", str(node.value)) is not None


def test_benches_are_imported_by_name_in_one_place_only():
    assert hidden_imports(PACKAGE) == []


@pytest.mark.parametrize(
    ("file", "line"),
    [
        ("session/state.py", "from importlib import import_module"),
        ("window/view.py", "import importlib\n\nPLAN = importlib.import_module('arm' + 'lab')"),
        ("content/robots.py", "PLAN = __import__('armlab')"),
        ("session/words.py", "PLAN = constant_of('armlab.benches.motion.plan.state', 'PART', PartType)"),
        ("session/words.py", "PLAN = constant_of(f'{BENCHES}.motion.plan.state', 'PART', PartType)"),
        ("benches/robot/table/state.py", "from importlib.util import find_spec"),
    ],
)
def test_a_planted_import_by_name_is_found(file, line, tmp_path):
    copy = tmp_path / "armlab" / file
    copy.parent.mkdir(parents=True)
    copy.write_text((PACKAGE / file).read_text(encoding="utf-8") + f"\n\n{line}\n", encoding="utf-8")
    assert len(hidden_imports(tmp_path / "armlab")) >= 1


def python_files():
    return [p for part in ("app", "tests", "benchmarks") for p in sorted((TOP / part).rglob("*.py"))]


def test_files_stay_small():
    served = (PACKAGE / "front" / "static").iterdir()
    files = [*python_files(), *served, *(PACKAGE / "benches").rglob("*.css")]
    long = [str(path.relative_to(TOP)) for path in files if len(path.read_text().splitlines()) > MOST_LINES]
    assert long == []


def test_private_parts_of_viser_are_touched_in_the_adapter_and_in_what_is_quicker_only():
    found = []
    for path in [path for layer in ("ui", "benches", "window") for path in sorted((PACKAGE / layer).rglob("*.py"))]:
        if path.name in ("adapter.py", "quick.py"):
            continue
        text = path.read_text(encoding="utf-8")
        found += [f"{path.name}: {word}" for word in ("._impl", "_websock", "_messages", "._queue") if word in text]
    assert found == []


def silent_handlers(path):
    """Yield the lines of except clauses that do nothing."""
    if "except" not in path.read_text(encoding="utf-8"):
        return  # most files: they need not be taken apart
    for node in statements(tree_of(path)):
        if isinstance(node, ast.ExceptHandler) and all(isinstance(statement, ast.Pass) for statement in node.body):
            yield node.lineno


def test_no_exception_is_swallowed_in_silence():
    found = [f"{path.relative_to(TOP)}:{line}" for path in python_files() for line in silent_handlers(path)]
    assert found == []


def test_the_repository_names_no_machine():
    """No path of one machine, no host of a package index."""
    words = ["/" + "work/", "/" + "root/", "pypi" + "."]
    found = []
    for path in [*python_files(), *TOP.glob("*.*"), *(TOP / "robots").glob("*"), *(TOP / "docs").rglob("*.md")]:
        if path.is_file() and path.suffix in (".py", ".md", ".toml", ".js", ".css"):
            text = path.read_text(encoding="utf-8")
            found += [f"{path.name}: {word}" for word in words if word in text]
    assert found == []
