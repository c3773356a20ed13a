"""What is seen of the page Files: its panel, and its part of the scene."""
