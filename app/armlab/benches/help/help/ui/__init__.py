"""What is seen of the page Help: its panel, and its part of the scene."""
