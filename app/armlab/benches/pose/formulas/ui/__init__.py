"""What is seen of the page Formulas: its panel, and its part of the scene."""
