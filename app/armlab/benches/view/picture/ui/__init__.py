"""The panel of the page View, and its part of the scene."""
