"""The panel of the page Taught goals, and its points in the scene."""
