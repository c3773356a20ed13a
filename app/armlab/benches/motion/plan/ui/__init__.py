"""What is seen of "Plan": its page and its part of the scene."""
