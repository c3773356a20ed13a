"""The panel of the page Velocity loop, and its part of the scene."""
