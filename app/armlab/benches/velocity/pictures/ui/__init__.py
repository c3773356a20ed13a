"""What is seen of "pictures": its page and its part of the scene."""
