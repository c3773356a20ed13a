"""The shape of the house: imports go down only, files stay small, private parts of viser in one place."""

import ast

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
    "ui": 4,
    "benches": 5,
    "front": 6,
}
"""Modules and folders by layer; those at the top, such as the command line, may use everything."""

ONLY_IN = {
    "viser": ("ui", "benches"),
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
        return target is not None and target <= level
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
        ("ui/view.py", "from armlab.benches.motion.plan.state import Plan"),
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


def python_files():
    return [p for part in ("app", "tests", "benchmarks") for p in sorted((TOP / part).rglob("*.py"))]


def test_files_stay_small():
    served = (PACKAGE / "front" / "static").iterdir()
    files = [*python_files(), *served, *(PACKAGE / "benches").rglob("*.css")]
    long = [str(path.relative_to(TOP)) for path in files if len(path.read_text().splitlines()) > MOST_LINES]
    assert long == []


def test_private_parts_of_viser_are_touched_in_the_adapter_and_in_what_is_quicker_only():
    found = []
    for path in [*sorted((PACKAGE / "ui").rglob("*.py")), *sorted((PACKAGE / "benches").rglob("*.py"))]:
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
