"""The panel of the page For teachers, and its part of the scene."""
