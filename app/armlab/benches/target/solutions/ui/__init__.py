"""The panel of the page Solutions, and its part of the scene."""
