"""What is seen of "share": its page and its part of the scene."""
