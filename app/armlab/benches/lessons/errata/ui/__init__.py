"""The panel of the page Errata, and its part of the scene."""
