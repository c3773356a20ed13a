"""What is seen of the page Basins: its panel, and its part of the scene."""
