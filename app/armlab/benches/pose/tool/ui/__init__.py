"""What is seen of the page Pose: its panel, and its part of the scene."""
