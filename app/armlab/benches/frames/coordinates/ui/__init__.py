"""The panel of the page Coordinates, and its part of the scene."""
