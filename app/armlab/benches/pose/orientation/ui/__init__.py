"""What is seen of the page Orientation: its panel, and its part of the scene."""
