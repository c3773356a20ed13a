"""The panel of the page Meanings, and its part of the scene."""
