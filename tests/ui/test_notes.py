"""What only those see who have the course notes: off at first, and nothing of it is left where it is off."""

import ast
import re
from pathlib import Path

import pytest

import armlab
from armlab.content.notes import for_reader
from armlab.session.bench import benches
from armlab.session.parts.notation import Notation
from support.student import run, student

BENCHES = Path(armlab.__file__).parent / "benches"
REFERENCE = re.compile(
    r"\b[Nn]otes,? (\d|definition|section)|\(\d\.\d{2,3}[–)]|\bthe notes\b(?! are)|\b[Ss]ections? \d"
    r"|^\d(\.\d+)+: |(?<![\d.,·−-])[1-7]\.\d{1,3} (cannot|does|do|holds?|says?|gives?|prints?|names?)\b"
)
"""An equation number, alone before a title or as the subject of a sentence, or a word on what the notes say."""

ELSEWHERE = ("lessons", "help")
"""Tabs where "notes" may be meant in another way."""


def literals(path):
    """Yield line and text of each text of a file that is no docstring, nor what a page is about, for the search."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    aside = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    of_search = [node.value for node in ast.walk(tree) if isinstance(node, ast.keyword) and node.arg == "about"]
    aside |= {id(each) for node in of_search for each in ast.walk(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in aside:
            yield node.lineno, node.value


@pytest.mark.parametrize(
    ("text", "without", "whole"),
    [
        ("no marks", "no marks", "no marks"),
        ("a force⟦ (5.163)⟧, b⟦ (5.1)⟧", "a force, b", "a force (5.163), b (5.1)"),
        ('<div title="⟦Notes 5.152⟧">x</div>', "<div>x</div>", '<div title="Notes 5.152">x</div>'),
        ('<p class="dim">⟦Notes\nsay⟧</p>y', "y", '<p class="dim">Notes\nsay</p>y'),
        ("⟦unpaired", "⟦unpaired", "⟦unpaired"),
    ],
)
def test_what_is_marked_is_left_out_or_loses_its_marks(text, without, whole):
    assert (for_reader(text), for_reader(text, has_notes=True)) == (without, whole)


def test_every_reference_in_a_panel_is_marked():
    found = [
        f"{path.relative_to(BENCHES)}:{line}: {text}"
        for path in sorted(BENCHES.rglob("*.py"))
        if path.relative_to(BENCHES).parts[0] not in ELSEWHERE
        for line, text in literals(path)
        if REFERENCE.search(re.sub("⟦.*?(⟧|$)", "", text, flags=re.DOTALL))
    ]
    assert not found, "\n".join(found)


def test_what_examples_say_without_the_notes_is_whole():
    texts = [
        for_reader(text)
        for bench in benches().values()
        if bench.key != "errata"
        for example in bench.examples.values()
        for text in (example.title, getattr(example, "says", ""))
    ]
    assert len(texts) > 500
    assert [text for text in texts if REFERENCE.search(text) or re.search(r" [.,;:)]|  |\( ", text)] == []


def test_the_switch_shows_and_hides_them(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("statics")
        await browser.until(lambda: "Virtual work" in browser.html())
        assert "notes 5.160" not in browser.html()
        assert "⟦" not in browser.html()
        await browser.open("statics", "picture")
        await browser.press("on")
        await browser.until(lambda: "notes 5.160" in browser.html())
        assert "⟦" not in browser.html()
        await browser.press("off")
        await browser.until(lambda: "notes 5.160" not in browser.html())
        await browser.close()

    assert Notation().notes == "off"
    run(main())
