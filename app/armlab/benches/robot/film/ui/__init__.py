"""The panel of the page Film, and its part of the scene."""
