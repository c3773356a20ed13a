"""The panel of the page Table task, and its part of the scene."""
