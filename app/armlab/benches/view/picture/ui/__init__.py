"""The panel of the page Display, and its part of the scene."""
