"""The panel of the page Table, and its part of the scene."""
