"""The panel of the page Compare designs, and its part of the scene."""
