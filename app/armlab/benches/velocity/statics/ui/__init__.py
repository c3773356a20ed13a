"""What is seen of "statics": its page and its part of the scene."""
