"""Colours of the coordinates on the page and in the scene."""

from __future__ import annotations

from armlab.ui.colours import ORANGE, PURPLE, SKY, Rgb

COLOURS: dict[str, Rgb] = {"r": ORANGE, "theta": PURPLE, "h": SKY, "phi": SKY}
"""Colours by the names of the coordinates; h and phi are never drawn at once."""
