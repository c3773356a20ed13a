"""What is seen of "picture": its page and its part of the scene."""
