"""The panel of the page Arms, and its part of the scene."""
