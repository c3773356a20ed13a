"""The panel of the page Steps, and its part of the scene."""
