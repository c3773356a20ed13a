"""What is seen of "{hint}": its page and its part of the scene."""
