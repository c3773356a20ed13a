"""QR codes of links, for the phones and tablets in a room."""

from __future__ import annotations

import segno

from armlab.ui.html import Markup

MOST = 900
"""Largest number of characters: 101 squares a side, each 3 pixels of a panel; a phone still reads it from a
projector."""

QUIET = 4
"""Width of the white margin in squares, as the standard of the code asks for."""


def qr_svg(text: str) -> Markup | None:
    """Return the code of a text as inline SVG that fills its place, or None if the text is longer than `MOST`."""
    if len(text) > MOST:
        return None
    code = segno.make(text, error="l", micro=False)
    return Markup(code.svg_inline(border=QUIET, omitsize=True, dark="#000", light="#fff", title="QR code of the link"))
