"""What is seen of the page Section: its panel, and its part of the scene."""
