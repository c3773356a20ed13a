"""What is seen of the page Robot: its panel, and its part of the scene."""
