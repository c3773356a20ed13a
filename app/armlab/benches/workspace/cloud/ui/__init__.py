"""The panel of the page Reachable, and its part of the scene."""
