"""The panel of the page Speeds, and its part of the scene."""
