"""The panel of the page atan2, and its part of the scene."""
