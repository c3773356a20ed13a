"""What is seen of "laws": its page and its part of the scene."""
