"""What is seen of the page For teachers: its panel, and its part of the scene."""
