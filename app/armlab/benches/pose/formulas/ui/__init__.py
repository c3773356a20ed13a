"""The panel of the page Formulas, and its part of the scene."""
