"""The panel of the page DC motor, and its part of the scene."""
