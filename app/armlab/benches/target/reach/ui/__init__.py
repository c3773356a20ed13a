"""What is seen of the page Target: its panel, and its part of the scene."""
