"""The panel of the page Inverse velocity, and its part of the scene."""
