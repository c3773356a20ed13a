"""The panel of the page Three meanings, and its part of the scene."""
