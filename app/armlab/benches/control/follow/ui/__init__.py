"""What is seen of the page Runs: its panel, and its part of the scene."""
