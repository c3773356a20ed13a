"""The panel of the page Order of rotations, and its part of the scene."""
