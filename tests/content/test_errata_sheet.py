"""All errata on paper: what stands in it, in both formats, and where lessons name them."""

import re
from html.parser import HTMLParser

import pytest

from armlab.content.errata import errata, erratum
from armlab.content.errata_places import named_in, taught_in
from armlab.content.errata_sheet import FORMATS, sheet
from armlab.content.lessons import lessons
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


# --- where in the course


def test_lessons_that_name_an_erratum_are_found_with_the_step():
    places = named_in(lessons())
    (place,) = places["1.58"]
    assert (place.lesson, lessons()["error_dynamics"].title) == ("error_dynamics", place.title)
    assert "/erratum/1.58" in lessons()["error_dynamics"].steps[place.step].texts
    assert places.keys() <= errata().keys()


def test_every_erratum_is_named_by_a_lesson():
    named = named_in(lessons())
    assert [key for key in errata() if key not in named] == []


def test_no_lesson_names_an_erratum_by_its_bare_mark():
    assert not [each.key for each in lessons().lessons.values() if any("ERR-" in step.texts for step in each.steps)]


def test_a_lesson_that_names_it_twice_is_listed_once():
    assert [place.lesson for place in named_in(lessons())["6.145"]] == ["path_geometry"]


def test_other_lessons_on_its_topic_are_listed_besides():
    found = dict(taught_in(erratum("1.18"), lessons()))
    named = {place.lesson for place in named_in(lessons())["1.18"]}
    assert named
    assert not named & found.keys()
    assert all(set(lessons()[key].teaches) & set(erratum("1.18").rows) for key in found)
