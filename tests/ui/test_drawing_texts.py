"""Drawings of lessons in other languages."""

import base64
import re

import pytest

from armlab.content.lessons import lesson
from armlab.content.po import Message
from armlab.content.words import Words
from armlab.ui.speech import Speech, speech_in
from support.sources import TOP

LESSONS = sorted(file.stem for file in (TOP / "lessons/it").glob("*.po"))
PICTURE = re.compile(r'svg\+xml;base64,([^"]+)')


def drawing(said, text, alt="The arm"):
    svg = f'<svg><text x="1">{text}</text><text>q<tspan>1</tspan></text></svg>'
    address = f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"
    return said(f'<p><img src="{address}" alt="{alt}"/></p>')


def test_the_words_in_a_drawing_are_said_where_its_description_is():
    known = Speech(Words([Message("The arm", "Il braccio"), Message("hand & {0}", "mano & {0}")]))
    assert drawing(known.markup, "hand &amp; 2") == drawing(str, "mano &amp; 2", "Il braccio")
    assert drawing(known.markup, "hand &amp; 2", "Robot") == drawing(str, "hand &amp; 2", "Robot")


@pytest.mark.parametrize("key", LESSONS)
def test_no_drawing_of_a_translated_lesson_has_english_words(key):
    for html in [lesson(key).intro_html, *(step.html for step in lesson(key).steps)]:
        said = [base64.b64decode(each).decode() for each in PICTURE.findall(speech_in("it").markup(html))]
        assert not re.search(r">[^<]*\b(hand|elbow|axis|turns|slides)\b", "".join(said))
