"""The panel of the page Microscope, and its part of the scene."""
