"""The panel of the page Euler & RPY angles, and its part of the scene."""
