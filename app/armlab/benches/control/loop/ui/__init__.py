"""What is seen of "{title}": its page and its part of the scene."""
