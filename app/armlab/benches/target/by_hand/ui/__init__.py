"""The panel of the page Closed-form IK, and its part of the scene."""
