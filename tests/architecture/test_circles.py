"""No module needs another that needs it, not even for types or later: each can be read after those it names."""

import graphlib

import pytest

from support.sources import PACKAGE, imports_of


def needs(package):
    """Return which modules each module of a package imports: to run, for types, or inside a function."""
    modules = {dotted(package, path): path for path in package.rglob("*.py")}
    found = {}
    for module, path in modules.items():
        named = set(imports_of(path, types=True))
        # `from a.b import c` names the module a.b.c where there is one, and a.b otherwise.
        whole = {name.rpartition(".")[0] for name in named if name in modules}
        found[module] = {name for name in named if name in modules and name != module} - whole
    return found


def dotted(package, path):
    parts = path.relative_to(package.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def circle(graph):
    """Return a circle of modules; empty when there is none."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return []


def test_there_is_no_circle():
    assert circle(needs(PACKAGE)) == []


@pytest.mark.parametrize(
    "line",
    [
        "from armlab.b import x",
        "import armlab.b",
        "from typing import TYPE_CHECKING\n\nif TYPE_CHECKING:\n    from armlab.b import x",
        "def f():\n    from armlab.b import x",
        "class C:\n    async def f(self):\n        import armlab.b",
    ],
)
def test_a_planted_circle_is_found(line, tmp_path):
    package = tmp_path / "armlab"
    package.mkdir()
    (package / "a.py").write_text(f"{line}\ny = 1\n", encoding="utf-8")
    (package / "b.py").write_text("from armlab.a import y\nx = 1\n", encoding="utf-8")
    assert set(circle(needs(package))) == {"armlab.a", "armlab.b"}
