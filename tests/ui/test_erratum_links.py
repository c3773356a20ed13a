"""Links from lessons to errata: buttons in the text, plain words wherever the right answer is still to be found."""

import pytest

from armlab.teaching.errata_links import LookUp
from armlab.ui.erratum_links import with_links, without_links
from armlab.ui.html import Markup
from support.forms import BareForm, asked
from support.lab import running_lab
from support.own_lessons import ARM, in_lesson, lesson, notes, piece, write
from support.student import run

TEXT = '<p>The notes print <a href="/erratum/5.58">one half in <b>5.58</b></a>, and <a href="/x">more</a>.</p>'

BODY = """
## Rates

The notes err in [5.58](/erratum/5.58).

```question
kind = "choice"
text = "Is [5.56](/erratum/5.56) right?"
options = ["yes", "no, see [5.58](/erratum/5.58)"]
answer = 2
```

```reveal
It is [the factor](/erratum/5.58).
```
"""


def test_a_link_becomes_a_button_that_looks_the_erratum_up():
    form = BareForm()
    form.show(with_links(form, Markup(TEXT)))
    shown = str(form.fields.content)
    assert "/erratum/" not in shown
    assert "one half in <b>5.58</b></button>" in shown
    assert '<a href="/x">more</a>' in shown
    assert asked(lambda form: with_links(form, Markup(TEXT)), "erratum 5.58") == (LookUp("5.58"),)


def test_a_text_without_links_keeps_their_words():
    assert without_links(TEXT) == '<p>The notes print one half in <b>5.58</b>, and <a href="/x">more</a>.</p>'


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    with running_lab(lessons=write(tmp_path_factory.mktemp("lessons"), named=lesson(BODY, ARM))) as address:
        yield address


def test_a_lesson_opens_the_page_of_the_errata_beside_it(url):
    async def main():
        browser = await in_lesson(url, "named")
        text = piece(browser, "lesson-text")
        assert 'data-cell="erratum 5.58"' in text
        assert "It is" not in text
        question = piece(browser, 'class="ask"')
        assert "Is 5.56 right?" in question
        assert "no, see 5.58" in question
        assert "erratum" not in question
        await browser.press("erratum 5.58")
        await browser.until(lambda: notes(browser).get("tab") == "Lessons")
        await browser.open("errata")
        await browser.until(lambda: "<h3>Section 5.1.1, after 5.58" in browser.html())
        assert "lesson-text" in browser.html()
        await browser.close()

    run(main())
