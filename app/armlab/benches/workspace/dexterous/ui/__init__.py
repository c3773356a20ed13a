"""The panel of the page Dexterous, and its part of the scene."""
