"""What is said of a pasted table, in the languages of the lab."""

import ast
import re

import pytest

from armlab.content.languages import keys
from armlab.content.robots import catalogue
from armlab.session.edits import PasteTable
from armlab.ui.speech import speech_in
from support.bare_gui import BarePage
from support.pasted import HEAD, what_is_said_of_pasted_tables
from support.saying import shown_on
from support.sources import TOP

SAID = list(what_is_said_of_pasted_tables())
OTHERS = keys()[1:]
NAMES = """
    siciliano craig khalil denavit hartenberg csv markdown latex xml urdf link standard
    theta alpha sigma offset type joint modified begin end deg rad file
"""
"""Words that are the same in other languages: names, and words as they stand in tables and programs."""


def sentences(tree):
    """Yield the texts of code that are sentences, as patterns, without docstrings and patterns."""
    aside = {id(node) for node in ast.walk(tree) if isinstance(node, ast.Expr) for node in ast.walk(node)}
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and ast.unparse(call.func.value) == "re":
            aside |= {id(node) for node in ast.walk(call)}
    for node in ast.walk(tree):
        if id(node) in aside or not isinstance(node, ast.JoinedStr | ast.Constant):
            continue
        parts = node.values if isinstance(node, ast.JoinedStr) else [node]
        aside |= {id(part) for part in parts}
        texts = [str(part.value) if isinstance(part, ast.Constant) else "" for part in parts]
        written = " ".join(texts)
        if len(re.findall(r"[a-z]{2,}", written)) > 2 and not re.search(r"\||\(\?", written):
            yield ".*".join(map(re.escape, texts))


def test_each_sentence_about_pasted_tables_is_said_of_one_of_the_examples():
    said = "\n".join(told for _, told in SAID)
    files = [*(TOP / "app/armlab/content").glob("table_*.py"), TOP / "app/armlab/content/tables.py"]
    found = {sentence for file in files for sentence in sentences(ast.parse(file.read_text(encoding="utf-8")))}
    unsaid = [sentence for sentence in sorted(found) if not re.search(sentence, said)]
    assert len(found) > 45
    assert [sentence for sentence in unsaid if not sentence.startswith("order:")] == [], "only programs give an order"


@pytest.mark.parametrize("language", OTHERS)
def test_what_is_said_of_pasted_tables_has_no_english_words(language):
    speech, left = speech_in(language), {}
    for text, told in SAID:
        words = [set(re.findall(r"\b[^\W\d_]{3,}\b", each.lower())) for each in (told, speech.text(told), text)]
        if english := words[0] & words[1] - words[2] - set(NAMES.split()):
            left[told] = english
    assert left == {}


def test_each_note_on_a_pasted_table_is_a_line_of_its_own():
    page = BarePage("table", catalogue()["planar_2r"])
    page._post(PasteTable(f"Table of an arm, min, max\n{HEAD[:-1]},min,max\n0.3,1.57,0,q1,-1,1"))
    page.show()
    said = "".join(map(speech_in("it").markup, shown_on(page)))
    for note in (
        "Letta come standard (Siciliano): se il tuo libro è quello di Craig, scegli l&#39;altra convenzione",
        "Colonne non lette: min, max.</p>",
        "Gli angoli arrotondati sono letti come multipli di un quarto di giro: 1.57 (π/2).</p>",
    ):
        assert f'<p class="dim">{note}' in said
