"""What is seen of the page Turning: its panel, and its part of the scene."""
