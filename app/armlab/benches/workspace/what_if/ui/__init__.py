"""What is seen of the page What if: its panel, and its part of the scene."""
