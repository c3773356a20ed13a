"""What is seen of the page View: its panel, and its part of the scene."""
