"""Words of the scripts of the page: all are known, and translated."""

import re

import pytest

from armlab.content.languages import keys
from armlab.content.stand_ins import placeholders
from armlab.ui.speech import speech_in
from armlab.window.script_words import SCRIPT_WORDS
from support.sources import PACKAGE

IN_SCRIPT = re.compile(
    r"""(?<=[`'>}])(?!\.)([^`'"<>=()\[\];$#\n]*[A-Za-z]{2,} [a-z]{2,}[^`'"<>=()\[\];$#\n]*)(?=[`'<$])"""
)
"""A text in a script that has words."""

READ_ALOUD = re.compile(
    r"""\b(?:aria-label|title|placeholder|alt)="(\w[^"$]*)"|\baria(?:Label|ValueText)[:=] *['"](\w[^'"]*)"""
)
"""A text in a script, of one word or more, that is shown under the pointer or read aloud as it stands."""

NOT_SAID = {"use strict", "nothing was copied", "The lab is starting …"}
"""Texts in scripts that no person reads, or before the language is known."""


def test_the_texts_of_scripts_stand_in_scripts():
    scripts = "".join(file.read_text(encoding="utf-8") for file in (PACKAGE / "front/static").glob("*.js"))
    assert [text for text in SCRIPT_WORDS if text not in scripts] == []


def test_scripts_say_no_words_but_those_that_are_translated():
    for file in (PACKAGE / "front/static").glob("*.js"):
        code = re.sub(r"^\s*//.*|\s// .*", "", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
        unknown = {said for said in IN_SCRIPT.findall(code) if said not in SCRIPT_WORDS}
        assert unknown <= NOT_SAID, file.name
        assert READ_ALOUD.findall(code) == [], file.name


@pytest.mark.parametrize("language", keys()[1:])
def test_what_scripts_say_of_something_is_translated_with_a_place_for_its_name(language):
    for text in SCRIPT_WORDS:
        said = speech_in(language).text(text)
        assert said != text
        assert placeholders(said) == placeholders(text)
