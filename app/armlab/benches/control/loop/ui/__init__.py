"""The panel of the page Loop, and its part of the scene."""
