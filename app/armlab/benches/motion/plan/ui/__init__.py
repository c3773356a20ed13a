"""What is seen of the page Plan: its panel, and its part of the scene."""
