"""Text of lessons becomes HTML that can do no harm."""

import re
from html.parser import HTMLParser

import pytest

from armlab.content.markdown import Extras, TextError, formula, html_of, is_allowed, to_html, tokens_of
from armlab.errors import ContentError, InputError

TEXT_TAGS = {
    *("p", "h1", "h2", "h3", "h4", "h5", "h6", "em", "strong", "a", "ul", "ol", "li", "code", "pre", "blockquote"),
    *("hr", "br", "table", "thead", "tbody", "tr", "th", "td", "span", "div"),
}
MATH_TAGS = {
    *("math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup"),
    *("munder", "mover", "munderover", "mtable", "mtr", "mtd", "mstyle"),
}


class Elements(HTMLParser):
    """Collects what a browser would make of a text."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))


def assert_inert(html):
    """Only elements of text and mathematics, no handlers, no style, no addresses but allowed ones."""
    for tag, attributes in Elements(html).found:
        assert tag in TEXT_TAGS | MATH_TAGS, html
        for name, value in attributes.items():
            assert not name.startswith("on"), html
            assert name not in ("src", "srcset", "style", "srcdoc", "formaction", "xlink:href"), html
            assert name != "href" or re.match(r"https?://|(?!//|[a-zA-Z][\w+.-]*:)", value), html


ATTACKS = [
    "<script>alert(1)</script>",
    "text <img src=x onerror=alert(1)> text",
    "<b onclick=alert(1)>x</b>",
    "<!-- --><svg/onload=alert(1)>",
    "<iframe src=https://a.example></iframe>",
    "[x](javascript:alert(1))",
    "[x](JaVaScRiPt:alert(1))",
    "[x](java&#115;cript:alert(1))",
    "[x](\x01javascript:alert(1))",
    "[x](data:text/html,<script>alert(1)</script>)",
    "[x](vbscript:x)",
    "[x](//elsewhere.example)",
    "[x](/\\elsewhere.example)",
    "<javascript:alert(1)>",
    "[x]\n\n[x]: javascript:alert(1)",
    '[x](https://a.example "t\\" onmouseover=alert(1)")',
    '[x](<https://a.example/" onerror="alert(1)>)',
    "![x](javascript:alert(1))",
    '![x](y "z" onerror=alert(1))',
    "```html\n<script>alert(1)</script>\n```",
    '``` " onclick="alert(1)\nx\n```',
    "`<script>`",
    "| <script> |\n|---|\n| <img src=x onerror=y> |",
    "&lt;script&gt;alert(1)&lt;/script&gt;",
]
FORMULA_ATTACKS = [
    r"\text{<img src=x onerror=alert(1)>}",
    r"\text{</mtext></math><script>alert(1)</script>}",
    r"\text{<!--}",
    r"\text{&lt;script&gt;}",
    r"\mathrm{<script>}",
    r"\href{javascript:alert(1)}{x}",
    r"\style{background:url(x)}{y}",
    r"\class{a}{b}",
    r'\color{" onclick="alert(1)}{x}',
    r'\hspace{1em" onclick="x}',
    r"\unicode{x3c}script\unicode{x3e}",
    r"<script>alert(1)</script>",
]


@pytest.mark.parametrize("text", ATTACKS)
def test_no_markup_comes_through(text):
    assert_inert(to_html(text, "f.md"))


@pytest.mark.parametrize("latex", FORMULA_ATTACKS)
def test_no_markup_comes_through_a_formula(latex):
    try:
        html = to_html(f"${latex}$", "f.md")
    except ContentError as error:
        html = ""
        said = str(error)
    else:
        said = "the formula"
    assert "the formula" in said
    assert_inert(html)
    assert all(tag in TEXT_TAGS | MATH_TAGS for tag, _ in Elements(html).found)


@pytest.mark.parametrize("inside", ["<script>x</script>", "<mrow><img src='x'/></mrow>", "<mtable><b>x</b></mtable>"])
def test_no_other_element_comes_through_whatever_the_converter_makes(inside, monkeypatch):
    monkeypatch.setattr("latex2mathml.converter.convert", lambda latex, display: f"<math><mrow>{inside}</mrow></math>")
    with pytest.raises(InputError, match=r"may not contain (script|img|b)"):
        formula("x")


def test_the_judge_of_these_tests_sees_harm():
    for html in ("<script>x</script>", "<b onclick=x>", '<a href="javascript:x">', "<img>", '<p style="x">'):
        with pytest.raises(AssertionError):
            assert_inert(html)


def test_raw_html_is_shown_as_text():
    assert to_html("<script>alert(1)</script>", "f.md") == "<p>&lt;script&gt;alert(1)&lt;/script&gt;</p>\n"


def test_text_of_a_formula_is_escaped():
    assert "<mtext>&lt;img src=x&gt;</mtext>" in to_html(r"$\text{<img src=x>}$", "f.md").replace("\u00a0", " ")


@pytest.mark.parametrize(
    ("address", "allowed"),
    [
        ("https://example.org/a?b#c", True),
        ("http://example.org", True),
        ("/puma560", True),
        ("other_lesson", True),
        ("#step", True),
        ("javascript:alert(1)", False),
        ("mailto:a@example.org", False),
        ("file:///x", False),
        ("//example.org", False),
        ("/\\example.org", False),
        ("\\\\example.org", False),
        ("https:", False),
        ("http://[", False),
    ],
)
def test_links_go_to_the_web_or_the_lab(address, allowed):
    assert is_allowed(address) is allowed


def test_the_web_opens_beside_the_lab():
    html = to_html("[a](https://example.org) [b](/puma560)", "f.md")
    assert '<a href="https://example.org" target="_blank" rel="noopener noreferrer">a</a>' in html
    assert '<a href="/puma560">b</a>' in html


def test_markdown_with_formulas_and_tables():
    html = to_html("**bold** $q_1$\n\n$$\n\\frac{a}{b}\n$$\n\n| a |\n|---|\n| $x$ |", "f.md")
    assert "<strong>bold</strong>" in html
    assert html.count("<math") == 3
    assert "<msub><mi>q</mi><mn>1</mn></msub>" in html
    assert 'display="block"' in html
    assert "<td>" in html


@pytest.mark.parametrize(
    ("latex", "inside"),
    [
        (r"\theta_1 \le \frac{\pi}{2}", "<mo>≤</mo>"),
        (r"\begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix}", "<mtr><mtd><mn>3</mn></mtd>"),
        (r"a < b \& c", "<mo>&lt;</mo>"),
        (r"\sqrt{p_x^2 + p_y^2}", "<msubsup>"),
        (r"{}^{0}\mathbf{p}_e", "<msup>"),
        (r"\dot{q}", "<mover>"),
    ],
)
def test_formulas(latex, inside):
    assert inside in formula(latex)


@pytest.mark.parametrize(
    ("latex", "says"),
    [
        (r"\foo{x}", r"the formula \$\\foo\{x\}\$ has an unknown command \\foo"),
        (r"{", "cannot be converted"),
        (r"x_1_2", "cannot be converted: there are two indices _ in a row"),
        (r"\frac{1}{", "it ends too early; a brace or an argument is missing"),
        (r"\frac{1}", "is not complete"),
        (r"\left(", "cannot be converted"),
        (r"\begin{aligned} a &= b \\ c &= d \end{aligned}", "may not contain linebreak"),
    ],
)
def test_a_formula_that_cannot_be_converted_is_named(latex, says):
    with pytest.raises(InputError, match=says):
        formula(latex)


def test_the_place_of_a_bad_formula_is_named():
    with pytest.raises(ContentError, match=r"f\.md: step 2: the formula \$\\foo\$ has an unknown command \\foo"):
        to_html(r"good $a$, bad $\foo$", "f.md", "step 2")


def test_noise_makes_inert_text_or_a_named_mistake(rng):
    pieces = ["<", ">", "script", "img src=x onerror=y", "[", "](", ")", "javascript:", "$", "$$", "\n", "`", '"', "&"]
    pieces += [r"\text{", "}", "\\", "|", "* ", "http://", "a", "=", "!"]
    inert = 0
    for _ in range(600):
        text = "".join(rng.choice(pieces, size=int(rng.integers(1, 30))))
        try:
            html = to_html(text, "f.md")
        except ContentError as error:
            html = f"<p>{type(error).__name__}</p>"
        assert_inert(html)
        inert += "ContentError" not in html
    assert inert > 100


# --- Live values and pictures


def shown(text, **extras):
    return html_of(tokens_of(text), Extras(**extras))


def test_live_values_stand_between_words_and_are_collected():
    used = set()
    html = shown("Now **{{q1}}** and {{ det   J }}, \\{{q1}}.", live={"q1": "", "det J": ""}, used=used)
    assert '<strong><output class="live" data-live="q1">…</output></strong>' in html
    assert '<output class="live" data-live="det J">…</output>, {{q1}}.' in html
    assert used == {"q1", "det J"}


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("a\nb {{q2}}", 1, "unknown live value 'q2'. Available: q1"),
        ("a\n\n* b\n* {{w}}", 3, "the live value 'w' is not there for this arm: because"),
        ("| a |\n|---|\n| {{x}} |", 2, "unknown live value 'x'"),
        ("$$\na\n$$\n\ntext ${{q1}}$", 4, r"{{q1}} is a live value and cannot stand in a formula"),
        ("a\n\n![b](c.png)", 2, "unknown picture 'c.png'"),
        ("a\nb\n$\\foo$", 2, "unknown command"),
    ],
)
def test_the_line_of_a_mistake(text, line, says):
    with pytest.raises(TextError, match=says) as raised:
        shown(text, live={"q1": "", "w": "because"}, pictures={"d.png": "data:image/png;base64,A"})
    assert raised.value.line == line


def test_braces_of_formulas_are_no_live_values():
    assert "<mn>60</mn>" in shown(r"${{-60}\text{°}}$", live={"q1": ""})
    assert "<mi>a</mi>" in shown(r"$x^{{a}}$", live={"q1": ""})


@pytest.mark.parametrize(
    ("text", "formulas"),
    [
        ("It costs $5 and $6.", 0),
        (r"It costs \$5 and \$6.", 0),
        ("It costs $5, and $q_1$ turns by 2$x$ from $5-$6.", 2),
        ("$x$ is 5", 1),
        ("a $ x $ b", 0),
        ("Here $$x$$ stands.", 1),
    ],
)
def test_a_price_is_no_formula(text, formulas):
    html = shown(text)
    assert html.count("<math") == formulas
    assert formulas or html == f"<p>{text}</p>\n".replace("\\", "")


def test_a_table_in_square_brackets_is_marked_as_a_matrix_and_no_other():
    assert '<mtable class="matrix">' in formula(r"R = \begin{bmatrix} c & -s \\ s & c \end{bmatrix}", block=True)
    assert "matrix" not in formula(r"R = \begin{pmatrix} c & -s \\ s & c \end{pmatrix}")
    assert "matrix" not in formula(r"[a] + \begin{matrix} c \\ s \end{matrix}")


def test_a_true_minus_sign_in_a_formula_is_an_operator():
    assert formula("a \u2212 1") == formula("a - 1")


@pytest.mark.parametrize("address", ["https://a.example/x.png", "data:image/png;base64,AAAA", "y", "/x.png"])
def test_only_pictures_that_are_given_come_through(address):
    try:
        html = shown(f"![x]({address})", pictures={"z.png": "data:image/png;base64,A"})
    except TextError as error:
        html = f"<p>{type(error).__name__}</p>"
    assert "<img" not in html
