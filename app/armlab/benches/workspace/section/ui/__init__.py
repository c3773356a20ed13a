"""The panel of the page Cross-section, and its part of the scene."""
