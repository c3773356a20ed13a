"""What is seen of the page Plots: its panel, and its part of the scene."""
