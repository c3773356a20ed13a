"""What is seen of "formulas": its page and its part of the scene."""
