"""What is seen of the page Table: its panel, and its part of the scene."""
