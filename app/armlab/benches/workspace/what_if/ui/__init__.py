"""The panel of the page What if, and its part of the scene."""
