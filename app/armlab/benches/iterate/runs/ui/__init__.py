"""The panel of the page Numerical IK, and its part of the scene."""
