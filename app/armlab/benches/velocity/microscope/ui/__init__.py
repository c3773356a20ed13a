"""What is seen of the page Microscope: its panel, and its part of the scene."""
