"""The panel of the page Skew & dyads, and its part of the scene."""
