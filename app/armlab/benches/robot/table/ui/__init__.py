"""What is seen of "table": its page and its part of the scene."""
