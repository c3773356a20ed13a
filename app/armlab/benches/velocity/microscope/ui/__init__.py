"""The panel of the page Singularities, and its part of the scene."""
