"""The panel of the page Forms, and its part of the scene."""
