"""Text becomes markup in one place, where it is escaped."""

import ast
import re

import pytest

from support.sources import PACKAGE, files_with, tree_of

TAG = re.compile(r"</?[a-zA-Z][a-zA-Z0-9]*(\s[^<>]*)?/?>|<[a-zA-Z][a-zA-Z0-9]*\s[^<>]*=")
ENTITY = re.compile(r"&(?:[a-z]+|#\w+);")

MAY_WRITE = r"</?[a-zA-Z\"']|&[a-z#\"']|Markup|\\[xuN0-7]"
"""Pattern of the files that can break the rule: a text may be written in two, and a bracket as an escape."""

TAKEN_AS_IT_IS = {
    "benches/lessons/errata/ui/texts.py": "texts of errata, whose reader lets only known elements pass",
    "ui/html.py": "makes elements of texts, which it escapes",
    "ui/format.py": "MathML that latex2mathml makes of a formula",
    "ui/paper.py": "texts of guides, lessons and formulas, whose readers let only known elements pass",
    "benches/view/share/ui/qr.py": "an SVG picture that segno makes of a link",
    "ui/asking.py": "questions and verdicts of lessons, whose reader lets only known elements pass",
    "ui/erratum_links.py": "the text of lessons, in which links become buttons",
    "window/lesson/text.py": "the text of lessons, whose reader lets only known elements pass",
}
"""Modules that take a text for markup, and why it is."""

WRITES = {
    "content/errata_sheet.py": "a document of its own, for a printer",
    "content/markdown.py": "elements of texts that it reads",
    "front/room.py": "the question for the code of a room, before there is a lab",
    "ui/html.py": "elements of texts, which it escapes",
}
"""Modules that write markup, and which."""

LOOKS = {
    "content/errata_task.py",
    "content/formula_room.py",
    "front/page.py",
    "teaching/plain_text.py",
    "ui/erratum_links.py",
    "window/lesson/text.py",
    "ui/recording.py",
}
"""Modules that look for an element in a page or text they are given; patterns of `re` with a group are known by it."""


def written_by_hand(package):
    """Return every place that writes markup in a text, or takes a text for markup.

    The mathematics knows no markup: its formulas have places such as ``<x>``.
    """
    found = []
    paths = sorted(set(package.rglob("*.py")) - set((package / "kin").rglob("*.py")))
    for path in files_with(paths, MAY_WRITE):
        file = path.relative_to(package).as_posix()
        tree = tree_of(path)
        said = _docstrings(tree)
        for node in ast.walk(tree):
            text = node.value if isinstance(node, ast.Constant) and node not in said else None
            if isinstance(text, str) and not {file} & (WRITES.keys() | LOOKS) and _is_markup(text):
                found.append(f"{file}:{node.lineno} writes markup in a text")
            if isinstance(node, ast.Call) and _takes(node) and file not in TAKEN_AS_IT_IS:
                found.append(f"{file}:{node.lineno} takes a text for markup")
    return found


def _is_markup(text):
    return "(?" not in text and bool(TAG.search(text) or ENTITY.search(text))


def _takes(node):
    """Return whether a text is taken for markup; markup without anything in it is none."""
    name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
    return name == "Markup" and bool(node.args)


def _docstrings(tree):
    """Return the constants that stand by themselves: they are read, not shown."""
    return {
        node.value for node in ast.walk(tree) if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }


def test_text_becomes_markup_in_one_place():
    assert written_by_hand(PACKAGE) == []


def test_modules_that_write_markup_or_look_for_it_still_do():
    for file in (*WRITES, *LOOKS):
        texts = [node.value for node in ast.walk(tree_of(PACKAGE / file)) if isinstance(node, ast.Constant)]
        assert any(isinstance(text, str) and "<" in text for text in texts), file


def test_modules_that_take_a_text_for_markup_still_do():
    for file in TAKEN_AS_IT_IS:
        calls = [node for node in ast.walk(tree_of(PACKAGE / file)) if isinstance(node, ast.Call)]
        assert any("Markup" in ast.unparse(node) for node in calls), file


@pytest.mark.parametrize(
    "line",
    [
        "MADE = '<b>1</b>'",
        "def made(text):\n    return f'<p class=\"dim\">{text}</p>'",
        "def made(text):\n    return '</table>'",
        "def made(text):\n    return f'<i hidden data-x=\"{text}\">'",
        "SPACE = 'a&ensp;b'",
        "def made(text):\n    return Markup(text)",
        "def made(text):\n    return html.Markup(text)",
    ],
)
@pytest.mark.parametrize("file", ["benches/robot/film/ui/page.py", "benches/robot/film/state.py", "session/amounts.py"])
def test_planted_markup_is_found(file, line, tmp_path):
    page = tmp_path / file
    page.parent.mkdir(parents=True)
    page.write_text(line, encoding="utf-8")
    assert written_by_hand(tmp_path)
