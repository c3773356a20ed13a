"""The panel of the page Two robots, and its part of the scene."""
