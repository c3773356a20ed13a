"""The panel of the page Gears, and its part of the scene."""
