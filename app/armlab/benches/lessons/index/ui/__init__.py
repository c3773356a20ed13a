"""The panel of the page Lessons, and its part of the scene."""
