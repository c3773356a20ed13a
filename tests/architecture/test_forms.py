"""What a control does goes with it, and what a field of a part is, is said once: nothing works round either."""

import ast

import pytest

from armlab.benches.control.loop.state import Loop
from armlab.session.fields import FieldPart
from armlab.session.state import part_types
from support.sources import PACKAGE, files_with, tree_of

KIT = {"ui/fields.py", "ui/form.py", "ui/markup.py", "ui/widgets.py"}
"""Where the name of a cell means something: it tells the page's script which control is which."""

MADE = {"Fields": 1, "fields": 0}
"""What makes markup that hands on the name of a cell, and which argument it hands it to."""


def around_forms(package):
    """Return every place outside the kit that looks at the name of a cell, or makes markup that sends by itself."""
    found = []
    paths = sorted(
        [
            *(package / "ui").rglob("*.py"),
            *(package / "window").rglob("*.py"),
            *(package / "benches").glob("*/*/ui/**/*.py"),
        ]
    )
    for path in files_with(paths, r"\bcell\b|\b[Ff]ields\(|data-chan=|\\[xuN0-7]"):
        file = path.relative_to(package).as_posix()
        if file in KIT:
            continue
        tree = tree_of(path)
        found += [f"{file}:{line} takes what controls send by itself" for line in takers(tree)]
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and "data-chan=" in node.value:
                found.append(f"{file}:{node.lineno} writes where a control sends to")
            if isinstance(node, ast.Compare) and any(map(_is_cell, [node.left, *node.comparators])):
                found.append(f"{file}:{node.lineno} compares the name of a cell")
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and _is_cell(node.func.value):
                found.append(f"{file}:{node.lineno} takes the name of a cell to pieces")
            if isinstance(node, ast.Match) and _is_cell(node.subject):
                found.append(f"{file}:{node.lineno} compares the name of a cell")
    return found


def _is_cell(node):
    return "cell" in (getattr(node, "id", ""), getattr(node, "attr", ""))


def takers(tree):
    """Yield the lines where a function gets the names of cells, whatever it calls them.

    Those are left out that only pass on what they are given, as a form does, and that look at nothing.
    """
    passing = {id(node.body) for node in ast.walk(tree) if isinstance(node, ast.Lambda) and len(node.args.args) == 1}
    for node in ast.walk(tree):
        name = getattr(node.func, "id", getattr(node.func, "attr", "")) if isinstance(node, ast.Call) else ""
        if name not in MADE:
            continue
        given = [*node.args[MADE[name] :][:1], *(each.value for each in node.keywords if each.arg == "on_input")]
        passes = id(node) in passing and all(isinstance(each, ast.Name) for each in given)
        looks = [each for each in given if not isinstance(each, ast.Lambda) or not _is_blind(each)]
        if looks and not passes:
            yield node.lineno


def _is_blind(function):
    return all(argument.arg.startswith("_") for argument in function.args.args)


def test_nothing_outside_the_kit_looks_at_the_name_of_a_cell():
    assert around_forms(PACKAGE) == []


@pytest.mark.parametrize(
    "line",
    [
        "def typed(cell, text):\n    return 1 if cell == 'go' else 2",
        "def typed(cell, text):\n    return cell.partition(' ')",
        "def typed(cell, text):\n    match cell:\n        case 'go':\n            return 1",
        "def typed(cell, text):\n    return {'go': 1}[cell] if cell in ('go',) else None",
        'MADE = f\'<i data-chan="{1}" data-cell="go">\'',
        "def build(gui, state, post):\n    gui.fields(lambda which, text: which == 'go')",
        "def build(gui, state, post):\n    def typed(name, text):\n        pass\n    return gui.fields(typed)",
        "class Page:\n    def __init__(self, gui):\n        self._fields = Fields(gui, self._typed)",
        "def build(gui, on_input):\n    return Fields(gui, on_input=partial(read, 3))",
        "def typed(mistake, text):\n    return 1 if mistake.cell == 'go' else 2",
    ],
)
def test_a_planted_way_round_is_found(line, tmp_path):
    (tmp_path / "ui").mkdir()
    page = tmp_path / "benches" / "robot" / "film" / "ui" / "page.py"
    page.parent.mkdir(parents=True)
    page.write_text(line, encoding="utf-8")
    assert around_forms(tmp_path)


OWN_JSON = {
    "control": "its runs and its target are read together with the arm",
    "display": "its JSON is a map whose keys are the switches of the picture, whichever there are",
    "ellipsoid": "its JSON is the name of a block alone, or a pair",
    "errata_practice": "its JSON is a map whose keys are errata, of those tasks that were begun",
    "former": "a whole state, as it was before a lesson",
    "joints": "joint values, and which are held, are read together with the arm and its limits",
    "language": "its JSON is the key of a language; one that is there no more is ignored",
    "lesson": "a student's way through lessons, which are files that change",
    "lines": "two lines in one list, read together with the arm",
    "notation": "whether the course notes are referred to is written only where they are",
    "own_lessons": "files of a person's own, of which the lessons are read again",
    "plan": "waypoints, moves and a recorded motion are read together with the arm",
    "point": "its JSON is a list of three coordinates, as links hold it",
    "preview": "a whole state, as it was before the preview",
    "robot": "an arm, by its key or as a whole table",
    "shelf": "whole states of other places",
    "target": "what counts of it is written only where that is less than the whole pose",
    "trainer": "answers to an exercise that follows from the arm",
    "unit_circle": "its JSON is an angle alone",
    "welcome": "its JSON is a word alone: whoever has a file has been here",
    "what_if": "a list of changes that are tried on the arm one after the other",
}
"""Parts that write or read their own JSON, and why."""


def own_json():
    """Return the keys of parts that declare no fields, or write or read them in a form of their own."""
    saved = (kind for kind in part_types() if kind.saved)
    return {kind.key for kind in saved if not issubclass(kind, FieldPart) or not is_declared(kind)}


def is_declared(part):
    """Return whether a part is written and read by its declared fields, and not by a method of its own."""
    return part.to_json is FieldPart.to_json and part.from_json.__func__ is FieldPart.from_json.__func__


def test_a_part_has_its_own_json_only_for_a_reason():
    assert own_json() == OWN_JSON.keys()


@pytest.mark.parametrize(
    ("name", "method"), [("to_json", lambda part: {}), ("from_json", classmethod(lambda part, data, robot: part()))]
)
def test_a_planted_json_is_found(name, method, monkeypatch):
    monkeypatch.setattr(Loop, name, method, raising=False)
    assert own_json() - OWN_JSON.keys() == {"loop"}
