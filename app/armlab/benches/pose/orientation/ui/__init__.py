"""What is seen of "orientation": its page and its part of the scene."""
