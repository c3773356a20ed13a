"""The panel of the page Moving & fixed axes, and its part of the scene."""
