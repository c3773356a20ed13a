"""What is seen of the page Statics: its panel, and its part of the scene."""
