"""The panel of the page Target, and its part of the scene."""
