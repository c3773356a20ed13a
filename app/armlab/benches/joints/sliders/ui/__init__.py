"""What is seen of the page Joints: its panel, and its part of the scene."""
