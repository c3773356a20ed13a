"""The panel of the page e^At, and its part of the scene."""
