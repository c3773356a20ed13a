"""The panel of the page Joint drive, and its part of the scene."""
