"""The panel of the page Tracking, and its part of the scene."""
