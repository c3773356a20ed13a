"""What is seen of "index": its page and its part of the scene."""
