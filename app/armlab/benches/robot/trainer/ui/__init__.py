"""The panel of the page Assign frames, and its part of the scene."""
