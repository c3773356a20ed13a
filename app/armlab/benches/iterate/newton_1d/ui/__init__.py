"""What is seen of the page One variable: its panel, and its part of the scene."""
