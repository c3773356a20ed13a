"""The panel of the page Ellipsoid, and its part of the scene."""
