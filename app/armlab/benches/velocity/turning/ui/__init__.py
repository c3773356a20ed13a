"""The panel of the page Angular velocity, and its part of the scene."""
