"""The panel of the page Spaces, and its second arm in the scene."""
