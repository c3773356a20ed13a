"""The panel of the page Joints, and its part of the scene."""
