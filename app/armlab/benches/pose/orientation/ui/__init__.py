"""The panel of the page Orientation, and its part of the scene."""
