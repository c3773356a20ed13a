"""The panel of the page Common normal, and its part of the scene."""
