"""What is seen of the page Five steps: its panel, and its part of the scene."""
