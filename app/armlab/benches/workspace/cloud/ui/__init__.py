"""What is seen of the page Reach: its panel, and its part of the scene."""
