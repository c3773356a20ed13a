"""What is seen of "author": its page and its part of the scene."""
