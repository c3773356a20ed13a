"""The panel of the page Turning, and its part of the scene."""
