"""The panel of the page Quaternions, and its part of the scene."""
