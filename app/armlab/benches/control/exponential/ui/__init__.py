"""What is seen of the page e^At: its panel, and its part of the scene."""
