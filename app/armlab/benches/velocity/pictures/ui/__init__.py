"""What is seen of the page Pictures: its panel, and its part of the scene."""
