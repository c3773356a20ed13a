"""What is seen of the page Curves: its panel, and its part of the scene."""
