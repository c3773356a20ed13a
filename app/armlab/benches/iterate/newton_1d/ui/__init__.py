"""The panel of the page One variable, and its part of the scene."""
