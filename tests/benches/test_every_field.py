"""Every field of every page, filled with what nobody should type: a sentence at the field, and all stays as it was.

The sentence is there in every language of the lab.

A field stands for all of its kind, whose names differ by a number. Fields that come only when something is pressed are
looked for one press away.
"""

import dataclasses
import logging
import re
from html import unescape

import numpy as np
import pytest

from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue
from armlab.content.words import Words
from armlab.session.pages import pages
from support.bare_gui import BarePage, content
from support.student import run

NEVER = {
    "letters": "abc",
    "not a number": "nan",
    "infinite": "-inf",
    "too large for a number": "1e400",
    "a quotient by zero": "1/0",
    "a power without end": "2^9999",
    "digits without end": "9" * 5000,
    "letters without end": "x" * 5000,
    "markup": "<b>x</b>",
    "mass": "5 kg",
    "open brackets": "((((1",
    "no text": "\x00\u202e",
}
"""What no field for numbers takes."""

PERHAPS = {
    "nothing": "",
    "blanks": "  ",
    "comma": "1,5",
    "minus zero": "-0",
    "zero": "0",
    "huge": "1e9",
    "huge and negative": "-1e9",
    "tiny": "1e-12",
    "two": "1 0",
    "many": "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15",
    "length": "3 m",
    "angle": "10 deg",
    "equal rows": "0 0\n0 0",
}
"""What some fields take: then as numbers that can be worked with."""

TEXTS = {
    "author title",
    "control name",
    "errata query",
    "identities left",
    "identities right",
    "frame_chain name",
    "author ask-text",
    "author load-file",
    "author paste-file",
    "lessons lesson-load",
    "motion_files read-motion",
    "newton_1d f",
    "products typed",
    "robot name",
    "table load",
    "table name",
    "table paste",
}
"""Fields for texts, formulas and files."""

SENTENCE = re.compile(r'<p class="no" role="alert">✕ (.*?)</p>', re.S)

LONGEST_SENTENCE = 300

MOST_PRESSES = 60
"""Controls of a page that are pressed to see what comes; only the lists of lessons and of errata have more."""


class Untold(dict):
    """The words of each language, and those of the texts that it has not."""

    def __init__(self):
        super().__init__()
        self.missing = []
        self.update({key: Words(messages(key), self.missing.append) for key in keys()[1:]})

    def of(self, sentence):
        """Return what is missing of a sentence in any language."""
        self.missing.clear()
        for words in self.values():
            words(sentence)
        return list(self.missing)


@pytest.fixture(scope="module")
def untold():
    """The words of all languages."""
    return Untold()


class Faults(logging.Handler):
    """Keeps what is logged as a fault."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.said = []

    def emit(self, record):
        self.said.append(record.getMessage())


@pytest.fixture
def faults():
    """What the lab has complained about."""
    handler, root = Faults(), logging.getLogger("armlab")
    root.addHandler(handler)
    yield handler.said
    root.removeHandler(handler)


def unreal(value, path=""):
    """Yield where numbers of a part are not finite."""
    if isinstance(value, float):
        if not np.isfinite(value):
            yield path
    elif isinstance(value, np.ndarray):
        if value.dtype.kind == "f" and not np.isfinite(value).all():
            yield path
    elif isinstance(value, (tuple, list)):
        for k, each in enumerate(value):
            yield from unreal(each, f"{path}.{k}")
    elif isinstance(value, dict):
        for k, each in value.items():
            yield from unreal(each, f"{path}.{k}")
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            # Tables of arms have no limit of speed where nothing is known.
            if field.name not in ("arm", "robot"):
                yield from unreal(getattr(value, field.name), f"{path}.{field.name}")


def changed(before, after):
    """Return where numbers of the parts that have changed are not finite, and were before."""
    parts = [(part, before[type(part)]) for part in after if part is not before[type(part)]]
    return {at for new, old in parts for at in set(unreal(new, new.key)) - set(unreal(old, new.key))}


def fields_of(page):
    """Return the first field of each kind."""
    found = {}
    for fields, cell, _ in page.controls("input", "textarea"):
        found.setdefault(re.sub(r"\d+", "#", cell), (fields, cell))
    return found


def presses(page):
    """Return what can be pressed or chosen, by cell and text."""
    buttons = [(cell, "") for _, cell, _ in page.controls("button")]
    options = [(cell, unescape(value)) for _, cell, inside in page.controls("select") for value in _values(inside)]
    return (buttons + options)[:MOST_PRESSES]


def _values(inside):
    return re.findall(r'<option value="([^"]*)"', inside)


def faults_of(page, key, kind, faults, untold):
    """Return what is wrong with the answers of a field."""
    before, found = page.session.state, []
    for of, text in {**NEVER, **PERHAPS}.items():
        fields, cell = fields_of(page)[kind]
        page.session.notice = None
        page.send(fields, cell, text)
        after, shown = page.session.state, content(fields)
        said = [unescape(each) for each in SENTENCE.findall(shown)]
        marked = re.search(rf'<(?:input|textarea)[^>]* aria-invalid="true"[^>]* data-cell="{re.escape(cell)}"', shown)
        refused = bool(said and marked)
        problems = [f"logs {faults}"] * bool(faults)
        problems += [f"shows {said} and has changed"] * (refused and after is not before)
        problems += [f"is no number: {changed(before, after)}"] * bool(changed(before, after))
        problems += ["takes it"] * (of in NEVER and not refused and f"{key} {kind}" not in TEXTS)
        problems += [f"tells {page.session.notice}"] * (page.session.notice is not None and not refused)
        problems += ["shows markup that was typed"] * ("<b>x</b>" in shown)
        for sentence in said if refused else ():
            problems += [f"does not say where: {sentence}"] * (": " not in sentence or sentence.startswith("expected"))
            problems += [f"says too much: {sentence}"] * (len(sentence) > LONGEST_SENTENCE)
            problems += [f"is not in every language: {text}" for text in untold.of(sentence)]
        found += [f"{cell}, {of}: {problem}" for problem in problems]
        faults.clear()
        if after is not before:
            page.session.state = before
            page.show()
    return found


@pytest.mark.parametrize("key", pages())
def test_what_nobody_should_type_is_refused_at_its_field(key, faults, untold):
    async def main():
        page = BarePage(key, catalogue()["puma560"])
        start, seen, wrong = page.session.state, set(), []
        for cell, text in [("", ""), *presses(page)]:
            page.session.state = start
            page.show()
            pressed = next((fields for fields, at, _ in page.controls("button", "select") if at == cell), None)
            if pressed is not None:
                page.send(pressed, cell, text)
            for kind in [each for each in fields_of(page) if each not in seen]:
                seen.add(kind)
                wrong += faults_of(page, key, kind, faults, untold)
        return wrong

    assert run(main()) == []
