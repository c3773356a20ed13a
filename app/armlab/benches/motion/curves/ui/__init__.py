"""What is seen of "curves": its page and its part of the scene."""
