"""The panel of the page Planning steps, and its part of the scene."""
