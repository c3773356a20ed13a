"""What is seen of the page Geometry: its panel, and its part of the scene."""
