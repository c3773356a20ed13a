"""The panel of the page Pose, and its part of the scene."""
