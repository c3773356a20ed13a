"""What is seen of "what_if": its page and its part of the scene."""
