"""The panel of the page By hand, and its part of the scene."""
