"""What is seen of the page Lessons: its panel, and its part of the scene."""
