"""What is seen of "files": its page and its part of the scene."""
