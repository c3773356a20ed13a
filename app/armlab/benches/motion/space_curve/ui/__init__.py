"""The panel of the page Geometry, and its part of the scene."""
