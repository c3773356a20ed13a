"""What is seen of the page By hand: its panel, and its part of the scene."""
