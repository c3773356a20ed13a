"""What is seen of the page Solve: its panel, and its part of the scene."""
