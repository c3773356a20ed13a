"""All errata on paper: what stands in it, in both formats."""

import re
from html.parser import HTMLParser

import pytest

from armlab.content.errata import errata
from armlab.content.errata_sheet import FORMATS, sheet
from armlab.errors import UnknownName
from armlab.kin.errata import run, trials
from armlab.ui.paper import in_language

LOW = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
"""Raised digits, written low."""


class Tags(HTMLParser):
    """The elements that are open, and what was wrong about them."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong = [], []

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


@pytest.mark.parametrize("format", FORMATS)
def test_every_erratum_is_in_the_list_once(format):
    text = sheet(format)
    found = re.findall(r'<section id="([^"]*)"' if format == "html" else r"^### (\S+) ", text, re.MULTILINE)
    assert found == list(errata())
    told = re.sub("</?span>", "", text)
    assert "118: 45 A (wrong if copied), 26 B (claims too much), 43 C (misprint), 4 H (history)." in told


def test_the_page_is_whole_and_needs_nothing_else():
    text, tags = sheet("html"), Tags()
    tags.feed(text)
    assert (tags.open, tags.wrong) == ([], [])
    assert not re.search(r"<(script|link|img)|src=|https?://(?!www\.w3\.org/1998/Math)", text)
    assert "@media print" in text


def test_in_another_language_its_heads_and_what_was_run_are_said_in_it():
    text = in_language(sheet("html", 1, ("5.58",)), "it")
    assert '<html lang="it">' in text
    assert '<b class="head">stampato</b>' in text
    assert re.search(r'<p class="ran">Stampato \S+ m, corretto \S+ m: ', text)


def test_residuals_are_those_of_the_points_of_the_seed():
    text = sheet("markdown", 7, ("5.58",))
    found = run(trials()["5.58"], 7)
    said = re.search(r"Printed (\S+) m, correct (\S+)·10⁻(\S+) m: largest difference", text)
    assert float(said[1]) == pytest.approx(found.worst_printed, rel=0.05)
    assert float(f"{said[2]}e-{said[3].translate(LOW)}") == pytest.approx(found.worst_correct, rel=0.05)
    assert "(seed 7)" in text
    assert "## 5 Differential kinematics" in text
    assert text != sheet("markdown", 8, ("5.58",))


def test_a_form_without_a_value_and_what_cannot_be_run_are_said():
    text = sheet("markdown", 1, ("5.113", "1.37"))
    assert "Printed no value, correct" in text
    assert "Not run: a misprint" in text


def test_another_format_is_refused():
    with pytest.raises(UnknownName, match="format: unknown name 'pdf'"):
        sheet("pdf")
