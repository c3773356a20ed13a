"""The button that opens the search, on any page."""

from __future__ import annotations

from armlab.ui.html import Markup, joined, tag


def search_button(text: str, kind: str = "") -> Markup:
    """Return a button that opens the search."""
    inside = (glass(), tag("span", text), tag("kbd", "Ctrl+K"))
    named = {"aria_label": "Search", "aria_haspopup": "dialog", "aria_keyshortcuts": "Control+K Meta+K /"}
    title = "Search pages, arms, lessons, topics, commands, files (Ctrl+K or /)"
    return tag("button", inside, class_=f"seek {kind}".strip(), type="button", data_search=True, title=title, **named)


def glass() -> Markup:
    """Return the picture of a magnifier."""
    drawn = joined(tag("circle", cx="6.5", cy="6.5", r="4.5"), tag("path", d="M10 10l4.5 4.5"))
    return tag("svg.glass", drawn, viewBox="0 0 16 16", width=14, height=14, aria_hidden="true")
