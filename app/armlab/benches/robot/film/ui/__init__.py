"""What is seen of the page Film: its panel, and its part of the scene."""
