"""The panel of the page Matrix exponential, and its part of the scene."""
