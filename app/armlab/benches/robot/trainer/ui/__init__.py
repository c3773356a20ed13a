"""What is seen of the page Trainer: its panel, and its part of the scene."""
