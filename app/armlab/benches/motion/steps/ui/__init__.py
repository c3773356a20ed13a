"""The panel of the page Five steps, and its part of the scene."""
