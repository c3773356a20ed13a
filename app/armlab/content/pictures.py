"""Pictures of lessons: checked, and inserted into the page as ``data:`` addresses."""

from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ElementTree

from armlab.errors import ContentError, suggestion

MOST_PICTURES = 20
MOST_BYTES = 300_000

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}\.[a-z]+\Z")
"""Pattern of file names that Markdown leaves unchanged."""

TYPES = {"png": "image/png", "jpg": "image/jpeg", "jpeg": "image/jpeg", "webp": "image/webp", "svg": "image/svg+xml"}
"""Media types by file ending."""

_BEGINNINGS = {
    "image/png": re.compile(rb"\x89PNG\r\n\x1a\n"),
    "image/jpeg": re.compile(rb"\xff\xd8\xff"),
    "image/webp": re.compile(rb"RIFF....WEBP", re.DOTALL),
}
_EMBEDDED = re.compile(r"#|data:image/(png|jpeg|webp);base64,", re.IGNORECASE)
_FORBIDDEN = (
    *("script", "foreignobject", "iframe", "embed", "object", "audio", "video", "handler", "listener", "link", "meta"),
)
_ANIMATED = ("animate", "set", "animatetransform", "animatemotion")
_URL = re.compile(r"url\s*\(\s*[\"']?\s*[^#\"'\s]", re.IGNORECASE)
_DECLARATION = re.compile(r"\A\s*<\?xml\s[^?]*\?>")
_OTHER_ENCODING = re.compile(r"encoding\s*=\s*[\"'](?!utf-8[\"'])", re.IGNORECASE)
_NAMESPACES = ("", "http://www.w3.org/1999/xlink", "http://www.w3.org/XML/1998/namespace")
"""Namespaces of attributes that are checked; browsers ignore attributes of others."""


def picture(file: str, name: str, data: bytes) -> str:
    """Return a picture as a ``data:`` address.

    Parameters
    ----------
    file : str
        Its name in messages.
    name : str
        Its name without folders.
    data : bytes

    Raises
    ------
    ContentError
        Its name, size or content cannot be used.
    """
    ending = name.rpartition(".")[2]
    if ending.lower() not in TYPES:
        raise ContentError(file, "", f"not a kind of picture{suggestion(ending, TYPES)}")
    if ending not in TYPES:
        raise ContentError(
            file, "", f"expected an ending in small letters, .{ending.lower()}, got .{ending}; rename the picture"
        )
    if not NAME.match(name):
        raise ContentError(file, "", "expected a name of letters, digits, underscores and hyphens; rename the picture")
    kind = TYPES[ending]
    if len(data) > MOST_BYTES:
        raise ContentError(file, "", f"expected at most {MOST_BYTES // 1000} kB, got {-(-len(data) // 1000)} kB")
    if kind == "image/svg+xml":
        _check_svg(file, data)
    elif not _BEGINNINGS[kind].match(data):
        raise ContentError(file, "", f"expected a picture of the kind its name says, {kind}; save it again as such")
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def _check_svg(file: str, data: bytes) -> None:
    """Refuse a drawing that could run scripts or fetch anything."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ContentError(file, "", "expected a drawing in UTF-8") from None
    declaration = _DECLARATION.match(text)
    if declaration and _OTHER_ENCODING.search(declaration[0]):
        raise ContentError(file, "", "expected a drawing in UTF-8")
    after = _DECLARATION.sub("", text)
    if "<!DOCTYPE" in after or "<!ENTITY" in after or "<?" in after:
        raise ContentError(file, "", "expected a drawing without document type, entities and instructions")
    try:
        root = ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise ContentError(file, "", f"not a drawing in SVG: {error}") from None
    if _local(root.tag) != "svg":
        raise ContentError(file, "", f"expected an element svg, got {_local(root.tag)}")
    for element in root.iter():
        problem = _problem(element)
        if problem:
            raise ContentError(file, "", f"{problem}; draw it without")


def _problem(element: ElementTree.Element) -> str:
    """Return the problem of an element of a drawing, or ""."""
    tag, inside = _local(element.tag), element.text or ""
    if tag in _FORBIDDEN:
        return f"the drawing has an element {tag}"
    if tag == "style" and (re.search(r"[\\@]", inside) or len(element) or _URL.search(inside)):
        return "the drawing's style refers to something outside"
    for name, value in element.attrib.items():
        if name.rpartition("}")[0].lstrip("{") in _NAMESPACES:
            problem = _wrong_attribute(tag, _local(name), value)
            if problem:
                return problem
    return ""


def _wrong_attribute(tag: str, name: str, value: str) -> str:
    if name.startswith("on"):
        return f"the drawing has a handler {name}"
    if name == "base" or (name in ("href", "src") and not _EMBEDDED.match(value.strip())):
        return f"the drawing refers to something outside, {value[:40]!r}"
    if tag in _ANIMATED and name == "attributename" and value.lower().rpartition(":")[2] in ("href", "src"):
        return "the drawing changes an address"
    if _URL.search(value) or "\\" in value:
        return f"the drawing refers to something outside in {name}"
    return ""


def _local(name: object) -> str:
    """Return a name without its namespace, in lower case."""
    return str(name).rpartition("}")[2].lower()
