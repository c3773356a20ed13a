"""What is seen of "solve": its page and its part of the scene."""
