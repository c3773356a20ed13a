"""What is seen of the page Ellipsoid: its panel, and its part of the scene."""
