"""What is seen of the page Laws: its panel, and its part of the scene."""
