"""The panel of the page Convergence map, and its part of the scene."""
