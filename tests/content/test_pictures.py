"""Pictures of lessons: checked before they come into a page."""

import base64

import pytest

from armlab.content.pictures import MOST_BYTES, picture
from armlab.errors import ContentError

PNG = b"\x89PNG\r\n\x1a\n" + b"\0" * 20
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4">{}</svg>'
HARMLESS = [
    '<path d="M0 0L4 4" style="stroke:#000"/>',
    '<defs><linearGradient id="a"/></defs><rect fill="url(#a)"/><use href="#b"/>',
    "<style>path { fill: url('#a'); }</style>",
    '<image href="data:image/png;base64,AAAA"/>',
    '<g xmlns:i="http://www.inkscape.org/namespaces/inkscape" i:export-filename="C:\\x\\y.png" i:href="x"/>',
    "<title>on top: url</title>",
]
HARMFUL = [
    "<script>alert(1)</script>",
    "<foreignObject><p>x</p></foreignObject>",
    '<rect onload="alert(1)"/>',
    '<image href="https://a.example/x.png"/>',
    '<use xlink:href="other.svg#a" xmlns:xlink="http://www.w3.org/1999/xlink"/>',
    '<a href="javascript:alert(1)"><path/></a>',
    '<image href="data:text/html;base64,AAAA"/>',
    '<image href="data:image/svg+xml;base64,AAAA"/>',
    "<style>@import 'https://a.example/x.css';</style>",
    "<style>path { fill: url(https://a.example) }</style>",
    "<style>path { fill: \\75rl(x) }</style>",
    "<rect fill=\"url( 'https://a.example/#a')\"/>",
    '<rect style="fill:url(//a.example)"/>',
    '<rect fill="\\75rl(//a.example)"/>',
    '<animate attributeName="href" to="javascript:alert(1)"/>',
    '<set attributeName="xlink:href" to="x"/>',
    '<g xml:base="https://a.example"/>',
    '<h:script xmlns:h="http://www.w3.org/1999/xhtml">x</h:script>',
    '<h:iframe xmlns:h="http://www.w3.org/1999/xhtml" src="x"/>',
]


def test_a_picture_becomes_an_address():
    address = picture("a/x.png", "x.png", PNG)
    assert address == "data:image/png;base64," + base64.b64encode(PNG).decode()
    assert picture("a", "x.jpg", b"\xff\xd8\xff\xe0").startswith("data:image/jpeg;")
    assert picture("a", "x.webp", b"RIFF\0\0\0\0WEBPVP8 ").startswith("data:image/webp;")


@pytest.mark.parametrize("inside", HARMLESS)
def test_drawings(inside):
    data = ('<?xml version="1.0" encoding="UTF-8"?>\n' + SVG.format(inside)).encode()
    assert base64.b64decode(picture("a", "x.svg", data).removeprefix("data:image/svg+xml;base64,")) == data


@pytest.mark.parametrize("inside", HARMFUL)
def test_drawings_that_could_run_or_fetch_are_refused(inside):
    with pytest.raises(ContentError, match=r"x\.svg: the drawing"):
        picture("x.svg", "x.svg", SVG.format(inside).encode())


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('<!DOCTYPE svg [<!ENTITY a "b">]>' + SVG.format("&a;"), "without document type"),
        ('<?xml-stylesheet href="x"?>' + SVG.format(""), "without document type, entities and instructions"),
        ('<?xml version="1.0" encoding="utf-7"?>' + SVG.format(""), "in UTF-8"),
        ("<html/>", "expected an element svg, got html"),
        ("<svg>", "not a drawing in SVG"),
        ("", "not a drawing in SVG"),
    ],
)
def test_what_is_no_drawing(text, says):
    with pytest.raises(ContentError, match=says):
        picture("x.svg", "x.svg", text.encode())


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("x.png", b"GIF89a", "expected a picture of the kind its name says, image/png"),
        ("x.png", PNG + b"\0" * MOST_BYTES, "expected at most 300 kB, got 301 kB"),
        ("x.gif", b"GIF89a", "not a kind of picture"),
        ("my pic.png", PNG, "expected a name of letters"),
        ("IMG_1234.JPG", PNG, "expected an ending in small letters, .jpg, got .JPG; rename the picture"),
        ("fig.PDF", b"%PDF", "not a kind of picture"),
        ("x.svg", b"\xff\xfe", "expected a drawing in UTF-8"),
    ],
)
def test_pictures_that_cannot_be_used(name, data, says):
    with pytest.raises(ContentError, match=f"^mine/x: {says}"):
        picture("mine/x", name, data)
