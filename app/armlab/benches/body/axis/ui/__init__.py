"""The panel of the page Axis & angle, and its part of the scene."""
