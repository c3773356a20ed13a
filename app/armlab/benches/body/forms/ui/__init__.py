"""The panel of the page Rotation, and its part of the scene."""
