"""The panel of the page Plan, and its part of the scene."""
