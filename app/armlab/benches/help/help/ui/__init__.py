"""The panel of the page Help, and its part of the scene."""
