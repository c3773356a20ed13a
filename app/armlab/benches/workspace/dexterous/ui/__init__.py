"""What is seen of the page Dexterous: its panel, and its part of the scene."""
