"""The panel of the page Newton in 1D, and its part of the scene."""
