"""Colours of the change of coordinates on the page and in the scene."""

from __future__ import annotations

from armlab.ui.colours import ORANGE, PURPLE, Rgb

ORIGINS: Rgb = PURPLE
FROM_FRAME: Rgb = ORANGE
"""Colours of the arrows from the reference to the frame, and from the frame to the point; the one from the reference to
the point has the colour of ink."""
