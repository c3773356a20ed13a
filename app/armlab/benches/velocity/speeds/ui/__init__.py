"""What is seen of the page Speeds: its panel, and its part of the scene."""
