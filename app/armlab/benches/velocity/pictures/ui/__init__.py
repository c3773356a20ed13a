"""The panel of the page Joint space, and its part of the scene."""
