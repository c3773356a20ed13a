"""The panel of the page Jacobian, and its part of the scene."""
