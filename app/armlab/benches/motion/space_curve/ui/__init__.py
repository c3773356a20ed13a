"""The panel of the page Path geometry, and its part of the scene."""
