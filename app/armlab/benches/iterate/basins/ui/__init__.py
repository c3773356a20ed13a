"""The panel of the page Basins, and its part of the scene."""
