"""What is seen of "steps": its page and its part of the scene."""
