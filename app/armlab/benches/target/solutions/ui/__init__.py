"""What is seen of the page Solutions: its panel, and its part of the scene."""
