"""What is seen of the page Loop: its panel, and its part of the scene."""
