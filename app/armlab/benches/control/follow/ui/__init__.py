"""The panel of the page Runs, and its part of the scene."""
