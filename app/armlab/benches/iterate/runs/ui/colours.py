"""The colours of the runs, in scene, list and plots."""

from __future__ import annotations

from armlab.ui.colours import BLUE, GREEN, PURPLE, VERMILLION, Rgb

RUN_COLOURS: tuple[Rgb, ...] = (BLUE, VERMILLION, GREEN, PURPLE)
"""By `Run.colour`."""
