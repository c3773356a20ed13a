"""Elements: what is typed never becomes markup, whatever it is put into."""

from html.parser import HTMLParser

import numpy as np
import pytest

from armlab.content.as_written import AsWritten
from armlab.ui.html import Markup, classes, joined, styles, tag

LETTERS = [
    *list("<>&\"'/=! \n\ta-;#"),
    "</b>",
    "<script>",
    "<!--",
    "]]>",
    "&amp;",
    "&#34;",
    "javascript:",
    "é",
    "\u2028",
]


class Reader(HTMLParser):
    """Reads elements, attributes and texts as a browser does."""

    def __init__(self, markup):
        super().__init__()
        self.elements, self.texts = [], []
        self.feed(markup)
        self.close()

    def handle_starttag(self, name, attributes):
        self.elements.append((name, dict(attributes)))

    def handle_data(self, data):
        self.texts.append(data)


def test_a_text_that_stays_as_it_was_written_says_so():
    stays = AsWritten("a < b")
    assert tag("b.x", stays, title="c") == '<b class="x" translate="no" title="c">a &lt; b</b>'
    assert tag("p", "c ", stays) == '<p>c <span translate="no">a &lt; b</span></p>'
    assert tag("p", title=stays) == '<p title="a &lt; b"></p>'


def test_what_is_typed_is_text_and_the_value_of_an_attribute_and_nothing_else():
    rng = np.random.default_rng(4)
    for _ in range(300):
        text, value = ("".join(rng.choice(LETTERS, rng.integers(1, 12))) for _ in range(2))
        read = Reader(tag("p.dim", text, tag("b", [text, None, (text,)]), title=value))
        assert [name for name, _ in read.elements] == ["p", "b"]
        assert read.elements[0][1] == {"class": "dim", "title": value}
        assert "".join(read.texts) == 3 * text


def test_markup_stands_as_it_is_and_once():
    inner = tag("i", "a & b")
    assert tag("p", inner) == "<p><i>a &amp; b</i></p>"
    assert joined(joined(inner), [inner]) == inner + inner
    assert joined("a", None, ["<", inner], between=" · ") == f"a · &lt; · {inner}"
    assert joined("a", "b", between=" < ") == "a &lt; b"
    assert isinstance(joined(), Markup)
    assert joined() == ""


def test_markup_is_no_value_of_an_attribute():
    with pytest.raises(TypeError, match=r"title: expected a text, got markup Markup\('<b>'\)"):
        tag("p", title=Markup("<b>"))


def test_attributes_are_there_or_not():
    made = tag("input.field", value="", disabled=True, hidden=False, title=None, data_most=3, class_x="y", for_="z")
    assert made == '<input class="field" value="" disabled data-most="3" class-x="y" for="z">'
    assert tag("br") == "<br>"
    assert tag("span") == "<span></span>"
    assert classes("td", zero=True, lit=False) == "td.zero"


@pytest.mark.parametrize("kind", ["", "div class", "div.", "div><b", "1div", "div.a b", ".row", 'p.x"y'])
def test_a_kind_that_is_no_element_is_refused(kind):
    with pytest.raises(ValueError, match="expected an element and its classes"):
        tag(kind)


def test_a_rule_of_style_cannot_end_its_element():
    assert styles([".a>b{x:1}", ".c{y:'2'}"]) == "<style>.a>b{x:1}.c{y:'2'}</style>"
    for rule in ("</style><script>", "<!--", "</"):
        with pytest.raises(ValueError, match="expected rules of a style sheet"):
            styles([rule])
