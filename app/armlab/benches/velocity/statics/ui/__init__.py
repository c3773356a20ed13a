"""The panel of the page Statics, and its part of the scene."""
