"""The words in the drawings of lessons, which stand in the page as ``data:`` addresses."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable
from html import escape, unescape

_DRAWING = re.compile(r'<img\b[^>]* src="data:image/svg\+xml;base64,([A-Za-z0-9+/=]+)"')
_ALT = re.compile(r' alt="([^"]*)"')
_TEXT = re.compile(r"(<text\b[^>]*>)([^<]+)(?=</text>)")


def said_drawing(image: str, say: Callable[[str], str]) -> str:
    """Return the start of an image with the words in its drawing in another language.

    They are those of a lesson, and the same words of the lab mean something else, or stand in a lesson that is not
    translated: so they are said only where the description of the image is.

    Parameters
    ----------
    image : str
        The element as it stands in markup.
    say : callable
        Returns a text in the language, or as it is where it is not known.
    """
    found, described = _DRAWING.search(image), _ALT.search(image)
    if found is None or described is None or say(unescape(described[1])) == unescape(described[1]):
        return image
    drawing = base64.b64decode(found[1]).decode("utf-8-sig")
    said = _TEXT.sub(lambda text: f"{text[1]}{escape(say(unescape(text[2])), quote=False)}", drawing)
    return f"{image[: found.start(1)]}{base64.b64encode(said.encode()).decode()}{image[found.end(1) :]}"
