"""The panel of the page Robot, and its part of the scene."""
