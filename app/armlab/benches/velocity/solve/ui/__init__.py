"""The panel of the page Solve, and its part of the scene."""
