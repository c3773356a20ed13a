"""The panel of the page Reach, and its part of the scene."""
