"""What is seen of the page Steps: its panel, and its part of the scene."""
