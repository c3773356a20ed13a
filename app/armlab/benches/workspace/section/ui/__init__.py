"""The panel of the page Section, and its part of the scene."""
