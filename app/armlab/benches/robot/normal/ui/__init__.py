"""What is seen of the page Common normal: its panel, and its part of the scene."""
