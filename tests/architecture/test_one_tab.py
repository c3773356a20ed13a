"""What only one tab uses lies in that tab; the layers below the benches hold what several need."""

import pytest

from support.sources import PACKAGE, imports_of

BELOW = ("content", "session", "teaching", "ui")
"""The layers below the benches, without the mathematics, which is a library of its own."""

STAYS = {
    "content/write_table.py": "writes tables in all forms in which content/tables.py reads them",
}
"""Modules that one tab alone uses and that lie below it, and why."""


def of_one_tab(package):
    """Return the modules below the benches that only one tab imports, each with the tab.

    Those that nobody imports are found by folder.
    """
    modules = {dotted(package, path): path for path in package.rglob("*.py")}
    users = {}
    for module, path in modules.items():
        for name in modules.keys() & set(imports_of(path, types=True)):
            users.setdefault(name, set()).add(tab_of(module))
    return {
        modules[name].relative_to(package).as_posix(): min(tabs)
        for name, tabs in users.items()
        if name.split(".")[1:2] in ([layer] for layer in BELOW) and len(tabs) == 1 and tabs != {""}
    }


def dotted(package, path):
    parts = path.relative_to(package.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def tab_of(module):
    """Return the tab a module lies in; empty for one below or above the benches."""
    parts = module.split(".")
    return parts[2] if parts[1:2] == ["benches"] and len(parts) > 2 else ""


def test_what_only_one_tab_uses_lies_in_that_tab():
    assert of_one_tab(PACKAGE).keys() == STAYS.keys()


@pytest.mark.parametrize(
    ("users", "tab"),
    [
        ({"benches/arms/a/state.py": "from armlab.ui.lent import x"}, "arms"),
        (
            {
                "benches/arms/a/state.py": "from armlab.ui import lent",
                "benches/arms/b/ui/page.py": "import armlab.ui.lent",
            },
            "arms",
        ),
        ({"benches/arms/api.py": "def f():\n    from armlab.ui.lent import x"}, "arms"),
        ({"benches/arms/api.py": "import armlab.ui.lent", "benches/other/a/job.py": "import armlab.ui.lent"}, None),
        ({"benches/arms/api.py": "import armlab.ui.lent", "window/view.py": "from armlab.ui.lent import x"}, None),
        ({"benches/arms/api.py": "import armlab.ui.lent", "commands/go.py": "import armlab.ui.lent"}, None),
        ({"window/view.py": "import armlab.ui.lent"}, None),
        ({}, None),
    ],
)
def test_a_planted_module_of_one_tab_is_found(users, tab, tmp_path):
    for file, text in {"ui/lent.py": "x = 1", **users}.items():
        path = tmp_path / "armlab" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert of_one_tab(tmp_path / "armlab") == ({"ui/lent.py": tab} if tab else {})
