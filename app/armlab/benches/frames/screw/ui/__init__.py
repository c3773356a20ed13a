"""The panel of the page Screw motion, and its part of the scene."""
