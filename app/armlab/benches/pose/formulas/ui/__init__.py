"""The panel of the page FK formulas, and its part of the scene."""
