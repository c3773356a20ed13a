"""What is seen of the page Share: its panel, and its part of the scene."""
